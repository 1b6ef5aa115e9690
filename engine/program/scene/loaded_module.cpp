#include "engine/program/scene/loaded_module.h"

#include <filesystem>

#include <dlfcn.h>

namespace tessera::program {

void* load_module(const char* file_name, const std::string& wanted_for, const char* otherwise) {
  namespace fs = std::filesystem;
  std::error_code no_program;
  const fs::path folder = fs::read_symlink("/proc/self/exe", no_program).parent_path();
  std::string reason;
  for (const fs::path& candidate : {folder / file_name, folder / "../lib" / file_name, fs::path(file_name)}) {
    std::error_code error;
    if (candidate.has_parent_path() && !fs::exists(candidate, error)) continue;
    // RTLD_LOCAL keeps its symbols private; RTLD_NOW reports unresolved ones here.
    if (void* module = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    reason = ::dlerror();
  }
  throw Error(wanted_for + " needs the module " + file_name + ", which could not be loaded (" + reason +
              "); " + otherwise);
}

void* function_of(void* module, const char* file_name, const char* name) {
  void* const function = ::dlsym(module, name);
  if (function == nullptr)
    throw Error(std::string("the module ") + file_name + " has another version: it lacks " + name);
  return function;
}

}  // namespace tessera::program
