// Cameras: look-at views and the projections of the scene format.
#include <limits>
#include <numbers>

#include "scene_parts.h"

namespace tessera::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Frustum {
  double left, right, bottom, top, near, far;
};

Mat4 look_at(Vec3 eye, Vec3 target, Vec3 up, const std::string& pointer) {
  const Vec3 forward = normalize(target - eye);
  const Vec3 side = normalize(cross(forward, up));
  const Vec3 upward = cross(side, forward);
  if (length(side) == 0) fail(pointer, "an eye away from the target and an up that is not along the view");
  return {{{{side.x, side.y, side.z, -dot(side, eye)},
            {upward.x, upward.y, upward.z, -dot(upward, eye)},
            {-forward.x, -forward.y, -forward.z, dot(forward, eye)},
            {0, 0, 0, 1}}}};
}

// Normal: z = -n goes to -w and z = -f to w. Reversed: z = -n goes to w and z = -f to 0.
Mat4 perspective_matrix(const Frustum& f, bool reversed) {
  const double n = f.near;
  const double depth = f.far - f.near;
  double scale, offset;  // clip z = scale * z + offset
  if (reversed) {
    scale = f.far == kInfinity ? 0 : n / depth;
    offset = f.far == kInfinity ? n : n * f.far / depth;
  } else {
    scale = f.far == kInfinity ? -1 : -(f.far + n) / depth;
    offset = f.far == kInfinity ? -2 * n : -2 * f.far * n / depth;
  }
  const double w = f.right - f.left;
  const double h = f.top - f.bottom;
  return {{{{2 * n / w, 0, (f.right + f.left) / w, 0},
            {0, 2 * n / h, (f.top + f.bottom) / h, 0},
            {0, 0, scale, offset},
            {0, 0, -1, 0}}}};
}

Mat4 orthographic_matrix(const Frustum& f, bool reversed) {
  const double w = f.right - f.left;
  const double h = f.top - f.bottom;
  const double depth = f.far - f.near;
  return {{{{2 / w, 0, 0, -(f.right + f.left) / w},
            {0, 2 / h, 0, -(f.top + f.bottom) / h},
            {0, 0, (reversed ? 1 : -2) / depth, (reversed ? f.far : -(f.far + f.near)) / depth},
            {0, 0, 0, 1}}}};
}

double far_plane(const Value& v) {
  if (!v) return 100;
  return v.json->is_string() && v.json->get<std::string>() == "infinity" ? kInfinity : number(v);
}

void parse_projection(const Value& v, double aspect, Camera& camera) {
  enum class Type { kPerspective, kOrthographic, kFrustum };
  ObjectReader reader(v);
  const Value type_value = reader.find("type");
  const Type type = !type_value ? Type::kPerspective
                                : choice<Type>(type_value, {{"perspective", Type::kPerspective},
                                                            {"orthographic", Type::kOrthographic},
                                                            {"frustum", Type::kFrustum}});
  Frustum f{};
  const Value near_value = reader.find("near");
  const Value reversed = reader.find("reversed");
  f.near = near_value ? number(near_value) : 0.1;
  f.far = far_plane(reader.find("far"));
  camera.reversed = reversed && boolean(reversed);
  camera.infinite_far = f.far == kInfinity;
  if (type == Type::kPerspective) {
    const Value fovy_value = reader.find("fovy");
    const double fovy = fovy_value ? number(fovy_value) : 45;
    if (!(fovy > 0 && fovy < 180)) fail(v.pointer + "/fovy", "an angle between 0 and 180");
    f.top = f.near * std::tan(fovy * std::numbers::pi / 360);
    f.bottom = -f.top;
    f.right = f.top * aspect;
    f.left = -f.right;
  } else {
    f.left = number(reader.require("left"));
    f.right = number(reader.require("right"));
    f.bottom = number(reader.require("bottom"));
    f.top = number(reader.require("top"));
  }
  reader.finish();
  if (f.left == f.right || f.bottom == f.top || f.near == f.far)
    fail(v.pointer, "a volume that is not empty");
  if (type == Type::kOrthographic) {
    if (camera.infinite_far) fail(v.pointer + "/far", "a finite far plane");
    camera.clip_from_view = orthographic_matrix(f, camera.reversed);
  } else {
    if (!(f.near > 0 && f.far > 0)) fail(v.pointer, "near and far above 0");
    camera.clip_from_view = perspective_matrix(f, camera.reversed);
  }
}

}  // namespace

Camera parse_camera(const Value& v, double aspect) {
  ObjectReader reader(v);
  Camera camera;
  const Value projection = reader.find("projection");
  if (const Value view = reader.find("view")) {
    camera.view_from_world = mat4(view);
    camera.clip_from_view = mat4(reader.require("projection"));
    const Value reversed = reader.find("reversed");
    camera.reversed = reversed && boolean(reversed);
  } else {
    const Value eye = reader.find("eye");
    const Value target = reader.find("target");
    const Value up = reader.find("up");
    camera.view_from_world = look_at(eye ? vec3(eye) : Vec3{0, 0, 4}, target ? vec3(target) : Vec3{},
                                     up ? vec3(up) : Vec3{0, 1, 0}, v.pointer);
    const Json standard = Json::object();
    parse_projection(projection ? projection : Value{&standard, v.pointer + "/projection"}, aspect, camera);
  }
  reader.finish();
  return camera;
}

Camera default_camera(double aspect) {
  const Json standard = Json::object();
  return parse_camera({&standard, "/camera"}, aspect);
}

}  // namespace tessera::reference
