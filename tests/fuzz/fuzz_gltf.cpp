// glTF files, .gltf or .glb, from bytes to a picture. Other files do not exist.
#include "engine/program/import/gltf.h"
#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/scene/model_scene.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  using namespace tessera::fuzz;
  files = {{"m.gltf", std::string(data, data + size)}};
  std::optional<Model> model;
  if (error_of([&] { model = import_gltf("m.gltf"); })) return 0;
  for (ModelPart& part : model->parts) part.texture.reset();  // images are decoded elsewhere
  orient_by_normals(*model);
  if (const auto error = error_of([&] { model_from_bytes(to_bytes(*model), "m.gltf"); }))
    finding("the model that was read is refused: " + *error);
  error_of([&] { render_small(model_scene(*model, "m.gltf", 24, 32)); });
  return 0;
}
