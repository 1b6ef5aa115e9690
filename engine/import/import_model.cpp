// Who reads which file, and where: in a child.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/import/child_process.h"
#include "engine/import/import_module_interface.h"
#include "engine/import/model_bytes.h"
#include "engine/import/obj.h"
#include "engine/scene/file_ending.h"
#include "engine/scene/loaded_module.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

template <class Function>
Function* function_of_module(const char* name, const std::string& wanted_for) {
  void* const module = load_module(TESSERA_IMPORT_FILE_NAME, wanted_for, ".obj works without it");
  return reinterpret_cast<Function*>(function_of(module, TESSERA_IMPORT_FILE_NAME, name));
}

std::string import_by_module(const std::string& path) {
  std::string what = fs::path(path).extension().string();
  if (what.empty()) what = "\"" + path + "\"";
  auto* const import = function_of_module<tessera_import_function>(TESSERA_IMPORT_NAME, what);
  try {
    return taken([&](auto* take, void* user, char* message, std::size_t size) { return import(path.c_str(), take, user, message, size); });
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
}

}  // namespace

Model import_model(const std::string& path) {
  errno = 0;
  std::error_code error;
  const bool is_folder = fs::is_directory(path, error);
  if (is_folder || !std::ifstream(path)) throw Error("cannot read \"" + path + "\": " + std::strerror(is_folder ? EISDIR : errno));
  const std::string name = "reading \"" + path + "\"";
  return model_from_bytes(run_in_child(name, {}, [&] { return lower_case_ending(path) == ".obj" ? to_bytes(import_obj(path)) : import_by_module(path); }));
}

std::vector<std::string> model_endings() {
  const std::string list = run_in_child("listing the formats of models", {}, [] {
    auto* const formats = function_of_module<tessera_import_formats_function>(TESSERA_IMPORT_FORMATS_NAME, "every other format");
    return taken([&](auto* take, void* user, char* message, std::size_t size) { return formats(take, user, message, size); });
  });
  std::vector<std::string> endings;
  std::istringstream stream(list);
  for (std::string ending; std::getline(stream, ending, ',');) endings.push_back(ending);
  std::sort(endings.begin(), endings.end());
  return endings;
}

}  // namespace tessera
