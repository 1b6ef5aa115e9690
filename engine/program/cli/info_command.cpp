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

std::string count_of(std::vector<std::string> endings(), const char* what) {
  try {
    return std::to_string(endings().size()) + " endings " + what;
  } catch (const Error& missing) {
    return missing.what();
  }
}

}  // namespace

std::string info_text() {
  std::string text = machine_text();
  text += "image module       " + count_of(module_extensions, "written") + "\n";
  return text + "import module      " + count_of(model_extensions, "read") + "\n";
}

std::string formats_text() {
  std::string text = "scenes    .json\nmodels    .obj\n";
  try {
    text += "          by the import module: " + listed(model_extensions()) + "\n";
  } catch (const Error& missing) {
    text += "          " + std::string(missing.what()) + "\n";
  }
  text += "pictures  " + listed(builtin_extensions()) + "\n";
  try {
    text += "          by the image module: " + listed(module_extensions()) + "\n";
  } catch (const Error& missing) {
    text += "          " + std::string(missing.what()) + "\n";
  }
  return text;
}

}  // namespace tessera::program::cli
