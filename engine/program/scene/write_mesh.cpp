// Writes the mesh of a draw.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "engine/program/scene/json_text.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/write_parts.h"

namespace tessera::program {
namespace {

using json::Json;

std::size_t corner_count(Primitive primitive) {
  if (primitive == Primitive::points) return 1;
  return primitive == Primitive::lines ? 2 : 3;
}

std::span<const float> vector_of(const std::vector<float>& attribute, std::size_t components,
                                 std::uint32_t vertex) {
  return std::span(attribute).subspan(components * vertex, components);
}

bool is_finite(std::span<const float> numbers) {
  return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

/// Indices of a draw without primitives that are not drawn.
std::vector<std::uint32_t> drawn_indices(const DrawCommand& draw, const MeshData& mesh) {
  std::span<const std::uint32_t> all = mesh.indices;
  if (draw.index_count > 0) all = all.subspan(draw.first_index, draw.index_count);
  const std::size_t corners = corner_count(mesh.primitive);
  std::vector<std::uint32_t> indices;
  indices.reserve(all.size());
  for (std::size_t i = 0; i + corners <= all.size(); i += corners) {
    const auto primitive = all.subspan(i, corners);
    if (std::ranges::all_of(primitive, [&](auto v) { return is_finite(vector_of(mesh.positions, 3, v)); }))
      indices.insert(indices.end(), primitive.begin(), primitive.end());
  }
  return indices;
}

/// Vertices in the order of their first use.
struct UsedVertices {
  std::vector<std::uint32_t> vertices;  ///< numbers in the mesh
  Json indices = Json::array();         ///< indices into `vertices`
};

UsedVertices used_vertices(const std::vector<std::uint32_t>& indices) {
  UsedVertices used;
  std::unordered_map<std::uint32_t, std::size_t> number_of;
  for (const std::uint32_t vertex : indices) {
    const auto [found, is_new] = number_of.emplace(vertex, used.vertices.size());
    if (is_new) used.vertices.push_back(vertex);
    used.indices.push_back(found->second);
  }
  return used;
}

}  // namespace

std::optional<Json> mesh_json(const DrawCommand& draw, const Scene& scene) {
  const MeshData& mesh = scene.meshes[draw.mesh];
  const UsedVertices used = used_vertices(drawn_indices(draw, mesh));
  if (used.vertices.empty()) return std::nullopt;
  Json json{{"primitive", name_in(kPrimitives, mesh.primitive)}};
  const auto add = [&](const char* key, const std::vector<float>& attribute, std::size_t components) {
    if (attribute.empty()) return;
    Json list = Json::array();
    for (const std::uint32_t vertex : used.vertices) {
      const auto numbers = vector_of(attribute, components, vertex);
      if (!is_finite(numbers))
        throw Error(scene.name + ": " + key + " of mesh \"" + mesh.name +
                    "\" hold a number that is not finite, which a scene file cannot store");
      list.push_back(numbers_json(numbers));
    }
    json[key] = std::move(list);
  };
  add("positions", mesh.positions, 3);
  if (draw.state.lighting) add("normals", mesh.normals, 3);
  if (!draw.state.lighting || draw.state.color_material != ColorMaterial::none) add("colors", mesh.colors, 4);
  if (draw.state.texture != nullptr) add("texcoords", mesh.texcoords, 2);
  json["indices"] = used.indices;
  return json;
}

}  // namespace tessera::program
