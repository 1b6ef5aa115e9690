// Reads cameras: look-at views with projections, or two matrices.
#include <cmath>
#include <limits>

#include "engine/program/scene/read_scene.h"

namespace tessera::program {
namespace {

using json::Json;
using json::Object;
using json::Value;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double read_far(const Value& value) {
  if (value.json().is_string() && value.text() == "infinity") return kInfinity;
  if (value.json().is_string()) value.fail("a number or \"infinity\"");
  return value.number();
}

void read_perspective(const Value& value, SceneCamera& camera) {
  const Object object(value, {"type", "fovy", "near", "far", "reversed"});
  Lens lens;
  if (const auto fovy = object.find("fovy")) {
    lens.fovy = fovy->number();
    if (!(lens.fovy > 0 && lens.fovy < 180)) fovy->fail("an angle above 0 and below 180 degrees");
  }
  if (const auto near = object.find("near")) {
    lens.near = near->number();
    if (!(lens.near > 0)) near->fail("a distance above 0");
  }
  if (const auto far = object.find("far")) {
    lens.far = read_far(*far);
    if (!(lens.far > lens.near)) far->fail("a distance above near's " + Json(lens.near).dump());
  } else if (!(lens.far > lens.near)) {
    value.refuse("near is " + Json(lens.near).dump() + ", must be below far, which is 100 by default");
  }
  camera.projection = lens;
  value.checked([&] { return camera.at_aspect(1); });  // the remaining conditions of perspective()
}

void read_planes(const Value& value, bool is_orthographic, SceneCamera& camera) {
  const Object object(value, {"type", "left", "right", "bottom", "top", "near", "far", "reversed"});
  const auto number = [&](const char* key) { return object.require(key).number(); };
  const Value far_value = object.require("far");
  const double far = read_far(far_value);
  if (is_orthographic && far == kInfinity) far_value.fail("a number: an orthographic volume is finite");
  const double left = number("left");
  const double right = number("right");
  const double bottom = number("bottom");
  const double top = number("top");
  const double near = number("near");
  camera.projection = value.checked([&] {
    return is_orthographic ? orthographic(left, right, bottom, top, near, far, camera.reversed)
                           : frustum(left, right, bottom, top, near, far, camera.reversed);
  });
}

void read_projection(const Value& value, SceneCamera& camera) {
  enum class Type { perspective, orthographic, frustum };
  const Object object(value, {"type", "fovy", "left", "right", "bottom", "top", "near", "far", "reversed"});
  const auto type_value = object.find("type");
  Type type = Type::perspective;
  if (type_value)
    type = type_value->choice<Type>({{"perspective", Type::perspective},
                                     {"orthographic", Type::orthographic},
                                     {"frustum", Type::frustum}});
  if (const auto reversed = object.find("reversed")) camera.reversed = reversed->boolean();
  if (type == Type::perspective) read_perspective(value, camera);
  else read_planes(value, type == Type::orthographic, camera);
}

}  // namespace

SceneCamera read_camera(const Value& value, const std::string& base_folder, double aspect, FileCache& cache) {
  const Object object(value, {"eye", "target", "up", "projection", "view", "reversed", "file"});
  SceneCamera camera;
  if (object.has("file"))
    return file_camera(Object(value, {"file"}).require("file"), base_folder, aspect, cache);
  if (object.has("view")) {
    const Object matrices(value, {"view", "projection", "reversed"});
    camera.view = matrices.require("view").matrix();
    camera.projection = matrices.require("projection").matrix();
    if (const auto reversed = matrices.find("reversed")) camera.reversed = reversed->boolean();
    return camera;
  }
  const auto projection = object.find("projection");
  if (const auto reversed = object.find("reversed"))
    reversed->refuse("\"reversed\" belongs in \"projection\", or next to view and projection matrices");
  if (projection && projection->json().is_array())
    value.refuse("a projection matrix needs a \"view\" matrix");
  Viewpoint viewpoint;
  if (const auto eye = object.find("eye")) viewpoint.eye = eye->vec3();
  if (const auto target = object.find("target")) viewpoint.target = target->vec3();
  if (const auto up = object.find("up")) viewpoint.up = up->vec3();
  camera = value.checked([&] { return camera_at(viewpoint, Lens{}); });
  if (projection) read_projection(*projection, camera);
  return camera;
}

SceneCamera default_camera() { return camera_at({}, {}); }

}  // namespace tessera::program
