// Data from the process that reads a model, in case that process is compromised.
#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/scene/model_scene.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  using namespace tessera::fuzz;
  const std::string bytes(data, data + size);
  std::optional<Model> model;
  if (error_of([&] { model = model_from_bytes(bytes, "model"); })) return 0;
  require(to_bytes(*model) == bytes, "serialization changed the model");
  error_of([&] { render_small(model_scene(*model, "model", 24, 32)); });
  // The reading process holds the same model.
  add_creased_normals(*model);
  orient_by_normals(*model);
  error_of([&] { render_small(model_scene(*model, "model", 32, 24)); });
  return 0;
}
