#include "engine/program/cli/info_command.h"

#include <vector>

#include "engine/program/cli/machine_text.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/import/model.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

// The number of formats, or the reason why the module is not available.
std::string format_count(std::vector<std::string> extensions()) {
  try {
    return std::to_string(extensions().size()) + " file name extensions";
  } catch (const Error& missing) {
    return missing.what();
  }
}

}  // namespace

std::string info_text() {
  std::string text = machine_text();
  text += "image module       " + format_count(module_extensions) + "\n";
  return text + "import module      " + format_count(model_extensions) + "\n";
}

std::string formats_text() {
  std::string text = "scenes    .json\nmodels    .obj\n";
  try {
    text += "          with the import module: " + listed(model_extensions()) + "\n";
  } catch (const Error& missing) {
    text += "          " + std::string(missing.what()) + "\n";
  }
  text += "pictures  " + listed(builtin_extensions()) + "\n";
  try {
    text += "          with the image module: " + listed(module_extensions()) + "\n";
  } catch (const Error& missing) {
    text += "          " + std::string(missing.what()) + "\n";
  }
  return text + "dumps     .iff .ilbm .lbm .pcx, any other name: memory of the display mode\n";
}

}  // namespace tessera::program::cli
