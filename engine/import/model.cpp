#include "engine/import/model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

namespace tessera {

bool is_model_file(const std::string& path) {
  constexpr std::string_view kEnding = ".obj";
  return path.size() >= kEnding.size() && std::equal(kEnding.begin(), kEnding.end(), path.end() - kEnding.size(), [](char wanted, char c) {
           return wanted == std::tolower(static_cast<unsigned char>(c));
         });
}

MeshData part_mesh(const Model& model, std::size_t part) {
  const ModelPart& range = model.parts[part];
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_index(model.mesh.vertex_count(), kUnused);
  MeshData mesh;
  mesh.name = range.material_name;
  std::uint32_t count = 0;
  const auto copy = [](const std::vector<float>& from, std::vector<float>& to, std::size_t vertex, std::size_t components) {
    if (!from.empty()) to.insert(to.end(), &from[components * vertex], &from[components * vertex] + components);
  };
  for (std::size_t i = range.first_index; i < range.first_index + range.index_count; ++i) {
    const std::uint32_t vertex = model.mesh.indices[i];
    if (new_index[vertex] == kUnused) {
      new_index[vertex] = count++;
      copy(model.mesh.positions, mesh.positions, vertex, 3);
      copy(model.mesh.normals, mesh.normals, vertex, 3);
      copy(model.mesh.colors, mesh.colors, vertex, 4);
    }
    mesh.indices.push_back(new_index[vertex]);
  }
  return mesh;
}

void add_smooth_normals(MeshData& mesh) {
  using Position = std::array<float, 3>;
  const auto position = [&](std::uint32_t vertex) {
    const float* p = &mesh.positions[3 * std::size_t{vertex}];
    return Position{p[0], p[1], p[2]};
  };
  std::map<Position, std::array<double, 3>> sums;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Position corners[3] = {position(mesh.indices[i]), position(mesh.indices[i + 1]), position(mesh.indices[i + 2])};
    double u[3], v[3];
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = double{corners[1][k]} - corners[0][k];
      v[k] = double{corners[2][k]} - corners[0][k];
    }
    const double normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};  // twice the area long
    for (const Position& corner : corners)
      for (std::size_t k = 0; k < 3; ++k) sums[corner][k] += normal[k];
  }
  mesh.normals.clear();
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
    const std::array<double, 3> sum = sums[position(vertex)];
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    for (const double x : sum) mesh.normals.push_back(length > 0 ? static_cast<float>(x / length) : 0.0f);
  }
}

}  // namespace tessera
