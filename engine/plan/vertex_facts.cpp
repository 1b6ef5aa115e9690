#include "engine/plan/vertex_facts.h"

#include <algorithm>
#include <cmath>

namespace tessera::detail {
namespace {

/// The first `size` floats of all records, if they are equal and finite.
template <std::size_t size>
std::optional<std::array<float, size>> equal_values(StridedFloats values, std::size_t count) {
  std::array<float, size> first;
  std::copy_n(values.at(0), size, first.begin());
  if (!std::all_of(first.begin(), first.end(), [](float value) { return std::isfinite(value); }))
    return std::nullopt;
  for (std::size_t i = 1; i < count; ++i)
    if (!std::equal(first.begin(), first.end(), values.at(i))) return std::nullopt;
  return first;
}

}  // namespace

std::optional<std::array<float, 4>> equal_color(const MeshArrays& mesh) {
  if (mesh.color_bytes == nullptr) return equal_values<4>(mesh.colors, mesh.vertices);
  for (std::size_t i = 1; i < mesh.vertices; ++i)
    if (!std::equal(mesh.color_bytes, mesh.color_bytes + 4, mesh.color_bytes + i * mesh.color_stride))
      return std::nullopt;
  return std::array{mesh.color(0, 0), mesh.color(0, 1), mesh.color(0, 2), mesh.color(0, 3)};
}

std::optional<float> equal_alpha(const MeshArrays& mesh) {
  const float first = mesh.color(0, 3);
  for (std::size_t i = 0; i < mesh.vertices; ++i) {
    if (!(mesh.color(i, 3) == first)) return std::nullopt;
    if (mesh.color_bytes != nullptr) continue;
    const float* const color = mesh.colors.at(i);
    const float probe = color[0] * 0 + color[1] * 0 + color[2] * 0 + color[3] * 0;
    if (!(probe == 0)) return std::nullopt;
  }
  return first;
}

std::optional<std::array<float, 3>> equal_normal(const MeshArrays& mesh) {
  return equal_values<3>(mesh.normals, mesh.vertices);
}

}  // namespace tessera::detail
