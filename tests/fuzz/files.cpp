#include "tests/fuzz/files.h"

#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/import/obj.h"
#include "engine/program/scene/text_file.h"
#include "tests/fuzz/target.h"

namespace tessera {
using namespace program;

std::map<std::string, std::string, std::less<>> fuzz::files;

std::string read_text_file(const std::string& path, std::size_t) {
  const auto found = fuzz::files.find(path);
  if (found == fuzz::files.end()) throw Error("cannot read \"" + path + "\": No such file or directory");
  return found->second;
}

void refuse_device_or_pipe(const std::string&) {}

// Reads OBJ files as the real import_model() does, without a child process.
Model import_model(const std::string& path, ModelUse use, const ImportOptions&) {
  Model model = import_obj(path, use);
  if (use == ModelUse::display) {
    if (model.mesh.normals.empty()) add_creased_normals(model);
    orient_by_normals(model);
  }
  const std::string bytes = to_bytes(model);
  std::optional<Model> received;
  if (const auto error = fuzz::error_of([&] { received = model_from_bytes(bytes, path); }))
    fuzz::finding("the result of import_obj is refused: " + *error);
  fuzz::require(to_bytes(*received) == bytes, "serialization changed the model");
  return std::move(*received);
}

}  // namespace tessera
