// Scene files: the parser, animated numbers, and the frame of a valid scene.
#include <algorithm>

#include "engine/program/scene/json_value.h"
#include "engine/program/scene/scene.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

namespace tessera::fuzz {
using namespace program;
namespace {

// Built-in meshes of millions of triangles are valid but slow. Animated details are skipped, too.
bool is_large_detail(const json::Json& detail) {
  constexpr double kMaxDetail = 12;
  return detail.is_structured() || (detail.is_number() && detail.get<double>() > kMaxDetail);
}

bool has_large_detail(const json::Json& json) {
  if (json.is_object())
    for (const auto& [key, member] : json.items())
      if ((key == "detail" && is_large_detail(member)) || has_large_detail(member)) return true;
  return json.is_array() && std::any_of(json.begin(), json.end(), has_large_detail);
}

void run(const std::string& text) {
  if (has_large_detail(json::parse(text, "scene.json"))) return;
  files = {{"scene.json", text},
           {"picture.ppm", "P6\n# two by two\n2 2 255\n" + std::string("\xff\x80\x00"
                                                                       "\x00\xff\x40"
                                                                       "\x10\x20\x30"
                                                                       "\xff\xff\xff",
                                                                       12)},
           {"model.obj",
            "v -1 -1 0\nv 1 -1 0\nv 0 1 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n"}};
  SceneFile file("scene.json");
  render_small(file.at(0));
  if (file.is_animated()) render_small(file.at(0.375));
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  error_of([&] { run(std::string(data, data + size)); });
  return 0;
}
