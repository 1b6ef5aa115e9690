// Reads the top level of a scene file, frame buffer, light model, lights and materials.
#include "engine/program/scene/read_scene.h"

#include <cstdint>
#include <filesystem>
#include <utility>

#include "engine/program/scene/animate.h"
#include "engine/program/scene/chosen_palette.h"
#include "engine/program/scene/dither_names.h"
#include "engine/program/scene/embedded.h"
#include "engine/program/scene/scene_mode.h"
#include "engine/program/scene/state_names.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

using json::Json;
using json::Object;
using json::Value;

void read_palette(const Value& value, Scene& scene) {
  FrameBufferFormat& format = scene.framebuffer;
  if (value.json().is_string()) {
    scene.palette_name = value.choice<std::string>({{"bw", "bw"},
                                                    {"gray", "gray"},
                                                    {"ega16", "ega16"},
                                                    {"vga256", "vga256"},
                                                    {"web216", "web216"},
                                                    {"adaptive", ""},
                                                    {"ramps", ""}});
    scene.palette_source = palette_source(value.text());
    if (scene.palette_source != PaletteSource::given) return;
    format.palette = value.checked([&] { return named_palette(scene.palette_name, format.color_bits); });
    return;
  }
  const std::size_t max_entries = std::size_t{1} << format.color_bits;
  if (!value.json().is_array()) value.fail("the name of a palette or a list of [r, g, b]");
  if (value.size() == 0 || value.size() > max_entries)
    value.fail("1 to " + std::to_string(max_entries) + " entries for " + std::to_string(format.color_bits) +
               " bits");
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value entry = value.element(i);
    if (!entry.json().is_array() || entry.size() != 3) entry.fail("[r, g, b]");
    format.palette.push_back(
        {entry.element(0).real(0, 1), entry.element(1).real(0, 1), entry.element(2).real(0, 1), 1});
  }
}

// Gives the scene's mode the palette that read_palette() read into the frame buffer.
void set_read_palette(Scene& scene) {
  const std::vector<Color> entries = std::move(scene.framebuffer.palette);
  scene.framebuffer.palette = scene.mode->palette;
  if (scene.palette_source == PaletteSource::given) set_mode_palette(entries, scene);
  else set_mode_palette(scene.palette_source, scene);
  scene.palette_name.clear();
}

// Pictures of an animation that share a chosen palette.
void read_palette_over(const Value& value, Scene& scene) {
  if (scene.palette_source == PaletteSource::given)
    value.refuse("needs \"palette\": \"adaptive\" or \"ramps\"");
  scene.palette_over = value.choice<PaletteOver>({{"animation", PaletteOver::animation},
                                                  {"frame", PaletteOver::frame},
                                                  {"smooth", PaletteOver::smooth}});
  value.checked([&] { check_palette_over(scene); });
}

// Size, colours and palette by a display mode.
void read_mode(const Object& object, Scene& scene) {
  const Value mode = object.require("mode");
  for (const char* const key : {"width", "height", "color"})
    if (const auto other = object.find(key)) other->refuse("the display mode determines it");
  mode.checked([&] { set_mode(named_display_mode(mode.text()), scene); });
  if (const auto palette = object.find("palette")) {
    if (scene.framebuffer.color_mode != ColorMode::index)
      palette->refuse("the display mode has no palette: its pixels hold colour components");
    scene.framebuffer.palette.clear();
    read_palette(*palette, scene);
    palette->checked([&] { set_read_palette(scene); });
  }
  if (const auto reduce = object.find("reduce"); reduce && reduce->boolean()) reduce_to_mode(scene);
}

// Size, colours and palette of a scene without a display mode.
void read_colors(const Object& object, Scene& scene) {
  FrameBufferFormat& format = scene.framebuffer;
  if (const auto reduce = object.find("reduce")) reduce->refuse("needs a display \"mode\"");
  if (const auto width = object.find("width"))
    format.width = static_cast<int>(width->integer(1, kMaxFrameBufferSize));
  if (const auto height = object.find("height"))
    format.height = static_cast<int>(height->integer(1, kMaxFrameBufferSize));
  if (const auto color = object.find("color")) {
    const Object parts(*color, {"mode", "bits"});
    if (const auto mode = parts.find("mode"))
      format.color_mode = mode->choice<ColorMode>({{"rgb", ColorMode::rgb}, {"index", ColorMode::index}});
    if (const auto bits = parts.find("bits")) format.color_bits = static_cast<int>(bits->integer(1, 24));
  }
  if (const auto palette = object.find("palette")) {
    if (format.color_mode != ColorMode::index)
      palette->refuse("a palette needs \"color\": {\"mode\": \"index\"}");
    read_palette(*palette, scene);
  }
}

void read_dither(const Object& object, FrameBufferFormat& format) {
  if (const auto dither = object.find("dither")) format.dither = dither->choice<Dither>(kDithers);
  if (const auto space = object.find("dither_in"))
    format.dither_in =
        space->choice<DitherSpace>({{"levels", DitherSpace::levels}, {"light", DitherSpace::light}});
  if (const auto gamma = object.find("dither_gamma")) format.dither_gamma = gamma->number(1, 4);
}

void read_framebuffer(const Value& value, Scene& scene) {
  const Object object(
      value, {"mode", "reduce", "width", "height", "color", "palette", "palette_over", "dither", "dither_in",
              "dither_gamma", "alpha", "depth", "stencil", "accumulation", "samples"});
  FrameBufferFormat& format = scene.framebuffer;
  if (object.has("mode")) read_mode(object, scene);
  else read_colors(object, scene);
  if (const auto over = object.find("palette_over")) read_palette_over(*over, scene);
  if (const auto depth = object.find("depth"))
    format.depth = depth->choice<DepthFormat>({{"none", DepthFormat::none},
                                               {"unorm16", DepthFormat::unorm16},
                                               {"unorm24", DepthFormat::unorm24},
                                               {"unorm32", DepthFormat::unorm32},
                                               {"float32", DepthFormat::float32}});
  if (const auto stencil = object.find("stencil"))
    format.stencil_bits = static_cast<int>(stencil->integer(0, 8));
  read_dither(object, scene.reduced ? *scene.reduced : format);
  if (const auto alpha = object.find("alpha")) {
    if (alpha->json() != Json(0) && alpha->json() != Json(8)) alpha->fail("0 or 8 bits");
    format.alpha_bits = static_cast<int>(alpha->integer(0, 8));
    if (format.alpha_bits > 0 && format.color_mode == ColorMode::index)
      alpha->refuse("an index buffer has no alpha planes");
  }
  if (const auto accumulation = object.find("accumulation")) {
    if (accumulation->json() != Json(0) && accumulation->json() != Json(16) &&
        accumulation->json() != Json(32))
      accumulation->fail("0, 16 or 32 bits");
    format.accumulation_bits = static_cast<int>(accumulation->integer(0, 32));
    if (format.accumulation_bits > 0 && format.color_mode == ColorMode::index)
      accumulation->refuse("an index buffer does not accumulate");
  }
  if (const auto samples = object.find("samples")) {
    if (samples->json() != Json(1) && samples->json() != Json(4) && samples->json() != Json(8))
      samples->fail("1, 4 or 8");
    format.samples = static_cast<int>(samples->integer(1, 8));
    if (format.samples > 1 && format.color_mode == ColorMode::index)
      samples->refuse("an index buffer has one sample a pixel");
  }
}

LightModel read_light_model(const Value& value) {
  const Object object(value, {"ambient", "local_viewer", "two_sided", "specular"});
  LightModel model;
  if (const auto ambient = object.find("ambient")) model.ambient = ambient->color();
  if (const auto local = object.find("local_viewer")) model.local_viewer = local->boolean();
  if (const auto two_sided = object.find("two_sided")) model.two_sided = two_sided->boolean();
  if (const auto specular = object.find("specular")) model.specular = specular->choice(kSpecularModels);
  return model;
}

constexpr double kMaxExponent = 16384;  // largest shininess and spot exponent

Light read_light(const Value& value) {
  const Object object(value, {"ambient", "diffuse", "specular", "position", "spot_direction", "spot_exponent",
                              "spot_cutoff", "attenuation"});
  Light light;
  if (const auto ambient = object.find("ambient")) light.ambient = ambient->color();
  if (const auto diffuse = object.find("diffuse")) light.diffuse = diffuse->color();
  if (const auto specular = object.find("specular")) light.specular = specular->color();
  if (const auto position = object.find("position")) {
    const Color p = position->color();
    light.position = {p.r, p.g, p.b, p.a};
  }
  if (const auto direction = object.find("spot_direction")) {
    if (!direction->json().is_array() || direction->size() != 3) direction->fail("an array of 3 numbers");
    for (std::size_t i = 0; i < 3; ++i) light.spot_direction[i] = direction->element(i).real();
  }
  if (const auto exponent = object.find("spot_exponent"))
    light.spot_exponent = exponent->real(0, kMaxExponent);
  if (const auto cutoff = object.find("spot_cutoff")) {
    light.spot_cutoff = cutoff->real();
    if (light.spot_cutoff != 180 && !(light.spot_cutoff >= 0 && light.spot_cutoff <= 90))
      cutoff->fail("0 to 90 degrees, or 180");
  }
  if (const auto attenuation = object.find("attenuation")) {
    if (!attenuation->json().is_array() || attenuation->size() != 3)
      attenuation->fail("an array of 3 numbers");
    light.attenuation_constant = attenuation->element(0).real();
    light.attenuation_linear = attenuation->element(1).real();
    light.attenuation_quadratic = attenuation->element(2).real();
  }
  return light;
}

Material read_material(const Value& value) {
  const Object object(value,
                      {"preset", "ambient", "diffuse", "specular", "emission", "shininess", "color_indexes"});
  Material material;
  if (const auto preset = object.find("preset")) {
    const std::vector<std::string_view> names = material_names();
    const auto named = named_material(preset->text());
    if (!named) preset->fail("one of " + json::quoted_list(names));
    material = *named;
  }
  if (const auto ambient = object.find("ambient")) material.ambient = ambient->color();
  if (const auto diffuse = object.find("diffuse")) material.diffuse = diffuse->color();
  if (const auto specular = object.find("specular")) material.specular = specular->color();
  if (const auto emission = object.find("emission")) material.emission = emission->color();
  if (const auto shininess = object.find("shininess")) material.shininess = shininess->real(0, kMaxExponent);
  if (const auto indexes = object.find("color_indexes")) {
    if (!indexes->json().is_array() || indexes->size() != 3) indexes->fail("an array of 3 numbers");
    material.index_ramp = {indexes->element(0).real(), indexes->element(1).real(),
                           indexes->element(2).real()};
  }
  return material;
}

}  // namespace

LightList read_lights(const Value& value, const std::string& base_folder, FileCache& cache) {
  LightList lights;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value element = value.element(i);
    if (!element.json().is_object() || !element.json().contains("file")) {
      lights.push_back(read_light(element));
      continue;
    }
    const LightList of_file = file_lights(Object(element, {"file"}).require("file"), base_folder, cache);
    lights.insert(lights.end(), of_file.begin(), of_file.end());
  }
  return lights;
}

Materials read_materials(const Value& value) {
  Materials materials;
  value.for_each_member(
      [&](const std::string& name, const Value& member) { materials[name] = read_material(member); });
  return materials;
}

namespace {

Scene read_scene(const Json& json, const std::string& name, const std::string& base_folder,
                 FileCache& cache) {
  const Object top(Value(json, "", name), {"tessera", "title", "framebuffer", "camera", "light_model",
                                           "lights", "quality", "materials", "textures", "meshes", "frame"});
  const Value version = top.require("tessera");
  if (version.json() != Json(1)) version.fail("1, the version of the scene format");

  Scene scene{.name = name};
  if (const auto title = top.find("title")) scene.title = title->text();
  if (const auto framebuffer = top.find("framebuffer")) read_framebuffer(*framebuffer, scene);
  const double aspect = static_cast<double>(scene.framebuffer.width) / scene.framebuffer.height;
  const auto camera = top.find("camera");
  scene.camera = camera ? read_camera(*camera, base_folder, aspect, cache) : default_camera();
  if (const auto model = top.find("light_model")) scene.light_model = read_light_model(*model);
  if (const auto lights = top.find("lights")) scene.lights = read_lights(*lights, base_folder, cache);
  if (const auto quality = top.find("quality")) scene.quality = read_quality(*quality);
  FrameNames names;
  if (const auto materials = top.find("materials")) names.materials = read_materials(*materials);
  if (const auto textures = top.find("textures"))
    names.textures = read_textures(*textures, base_folder, cache, scene);
  const auto frame = top.find("frame");
  if (const auto meshes = top.find("meshes")) {
    meshes->for_each_member([&](const std::string& mesh, const Value&) { names.meshes.push_back(mesh); });
    names.file_draws = read_meshes(*meshes, mesh_uses(frame, names.meshes), base_folder, cache, scene);
  }
  scene.frame = frame ? read_frame(*frame, scene, names, base_folder, cache) : default_frame(scene, names);
  return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::string& base_folder) {
  Json json = json::parse(text, name);
  json::animate(json, 0, name);
  FileCache models;
  return read_scene(json, name, base_folder, models);
}

struct SceneFile::Content {
  std::string path;
  Json json;
  bool animated = false;
  FileCache models;
};

SceneFile::SceneFile(const std::string& path, const ImportOptions& options)
    : content_(std::make_unique<Content>()) {
  content_->models.import = options;
  content_->path = path;
  content_->json = json::parse(read_text_file(path), path);
  Json still = content_->json;
  content_->animated = json::animate(still, 0, path);
}
SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;

bool SceneFile::is_animated() const { return content_->animated; }

bool SceneFile::has_models() const { return !content_->models.models.empty(); }

Scene SceneFile::at(double time) {
  Json json = content_->json;
  json::animate(json, time, content_->path);
  return read_scene(json, content_->path, std::filesystem::path(content_->path).parent_path().string(),
                    content_->models);
}

Scene load_scene(const std::string& path) { return SceneFile(path).at(0); }

Scene builtin_scene() { return parse_scene(kBuiltinScene, "(built-in scene)"); }

}  // namespace tessera::program
