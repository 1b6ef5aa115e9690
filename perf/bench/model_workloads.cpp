#include "perf/bench/model_workloads.h"

#include <filesystem>
#include <memory>

#include "engine/program/import/model.h"
#include "engine/program/scene/model_scene.h"
#include "perf/bench/drawn_workload.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench {
using namespace program;
namespace {

/// A model and, once it was read, its scene.
struct ModelFile {
  std::string path, package;
  std::optional<Model> model{};
};

/// Of a scene with one draw. Lit on one side, which is faster: that nothing else is seen is checked with the
/// picture.
GlWorkload gl_workload_of(const Scene& scene) {
  GlWorkload form;
  LightModel model = scene.light_model;
  model.two_sided = false;
  for (const SceneCommand& command : scene.frame) {
    if (const auto* clear = std::get_if<Clear>(&command.what); clear != nullptr && clear->color)
      form.clear_color = *clear->color;
    if (const auto* draw = std::get_if<DrawCommand>(&command.what)) {
      const DrawState& state = draw->state;
      form.mesh = scene.meshes[draw->mesh];
      form.shaders =
          rivals::lit_shaders({.camera = scene.camera.at_aspect(static_cast<double>(scene.framebuffer.width) /
                                                                scene.framebuffer.height),
                               .transform = state.transform,
                               .lights = scene.lights,
                               .model = model,
                               .material = state.material,
                               .shading = state.shading,
                               .normalizes = state.normalize});
      form.tests_depth = true;
      form.culls_back = state.cull == Cull::back;
    }
  }
  return form;
}

Drawing drawing_of(const ModelFile& file, int width, int height) {
  const auto scene = std::make_shared<Scene>(model_scene(*file.model, file.path, width, height));
  Drawing drawing;
  drawing.format = scene->framebuffer;
  drawing.meshes = scene->meshes;
  drawing.record = [scene](const Drawing&, Frame& frame) { record(*scene, frame); };
  const auto draws = std::count_if(scene->frame.begin(), scene->frame.end(), [](const SceneCommand& command) {
    return std::holds_alternative<DrawCommand>(command.what);
  });
  if (draws == 1) drawing.gl_workload = [scene](const Drawing&) { return gl_workload_of(*scene); };
  return drawing;
}

WorkloadEntry entry(const std::string& name, const std::string& what, const std::string& path,
                    const std::string& package) {
  const auto file = std::make_shared<ModelFile>(ModelFile{path, package});
  WorkloadEntry entry =
      drawn(name, what + ", as `tessera render` shows it (of the package " + package + ")",
            [file](int width, int height, std::uint32_t) { return drawing_of(*file, width, height); });
  entry.lacks = [file] {
    return std::filesystem::exists(file->path)
               ? std::string()
               : "needs " + file->path + " of Debian's package " + file->package;
  };
  entry.prepare = [file, lacks = entry.lacks] {
    const std::string reason = lacks();
    if (reason.empty() && !file->model) file->model = import_model(file->path, ModelUse::display);
    return reason;
  };
  return entry;
}

WorkloadEntry entry_outside_mean(const std::string& name, const std::string& what, const std::string& path,
                                 const std::string& package) {
  WorkloadEntry large = entry(name, what, path, package);
  large.is_in_mean = false;
  return large;
}

}  // namespace

std::vector<WorkloadEntry> model_workloads() {
  // The largest that Debian 12 has.
  return {entry("bunny", "the Stanford bunny, 69,666 triangles", "/usr/share/glmark2/models/bunny.obj",
                "glmark2-data"),
          entry_outside_mean("model-suzanne", "a subdivided monkey's head, 251,904 triangles",
                             "/usr/share/assimp/models/BLEND/SuzanneSubdiv_252.blend", "assimp-testmodels"),
          entry_outside_mean("model-ac3d", "a subdivided scene, 245,760 triangles",
                             "/usr/share/assimp/models/AC/sample_subdiv.ac", "assimp-testmodels"),
          entry_outside_mean("model-rs1", "a scanned part, 221,803 triangles",
                             "/usr/share/doc/opencv-doc/examples/surface_matching/data/rs1_normals.ply",
                             "opencv-doc"),
          entry_outside_mean("model-robot", "a robot to print, 187,974 triangles",
                             "/usr/share/cura/resources/meshes/UltimakerRobot_support.stl", "cura")};
}

}  // namespace tessera::bench
