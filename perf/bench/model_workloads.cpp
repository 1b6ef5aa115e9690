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

struct ModelFile {
  std::string path;
  std::string package;           ///< Debian's name
  std::optional<Model> model{};  ///< set by WorkloadEntry::prepare
};

/// For a scene with one draw. One-sided lighting, which is faster; the comparison of pictures shows that it
/// is sufficient.
GlWorkload gl_workload_of(const Scene& scene) {
  GlWorkload gl;
  LightModel model = scene.light_model;
  model.two_sided = false;
  for (const SceneCommand& command : scene.frame) {
    if (const auto* clear = std::get_if<Clear>(&command.value); clear != nullptr && clear->color)
      gl.clear_color = *clear->color;
    if (const auto* draw = std::get_if<DrawCommand>(&command.value)) {
      const DrawState& state = draw->state;
      gl.mesh = scene.meshes[draw->mesh];
      gl.shaders =
          rivals::lit_shaders({.camera = scene.camera.at_aspect(static_cast<double>(scene.framebuffer.width) /
                                                                scene.framebuffer.height),
                               .transform = state.transform,
                               .lights = scene.lights,
                               .model = model,
                               .material = state.material,
                               .shading = state.shading,
                               .normalizes = state.normalize});
      gl.tests_depth = true;
      gl.culls_back = state.cull == Cull::back;
    }
  }
  return gl;
}

Drawing drawing_of(const ModelFile& file, int width, int height) {
  const auto scene = std::make_shared<Scene>(model_scene(*file.model, file.path, width, height));
  Drawing drawing;
  drawing.format = scene->framebuffer;
  drawing.meshes = scene->meshes;
  drawing.record = [scene](const Drawing&, Frame& frame) { record(*scene, frame); };
  const auto draws = std::count_if(scene->frame.begin(), scene->frame.end(), [](const SceneCommand& command) {
    return std::holds_alternative<DrawCommand>(command.value);
  });
  if (draws == 1) drawing.gl_workload = [scene](const Drawing&) { return gl_workload_of(*scene); };
  return drawing;
}

WorkloadEntry model_entry(const std::string& name, const std::string& description, const std::string& path,
                          const std::string& package) {
  const auto file = std::make_shared<ModelFile>(ModelFile{path, package});
  WorkloadEntry entry =
      drawn(name, description + ", as `tessera render` shows it (package " + package + ")",
            [file](int width, int height, std::uint32_t) { return drawing_of(*file, width, height); });
  entry.missing_requirement = [file]() -> std::string {
    if (std::filesystem::exists(file->path)) return "";
    return "needs " + file->path + " of the Debian package " + file->package;
  };
  entry.prepare = [file, missing_requirement = entry.missing_requirement] {
    const std::string reason = missing_requirement();
    if (reason.empty() && !file->model) file->model = import_model(file->path, ModelUse::display);
    return reason;
  };
  return entry;
}

WorkloadEntry entry_outside_mean(const std::string& name, const std::string& description,
                                 const std::string& path, const std::string& package) {
  WorkloadEntry result = model_entry(name, description, path, package);
  result.is_in_mean = false;
  return result;
}

}  // namespace

std::vector<WorkloadEntry> model_workloads() {
  // After the bunny: the largest models in Debian 12.
  return {model_entry("bunny", "the Stanford bunny, 69,666 triangles", "/usr/share/glmark2/models/bunny.obj",
                      "glmark2-data"),
          entry_outside_mean("model-suzanne", "a subdivided monkey's head, 251,904 triangles",
                             "/usr/share/assimp/models/BLEND/SuzanneSubdiv_252.blend", "assimp-testmodels"),
          entry_outside_mean("model-ac3d", "a subdivided scene, 245,760 triangles",
                             "/usr/share/assimp/models/AC/sample_subdiv.ac", "assimp-testmodels"),
          entry_outside_mean("model-rs1", "a scanned part, 221,803 triangles",
                             "/usr/share/doc/opencv-doc/examples/surface_matching/data/rs1_normals.ply",
                             "opencv-doc"),
          entry_outside_mean("model-robot", "a 3D-printable robot, 187,974 triangles",
                             "/usr/share/cura/resources/meshes/UltimakerRobot_support.stl", "cura")};
}

}  // namespace tessera::bench
