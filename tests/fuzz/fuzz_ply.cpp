// PLY models in all formats, from bytes to a picture.
#include <string_view>

#include "engine/program/import/model_file.h"
#include "engine/program/import/ply.h"
#include "tests/fuzz/read_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  read_and_render("m.ply", {reinterpret_cast<const char*>(data), size}, read_ply);
  return 0;
}
