#include "engine/program/import/gltf_view.h"

#include "engine/program/import/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/program/import/spot_exponent.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

using Json = nlohmann::json;

constexpr int kMaxNodeVisits = 1000000;

// Returns the text of a .gltf, or the first chunk of a .glb, whose header is the five words "glTF", version,
// file length, chunk length, "JSON".
std::string json_text(const std::string& bytes) {
  if (!bytes.starts_with("glTF")) return bytes;
  std::uint32_t header[5] = {};
  if (bytes.size() < sizeof header) return {};
  std::memcpy(header, bytes.data(), sizeof header);
  return bytes.substr(sizeof header, header[3]);
}

Matrix from_quaternion(double x, double y, double z, double w) {
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0,  //
           2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0,  //
           2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0,  //
           0, 0, 0, 1}};
}

Matrix local_matrix(const Json& node) {
  if (node.contains("matrix")) {
    const auto columns = node["matrix"].get<std::array<double, 16>>();
    Matrix m;
    for (std::size_t k = 0; k < 16; ++k) m.m[k] = columns[4 * (k % 4) + k / 4];
    return m;
  }
  const auto t = node.value("translation", std::array<double, 3>{0, 0, 0});
  const auto s = node.value("scale", std::array<double, 3>{1, 1, 1});
  const auto r = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
  return translate(t[0], t[1], t[2]) * from_quaternion(r[0], r[1], r[2], r[3]) * scale(s[0], s[1], s[2]);
}

struct NoSuchElement : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns list[index]; `kind` names the elements in the message. nlohmann would cast any number to
// std::size_t, which is undefined for numbers out of range.
const Json& element(const Json& list, const Json& index, const char* kind) {
  if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= list.size())
    throw NoSuchElement("found " + (index.is_number() ? index.dump() : index.type_name()) +
                        ", expected the index of one of " + std::to_string(list.size()) + " " + kind);
  return list.at(index.get<std::size_t>());
}

Vec3 column(const Matrix& m, std::size_t k) { return {m.m[k], m.m[4 + k], m.m[8 + k]}; }

class ViewReader {
 public:
  ViewReader(const Json& file, Model& model) : file_(file), model_(model) {}

  void read() {
    if (!file_.contains("scenes") || file_.at("scenes").empty()) return;
    const Json first = 0u;
    visit_all(element(file_.at("scenes"), file_.contains("scene") ? file_.at("scene") : first, "scenes"),
              "nodes", Matrix{}, 0);
  }

 private:
  // `owner` is a node or a scene. Takes references only: copying nested JSON recurses.
  void visit_all(const Json& owner, const char* list, const Matrix& parent, int depth) {
    if (owner.is_object() && !owner.contains(list)) return;
    for (const Json& index : owner.at(list).get_ref<const Json::array_t&>())
      visit(element(file_.at("nodes"), index, "nodes"), parent, depth);
  }

  void visit(const Json& node, const Matrix& parent, int depth) {
    if (depth > kMaxNodeDepth || ++visits_ > kMaxNodeVisits)
      throw Error("has more than " + std::to_string(kMaxNodeVisits) + " nodes, or nodes nested deeper than " +
                  std::to_string(kMaxNodeDepth) + " levels");
    const Matrix world = parent * local_matrix(node);
    if (node.contains("camera"))
      add_camera(element(file_.at("cameras"), node.at("camera"), "cameras"), world);
    if (node.contains(light_)) add_light(element(file_.at(lights_), node.at(light_), "lights"), world);
    visit_all(node, "children", world, depth + 1);
  }

  void add_camera(const Json& camera, const Matrix& world) {
    ModelCamera to;
    to.is_orthographic = camera.at("type") == "orthographic";
    const Json& lens = camera.at(to.is_orthographic ? "orthographic" : "perspective");
    to.near = lens.value("znear", 0.0);
    to.far = lens.value("zfar", 0.0);
    if (to.is_orthographic) {
      to.half_height = std::abs(lens.value("ymag", 0.0));
    } else {
      const double angle = lens.value("yfov", 0.0);
      if (!(angle > 0 && angle < std::numbers::pi)) return warn_of_angle(angle);
      const SinCos half = sin_cos_degrees(angle / 2 * kDegreesPerRadian);
      to.half_height = half.sine / half.cosine;
    }
    if (!(to.half_height > 0) || !std::isfinite(to.half_height)) return;
    const Vec3 eye = column(world, 3);
    const Vec3 back = column(world, 2);
    try {
      to.view = look_at(eye, {eye.x - back.x, eye.y - back.y, eye.z - back.z}, column(world, 1));
    } catch (const Error&) {
      return;  // a node scaled to zero has no direction
    }
    model_.cameras.push_back(to);
  }

  // Warns once per file.
  void warn_of_angle(double angle) {
    if (!std::exchange(has_warned_, true))
      model_.warnings.push_back("a perspective camera is left out: found an angle of " + Json(angle).dump() +
                                ", expected one between 0 and pi");
  }

  void add_light(const Json& light, const Matrix& world) {
    const auto color = light.value("color", std::array<double, 3>{1, 1, 1});
    const double unit = light.value("intensity", 1.0) / std::numbers::pi;
    Light to;
    to.diffuse = to.specular = {display_referred(color[0] * unit), display_referred(color[1] * unit),
                                display_referred(color[2] * unit), 1};
    const Vec3 place = column(world, 3);
    const Vec3 back = column(world, 2);
    const auto& type = light.at("type").get_ref<const std::string&>();
    if (type == "directional") {
      to.position = {static_cast<float>(back.x), static_cast<float>(back.y), static_cast<float>(back.z), 0};
    } else {
      to.position = {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z),
                     1};
      to.attenuation_constant = 0;
      to.attenuation_linear = 1;
    }
    if (type == "spot") {
      const double inner = light.value("/spot/innerConeAngle"_json_pointer, 0.0);
      const double outer = light.value("/spot/outerConeAngle"_json_pointer, std::numbers::pi / 4);
      to.spot_direction = {static_cast<float>(-back.x), static_cast<float>(-back.y),
                           static_cast<float>(-back.z)};
      to.spot_cutoff = static_cast<float>(std::clamp(outer * kDegreesPerRadian, 0.0, 90.0));
      to.spot_exponent = spot_exponent_from_cone(inner, outer);
    }
    const auto is_finite = [](const auto& list) {
      return std::all_of(list.begin(), list.end(), [](float x) { return std::isfinite(x); });
    };
    if (is_finite(to.position) && is_finite(to.spot_direction) &&
        std::isfinite(to.diffuse.r + to.diffuse.g + to.diffuse.b))
      model_.lights.push_back(to);
  }

  const Json::json_pointer light_{"/extensions/KHR_lights_punctual/light"};
  const Json::json_pointer lights_{"/extensions/KHR_lights_punctual/lights"};
  const Json& file_;
  Model& model_;
  int visits_ = 0;
  bool has_warned_ = false;
};

}  // namespace

bool add_gltf_view_of_bytes(const std::string& bytes, Model& model) {
  const Json file = Json::parse(json_text(bytes), nullptr, false);
  const auto place = "/asset/version"_json_pointer;
  if (!file.contains(place)) return false;
  const Json& version = file.at(place);
  if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2")) return false;
  const auto warn = [&model](const std::exception& error) {
    model.warnings.push_back("not all of its cameras and lights could be read: " + std::string(error.what()));
  };
  try {
    ViewReader(file, model).read();
  } catch (const Json::exception& error) {
    warn(error);
  } catch (const NoSuchElement& error) {
    warn(error);
  }
  return true;
}

}  // namespace tessera::program
