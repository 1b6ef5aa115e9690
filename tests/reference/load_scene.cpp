// Top level of a scene file: light model, lights, materials. The other parts have their own files.
#include <fstream>
#include <sstream>

#include "material_presets.h"
#include "scene_parts.h"

namespace tessera::reference {
namespace {

// {"keys": [[t, value], ...]} may replace any number.
void resolve_keys(Json& json, double time) {
  const bool has_only_keys = json.is_object() && json.size() == 1 && json.contains("keys");
  if (has_only_keys && json["keys"].is_array() && !json["keys"].empty()) {
    const Json keys = json["keys"];
    std::size_t after = 0;
    while (after < keys.size() && keys[after].at(0).get<double>() < time) ++after;
    if (after == 0 || after == keys.size()) {
      json = keys[after == 0 ? 0 : after - 1].at(1);
    } else {
      const double t0 = keys[after - 1].at(0);
      const double t1 = keys[after].at(0);
      const double v0 = keys[after - 1].at(1);
      const double v1 = keys[after].at(1);
      json = v0 + (v1 - v0) * (time - t0) / (t1 - t0);
    }
    return;
  }
  if (json.is_structured())
    for (Json& member : json) resolve_keys(member, time);
}

LightModel parse_light_model(const Value& v) {
  ObjectReader reader(v);
  LightModel model;
  if (const Value ambient = reader.find("ambient")) model.ambient = vec4(ambient);
  if (const Value local = reader.find("local_viewer")) model.local_viewer = boolean(local);
  if (const Value two_sided = reader.find("two_sided")) model.two_sided = boolean(two_sided);
  if (const Value specular = reader.find("specular"))
    model.specular =
        choice<SpecularModel>(specular, {{"blinn", SpecularModel::kBlinn}, {"phong", SpecularModel::kPhong}});
  reader.finish();
  return model;
}

Light parse_light(const Value& v) {
  ObjectReader reader(v);
  Light light;
  if (const Value ambient = reader.find("ambient")) light.ambient = vec4(ambient);
  if (const Value diffuse = reader.find("diffuse")) light.diffuse = vec4(diffuse);
  if (const Value specular = reader.find("specular")) light.specular = vec4(specular);
  if (const Value position = reader.find("position")) light.position = vec4(position);
  if (const Value direction = reader.find("spot_direction")) light.spot_direction = vec3(direction);
  if (const Value exponent = reader.find("spot_exponent")) light.spot_exponent = number(exponent, 0, 16384);
  if (const Value cutoff = reader.find("spot_cutoff")) {
    light.spot_cutoff = number(cutoff);
    if (light.spot_cutoff != 180) number(cutoff, 0, 90);
  }
  if (const Value attenuation = reader.find("attenuation")) light.attenuation = numbers<3>(attenuation);
  reader.finish();
  return light;
}

Material parse_material(const Value& v) {
  ObjectReader reader(v);
  Material material;
  if (const Value preset = reader.find("preset")) material = material_preset(text(preset));
  if (const Value ambient = reader.find("ambient")) material.ambient = vec4(ambient);
  if (const Value diffuse = reader.find("diffuse")) material.diffuse = vec4(diffuse);
  if (const Value specular = reader.find("specular")) material.specular = vec4(specular);
  if (const Value emission = reader.find("emission")) material.emission = vec4(emission);
  if (const Value shininess = reader.find("shininess")) material.shininess = number(shininess, 0, 16384);
  if (const Value indexes = reader.find("color_indexes")) material.color_indexes = numbers<3>(indexes);
  reader.finish();
  return material;
}

/// Calls take(name, value) for every member.
template <class Take>
void for_each_member(const Value& v, const Take& take) {
  ObjectReader reader(v);
  for (const auto& member : v.json->items()) take(member.key(), reader.find(member.key()));
}

}  // namespace

std::vector<Light> parse_lights(const Value& v) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < array_size(v); ++i) lights.push_back(parse_light(v[i]));
  return lights;
}

Scene parse_scene(const std::string& json_text, const std::string& directory, double time) {
  Json json = Json::parse(json_text, nullptr, /*allow_exceptions=*/true, /*ignore_comments=*/true);
  resolve_keys(json, time);
  ObjectReader reader({&json, ""});
  if (integer(reader.require("tessera"), 1, 1) != 1) fail("/tessera", "1");

  Scene scene;
  if (const Value title = reader.find("title")) scene.title = text(title);
  if (const Value framebuffer = reader.find("framebuffer"))
    scene.framebuffer = parse_framebuffer(framebuffer);
  const double aspect = static_cast<double>(scene.framebuffer.width_px) / scene.framebuffer.height_px;
  const Value camera = reader.find("camera");
  scene.camera = camera ? parse_camera(camera, aspect) : default_camera(aspect);
  if (const Value model = reader.find("light_model")) scene.light_model = parse_light_model(model);
  const Value lights = reader.find("lights");
  scene.lights = lights ? parse_lights(lights) : std::vector<Light>(1);
  if (const Value materials = reader.find("materials"))
    for_each_member(materials, [&](const std::string& name, const Value& v) {
      scene.materials[name] = parse_material(v);
    });
  if (const Value meshes = reader.find("meshes"))
    for_each_member(meshes, [&](const std::string& name, const Value& v) {
      scene.meshes.push_back(parse_mesh(v, name, directory));
    });
  if (const Value textures = reader.find("textures"))
    for_each_member(textures, [&](const std::string& name, const Value& v) {
      scene.textures.push_back(parse_texture(v, name, directory));
    });
  const Value frame = reader.find("frame");
  reader.finish();
  scene.frame = frame ? parse_frame(frame, scene, directory) : default_frame(scene);
  return scene;
}

Scene load_scene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::stringstream content;
  content << file.rdbuf();
  const auto slash = path.find_last_of('/');
  try {
    return parse_scene(content.str(), slash == std::string::npos ? "" : path.substr(0, slash));
  } catch (const std::exception& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

}  // namespace tessera::reference
