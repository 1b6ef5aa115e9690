#include "engine/program/import/stl_facets.h"

#include <utility>

#include "engine/program/import/vertex_alpha.h"

namespace tessera::program {
namespace {

bool is_null(const Position& normal) { return !(normal.x != 0 || normal.y != 0 || normal.z != 0); }

/// Whether the normal is on the side that sees the corners clockwise.
bool is_turned(const Position& normal, const std::array<Position, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return normal.x * (uy * vz - uz * vy) + normal.y * (uz * vx - ux * vz) + normal.z * (ux * vy - uy * vx) < 0;
}

void append(StlColor color, const Color& object_color, std::vector<float>& colors) {
  const auto level = [color](int shift) { return static_cast<float>(color >> shift & 31) / 31; };
  if (color == 0)
    colors.insert(colors.end(), {object_color.r, object_color.g, object_color.b, object_color.a});
  else colors.insert(colors.end(), {level(10), level(5), level(0), 1});
}

}  // namespace

std::uint32_t StlFacets::vertex(const Position& corner, StlColor color) {
  const auto next = static_cast<std::uint32_t>(positions_.size());
  const auto is_vertex = [&](std::uint32_t index) {
    return is_same(positions_[index], corner) && (!has_colors_ || colors_[index] == color);
  };
  const std::uint32_t index = vertices_.find_or_add(hash_of(corner, color), next, is_vertex);
  if (index != next) return index;
  if (next == 0xfffffffe) throw Error("the model has more than 4294967294 vertices");
  positions_.add(corner);
  if (has_colors_) colors_.push_back(color);
  return index;
}

void StlFacets::add(const Position& normal, const std::array<Position, 3>& corners, StlColor color) {
  if (color != 0 && !has_colors_) {
    has_colors_ = true;
    colors_.assign(positions_.size(), 0);
  }
  have_normals_ |= !is_null(normal);
  const bool turns = is_turned(normal, corners);
  for (const std::size_t k : {0u, turns ? 2u : 1u, turns ? 1u : 2u})
    indices_.push_back(vertex(corners[k], color));
}

void StlFacets::move_to(Model& model, ModelUse use, const Color& object_color) {
  vertices_ = {};
  model.mesh.positions = positions_.take_floats(use, model.origin);
  model.mesh.indices = std::move(indices_);
  ModelPart part{.index_count = model.mesh.indices.size(), .uses_colors = has_colors()};
  part.material.ambient = part.material.diffuse = object_color;
  if (has_colors()) {
    part.material.ambient = part.material.diffuse = {1, 1, 1, 1};
    for (const StlColor color : colors_) append(color, object_color, model.mesh.colors);
    part.alpha = alpha_of_colors(model.mesh.colors);
  } else if (object_color.a < 1) {
    part.alpha = ModelAlpha::blend;
  }
  model.parts.push_back(std::move(part));
}

}  // namespace tessera::program
