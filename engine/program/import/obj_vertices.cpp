#include "engine/program/import/obj_vertices.h"

#include <cstddef>

namespace tessera::program {
namespace {

std::size_t at(std::uint32_t index, std::size_t components) { return components * std::size_t{index}; }

}  // namespace

ObjVertices::ObjVertices(const ObjFile& file, const std::vector<float>& positions, ObjAttributes attributes,
                         MeshData& mesh)
    : file_(file), positions_(positions), attributes_(attributes), mesh_(mesh) {
  indices_.reserve(positions.size() / 3);
}

std::uint32_t ObjVertices::index(const ObjCorner& corner, const ObjVertexLook& look) {
  const auto [entry, is_new] =
      indices_.try_emplace(key_of(corner, look), static_cast<std::uint32_t>(mesh_.vertex_count()));
  if (is_new) append(corner, look);
  return entry->second;
}

std::size_t ObjVertices::Hash::operator()(const Key& key) const {
  return static_cast<std::size_t>(
      (key.position_and_look ^ key.texcoord_and_normal * 0x9e3779b97f4a7c15u) * 0xff51afd7ed558ccdu >> 16);
}

ObjVertices::Key ObjVertices::key_of(const ObjCorner& corner, const ObjVertexLook& look) const {
  const std::uint64_t texcoord = attributes_.texcoords ? static_cast<std::uint32_t>(corner.texcoord) : 0;
  const std::uint64_t normal = attributes_.normals ? static_cast<std::uint32_t>(corner.normal) : 0;
  return {std::uint64_t{corner.position} << 32 | look.number, texcoord << 32 | normal};
}

void ObjVertices::append(const ObjCorner& corner, const ObjVertexLook& look) {
  for (std::size_t k = 0; k < 3; ++k) mesh_.positions.push_back(positions_[at(corner.position, 3) + k]);
  if (attributes_.normals)
    for (std::size_t k = 0; k < 3; ++k)
      mesh_.normals.push_back(
          corner.normal < 0 ? 0 : file_.normals[at(static_cast<std::uint32_t>(corner.normal), 3) + k]);
  if (attributes_.texcoords)
    for (std::size_t k = 0; k < 2; ++k)
      mesh_.texcoords.push_back(
          corner.texcoord < 0 ? 0
                              : file_.texcoords[at(static_cast<std::uint32_t>(corner.texcoord), 2) + k] *
                                        look.texcoord_scale[k] +
                                    look.texcoord_offset[k]);
  if (attributes_.colors) {
    for (std::size_t k = 0; k < 3; ++k)
      mesh_.colors.push_back(file_.colors[at(corner.position, 3) + k] * look.color_factor[k]);
    mesh_.colors.push_back(look.color_factor[3]);
  }
}

}  // namespace tessera::program
