#include "engine/import/model.h"

#include <limits>

namespace tessera {

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

}  // namespace tessera
