// OBJ models and their materials, from text to a picture. A line "#mtl" ends the model; what follows is the
// file "m.mtl".
#include <string_view>

#include "engine/program/import/model.h"
#include "engine/program/scene/model_scene.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera;
  using namespace tessera::fuzz;
  constexpr std::string_view kEnd = "\n#mtl\n";
  const std::string text(data, data + size);
  const std::size_t end = std::min(text.find(kEnd), text.size());
  files = {{"m.obj", text.substr(0, end)}, {"m.mtl", text.substr(std::min(end + kEnd.size(), text.size()))}};
  error_of([] { import_model("m.obj", ModelUse::mesh); });
  error_of([] { render_small(model_scene(import_model("m.obj", ModelUse::display), "m.obj", 24, 32)); });
  return 0;
}
