// Cameras and lights of glTF 2 files, text and binary, which the importer reads in addition to assimp.
#include "engine/program/import/gltf_view.h"
#include "engine/program/scene/model_scene.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

namespace tessera::fuzz {
using namespace program;
namespace {

Model triangle() {
  Model model;
  model.mesh.positions = {-1, -1, 0, 1, -1, 0, 0, 1, -1};
  model.mesh.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  model.mesh.indices = {0, 1, 2};
  model.parts = {{.material_name = {}, .material = {}, .first_index = 0, .index_count = 3}};
  return model;
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  using namespace tessera::fuzz;
  Model model = triangle();
  if (error_of([&] { add_gltf_view_of_bytes(std::string(data, data + size), model); })) return 0;
  if (const auto error = error_of([&] { render_small(model_scene(model, "model", 24, 32)); }))
    finding("a view that was read is refused: " + *error);
  return 0;
}
