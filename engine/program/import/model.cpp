#include "engine/program/import/model.h"

#include <limits>
#include <utility>

namespace tessera::program {

std::vector<MeshData> split_into_parts(Model model) {
  std::vector<MeshData> meshes;
  if (model.parts.size() == 1) {
    meshes.push_back(std::move(model.mesh));
    meshes.back().name = model.parts[0].material_name;
    return meshes;
  }
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_index(model.mesh.vertex_count(), kUnused);
  std::vector<std::uint32_t> used;  // vertices of the current part, reset in new_index after it
  const auto copy = [](const std::vector<float>& from, std::vector<float>& to, std::size_t vertex,
                       std::size_t components) {
    if (!from.empty())
      to.insert(to.end(), &from[components * vertex], &from[components * vertex] + components);
  };
  for (const ModelPart& part : model.parts) {
    MeshData& mesh = meshes.emplace_back();
    mesh.name = part.material_name;
    for (std::size_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      const std::uint32_t vertex = model.mesh.indices[i];
      if (new_index[vertex] == kUnused) {
        new_index[vertex] = static_cast<std::uint32_t>(used.size());
        used.push_back(vertex);
        copy(model.mesh.positions, mesh.positions, vertex, 3);
        copy(model.mesh.normals, mesh.normals, vertex, 3);
        copy(model.mesh.colors, mesh.colors, vertex, 4);
        copy(model.mesh.texcoords, mesh.texcoords, vertex, 2);
      }
      mesh.indices.push_back(new_index[vertex]);
    }
    for (const std::uint32_t vertex : used) new_index[vertex] = kUnused;
    used.clear();
  }
  return meshes;
}

}  // namespace tessera::program
