#include "engine/program/import/model_axes.h"

#include <array>
#include <cstddef>

#include "engine/program/scene/file_extension.h"

namespace tessera::program {
namespace {

/// A rotation by quarter turns: component k is sign[k] times component from[k] of the file.
struct AxisTurn {
  std::array<std::size_t, 3> from;
  std::array<int, 3> sign;
};
AxisTurn turn_of(UpAxis axis) {
  switch (axis) {
    case UpAxis::x: return {{1, 0, 2}, {-1, 1, 1}};
    case UpAxis::z: return {{0, 2, 1}, {1, 1, -1}};
    case UpAxis::x_down: return {{1, 0, 2}, {1, -1, 1}};
    case UpAxis::y_down: return {{0, 1, 2}, {-1, -1, 1}};
    case UpAxis::z_down: return {{0, 2, 1}, {1, -1, 1}};
    case UpAxis::y: break;
  }
  return {{0, 1, 2}, {1, 1, 1}};
}

template <class Number>
void turn(const AxisTurn& turn, Number* v) {
  const std::array<Number, 3> old{v[0], v[1], v[2]};
  for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<Number>(turn.sign[k]) * old[turn.from[k]];
}

}  // namespace

UpAxis up_axis_of(const std::string& path) {
  const std::string extension = lower_case_extension(path);
  return extension == ".3mf" || extension == ".smd" || extension == ".vta" ? UpAxis::z : UpAxis::y;
}

void turn_up(UpAxis axis, Model& model) {
  if (axis == UpAxis::y) return;
  const AxisTurn by = turn_of(axis);
  for (std::size_t i = 0; i + 2 < model.mesh.positions.size(); i += 3) turn(by, &model.mesh.positions[i]);
  for (std::size_t i = 0; i + 2 < model.mesh.normals.size(); i += 3) turn(by, &model.mesh.normals[i]);
  for (ModelCamera& camera : model.cameras)  // view * inverse of the turn: rows turn like vectors
    for (std::size_t row = 0; row < 3; ++row) turn(by, &camera.view.m[4 * row]);
  for (Light& light : model.lights) {
    turn(by, light.position.data());
    turn(by, light.spot_direction.data());
  }
  std::array<double, 3> origin{model.origin.x, model.origin.y, model.origin.z};
  turn(by, origin.data());
  model.origin = {origin[0], origin[1], origin[2]};
}

}  // namespace tessera::program
