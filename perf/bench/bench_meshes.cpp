#include "perf/bench/bench_meshes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tessera::bench {
namespace {

void add_squares(MeshData& mesh, int columns, int rows) {
  const auto row = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y)
    for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(columns); ++x) {
      const std::uint32_t a = y * row + x;
      const std::uint32_t b = a + 1;
      const std::uint32_t c = a + row;
      const std::uint32_t d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
}

}  // namespace

MeshData window_grid(int columns, int rows, float depth, float waves, float texture_repeats) {
  MeshData mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(columns);
      const float v = static_cast<float>(y) / static_cast<float>(rows);
      mesh.positions.insert(mesh.positions.end(),
                            {2 * u - 1, 2 * v - 1, depth + waves * std::sin(20 * u) * std::cos(17 * v)});
      mesh.colors.insert(mesh.colors.end(), {u, v, 1 - u, 1});
      mesh.texcoords.insert(mesh.texcoords.end(), {texture_repeats * u, texture_repeats * v});
    }
  add_squares(mesh, columns, rows);
  return mesh;
}

MeshData sphere(int columns, int rows, float radius) {
  MeshData mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const float longitude =
          2 * std::numbers::pi_v<float> * static_cast<float>(x) / static_cast<float>(columns);
      const float polar = std::numbers::pi_v<float> * static_cast<float>(y) / static_cast<float>(rows);
      const float n[3] = {std::cos(longitude) * std::sin(polar), -std::cos(polar),
                          -std::sin(longitude) * std::sin(polar)};
      mesh.positions.insert(mesh.positions.end(), {radius * n[0], radius * n[1], radius * n[2]});
      mesh.normals.insert(mesh.normals.end(), {n[0], n[1], n[2]});
    }
  add_squares(mesh, columns, rows);
  return mesh;
}

MeshData merged(std::span<const MeshData> meshes) {
  MeshData all;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const MeshData& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertex_count());
    append(all.positions, mesh.positions);
    append(all.normals, mesh.normals);
    append(all.colors, mesh.colors);
    append(all.texcoords, mesh.texcoords);
    for (const std::uint32_t index : mesh.indices) all.indices.push_back(first + index);
  }
  return all;
}

}  // namespace tessera::bench
