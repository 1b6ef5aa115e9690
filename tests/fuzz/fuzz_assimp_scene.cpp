// From an aiScene, as assimp's readers produce it, to a picture.
#include "engine/program/import/assimp_model.h"
#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/scene/model_scene.h"
#include "tests/fuzz/assimp_scene_case.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  using namespace tessera::fuzz;
  FuzzInput bytes(data, size);
  const int kind = bytes.byte();
  const AssimpSceneCase from(bytes);
  std::optional<Model> model;
  if (error_of([&] { model = model_of(from.scene(), (kind & 2) != 0); })) return 0;
  add_creased_normals(*model, (kind & 4) != 0 ? 0 : kCreaseDegrees);
  orient_by_normals(*model);
  if (const auto error = error_of([&] { model_from_bytes(to_bytes(*model), "model"); }))
    finding("the imported scene is refused: " + *error);
  std::optional<Scene> scene;
  if (error_of([&] { scene = model_scene(*model, "model", 24, 32); })) return 0;  // the scene has no extent
  if (const auto error = error_of([&] { render_small(*scene); }))
    finding("the imported scene cannot be drawn: " + *error);
  return 0;
}
