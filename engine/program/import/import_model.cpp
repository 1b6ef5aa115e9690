// Selects the reader of a model file and runs it in a child process.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/program/import/child_process.h"
#include "engine/program/import/gltf.h"
#include "engine/program/import/import_module_interface.h"
#include "engine/program/import/memory_limit.h"
#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_images.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/import/obj.h"
#include "engine/program/import/ply.h"
#include "engine/program/import/stl.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/loaded_module.h"

namespace tessera::program {
namespace {

namespace fs = std::filesystem;

template <class Function>
Function* import_module_function(const char* name, const std::string& wanted_for) {
  void* const module =
      load_module(TESSERA_IMPORT_FILE_NAME, wanted_for, ".obj, .gltf, .glb, .ply and .stl work without it");
  return reinterpret_cast<Function*>(function_of(module, TESSERA_IMPORT_FILE_NAME, name));
}

std::string import_by_module(const std::string& path, const ReportProgress& progress) {
  std::string what = fs::path(path).extension().string();
  if (what.empty()) what = "\"" + path + "\"";
  auto* const import = import_module_function<tessera_import_function>(TESSERA_IMPORT_NAME, what);
  try {
    return collect_bytes([&](auto* take, void* user, char* message, std::size_t size) {
      const auto report = [](void* to, double done) { (*static_cast<const ReportProgress*>(to))(done); };
      return import(path.c_str(), report, const_cast<ReportProgress*>(&progress), take, user, message, size);
    });
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
}

Model read_by_extension(const std::string& path, ModelUse use, const ReportProgress& progress) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".obj") return import_obj(path, use, part_of(progress, 0, 0.9));
  if (extension == ".ply") return import_ply(path, use, part_of(progress, 0, 0.7));
  if (extension == ".gltf" || extension == ".glb") return import_gltf(path, part_of(progress, 0, 0.7));
  return model_from_bytes(import_by_module(path, part_of(progress, 0, 0.7)), path);
}

/// A mesh has no use for images.
void drop_image_bytes(Model& model) {
  for (ModelImage& image : model.images) image.encoded.clear();
}

bool is_visible(const ModelPart& part, const Model& model) {
  if (part.alpha != ModelAlpha::blend) return true;
  if (!part.uses_colors) return part.material.diffuse.a > 0;
  for (std::size_t i = part.first_index; i < part.first_index + part.index_count; ++i)
    if (model.mesh.colors[4 * std::size_t{model.mesh.indices[i]} + 3] > 0) return true;
  return false;
}

/// Some exporters write the opacity of opaque materials as 0. A model of which nothing would be seen is
/// opaque.
void keep_visible(const std::string& path, Model& model) {
  if (std::ranges::any_of(model.parts, [&](const ModelPart& part) { return is_visible(part, model); }))
    return;
  for (ModelPart& part : model.parts) {
    part.alpha = ModelAlpha::opaque;
    part.material.diffuse.a = 1;
  }
  for (std::size_t i = 3; i < model.mesh.colors.size(); i += 4) model.mesh.colors[i] = 1;
  model.warnings.push_back(path + ": the opacity of all materials is 0; they are drawn opaque");
}

Model read_file(const std::string& path, ModelUse use, const ReportProgress& progress) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".stl") return import_stl(path, use, progress);
  Model model = read_by_extension(path, use, progress);
  if (use == ModelUse::display) {
    keep_visible(path, model);
    decode_images(path, model);
    complete_normals(model, part_of(progress, 0.7, 1));
  } else {
    drop_image_bytes(model);
  }
  return model;
}

ChildLimits child_limits(const std::string& path, const ImportOptions& options) {
  ChildLimits limits{.time = std::chrono::seconds(options.seconds),
                     .memory_bytes = options.memory_bytes,
                     .should_continue = options.should_continue};
  if (limits.memory_bytes == 0) limits.memory_bytes = default_import_memory();
  limits.result_bytes = limits.memory_bytes;
  if (options.progress) limits.progress = [&options, path](double done) { options.progress(path, done); };
  return limits;
}

}  // namespace

Model import_model(const std::string& path, ModelUse use, const ImportOptions& options) {
  errno = 0;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw Error("cannot read \"" + path + "\": " + (error ? error.message() : std::strerror(ENOENT)));
  if (!fs::is_regular_file(status))
    throw Error("cannot read \"" + path + "\": it is " +
                (fs::is_directory(status) ? "a directory" : "not a regular file") + ", expected a model");
  if (!std::ifstream(path)) throw Error("cannot read \"" + path + "\": " + std::strerror(errno));
  const auto send = [&](ChildOutput& output) {
    const Model model = read_file(path, use, [&output](double done) { output.report(done); });
    output.begin_result(model_byte_count(model));
    write_model(model, [&output](const char* bytes, std::size_t count) { output.write(bytes, count); });
  };
  Model model;
  run_in_child("reading \"" + path + "\"", child_limits(path, options), send,
               [&](const ByteReader& read, std::uint64_t bytes) { model = read_model(read, bytes, path); });
  return model;
}

std::vector<std::string> model_extensions() {
  const std::string list = run_in_child("listing the formats of models", {}, [] {
    auto* const formats = import_module_function<tessera_import_formats_function>(TESSERA_IMPORT_FORMATS_NAME,
                                                                                  "every other format");
    return collect_bytes([&](auto* take, void* user, char* message, std::size_t size) {
      return formats(take, user, message, size);
    });
  });
  std::vector<std::string> extensions;
  std::istringstream stream(list);
  for (std::string extension; std::getline(stream, extension, ',');) extensions.push_back(extension);
  std::sort(extensions.begin(), extensions.end());
  return extensions;
}

}  // namespace tessera::program
