#include "engine/program/import/obj_vertices.h"

#include <cstddef>

namespace tessera::program {
namespace {

std::size_t at(std::uint32_t index, std::size_t components) { return components * std::size_t{index}; }

}  // namespace

ObjVertices::ObjVertices(const ObjFile& file, const std::vector<float>& positions, ObjAttributes attributes,
                         MeshData& mesh)
    : file_(file), positions_(positions), attributes_(attributes), mesh_(mesh) {}

std::uint32_t ObjVertices::index(const ObjCorner& corner, const ObjVertexLook& look) {
  const Key key = key_of(corner, look);
  const std::uint64_t hash =
      mixed(std::uint64_t{key.position} << 32 | static_cast<std::uint32_t>(key.texcoord),
            std::uint64_t{key.look} << 32 | static_cast<std::uint32_t>(key.normal));
  const auto next = static_cast<std::uint32_t>(keys_.size());
  const std::uint32_t found = table_.find_or_add(static_cast<std::uint32_t>(hash), next,
                                                 [&](std::uint32_t other) { return keys_[other] == key; });
  if (found == next) {
    keys_.push_back(key);
    vertices_.push_back(static_cast<std::uint32_t>(mesh_.vertex_count()));
    append(corner, look);
  }
  return vertices_[found];
}

ObjVertices::Key ObjVertices::key_of(const ObjCorner& corner, const ObjVertexLook& look) const {
  return {.position = corner.position,
          .look = look.number,
          .texcoord = attributes_.texcoords ? corner.texcoord : kNoObjIndex,
          .normal = attributes_.normals ? corner.normal : kNoObjIndex};
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
