#include "shadow.h"

#include "tests/reference/planar_shadow.h"

namespace tessera::mesa {

reference::Draw as_drawn(const reference::Draw& draw, const std::vector<reference::Light>& lights) {
  reference::Draw drawn = draw;
  if (!draw.shadow_on) return drawn;
  const reference::Mat4 onto_plane =
      reference::shadow_matrix(draw.shadow_on->plane, lights.at(draw.shadow_on->light)).value();
  drawn.world_from_object = reference::multiply(onto_plane, draw.world_from_object);
  drawn.lighting = false;
  drawn.texture.reset();
  drawn.material.diffuse = draw.shadow_on->color;
  return drawn;
}

bool has_vertex_colors(const reference::Draw& draw, const reference::Mesh& mesh) {
  return !draw.shadow_on && !mesh.colors.empty();
}

}  // namespace tessera::mesa
