// The module libtessera_import: the reader of 3MF, and the only code that uses assimp. The program loads it
// in a child process with limits of time and memory.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <utility>

#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include "engine/program/import/assimp_model.h"
#include "engine/program/import/import_module_interface.h"
#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/import/threemf.h"
#include "engine/program/scene/file_extension.h"
#include "engine/tessera/export.h"

namespace tessera::program {
namespace {

bool contains(const std::string& path, const std::string& word) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {}).find(word) != std::string::npos;
}

[[noreturn]] void refuse(const std::string& reason) {
  if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();  // caught inside assimp
  throw Error(reason == "No meshes remaining" ? std::string(kHoldsNothing) : reason);
}

/// Passes on how far assimp is.
class Progress : public Assimp::ProgressHandler {
 public:
  explicit Progress(ReportProgress report) : report_(std::move(report)) {}
  bool Update(float done) override {
    if (done >= 0) report_(std::min<double>(done, 1));  // -1: unknown
    return true;
  }

 private:
  ReportProgress report_;
};

Model read_by_assimp(const std::string& path, const std::string& extension, const ReportProgress& progress) {
  Assimp::Importer importer;
  importer.SetProgressHandler(new Progress(progress));  // the importer's from now on
  if (extension.empty() || !importer.IsExtensionSupported(extension))
    throw Error("the file name extension is \"" + extension +
                "\", expected one of those listed by \"tessera formats\"");
  // GenUVCoords: texture coordinates of materials that wrap a picture around a box, sphere or cylinder.
  const aiScene* const scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                  aiProcess_SortByPType | aiProcess_GenUVCoords);
  if (scene == nullptr) refuse(importer.GetErrorString());
  const bool is_collada = extension == ".dae" || extension == ".zae";
  Model model = model_of(*scene, is_collada);
  // assimp reads an orthographic camera of Collada as a perspective of a few degrees.
  if (extension == ".dae" && !model.cameras.empty() && contains(path, "<orthographic>")) {
    model.cameras.clear();
    model.warnings.push_back("has an orthographic camera: the cameras of such Collada files are left out");
  }
  return model;
}

Model read(const std::string& path, const ReportProgress& progress) {
  const std::string extension = lower_case_extension(path);
  const ReportProgress reading = part_of(progress, 0, 0.8);
  Model model = extension == ".3mf" ? read_threemf(path, reading) : read_by_assimp(path, extension, reading);
  add_creased_normals(model, kCreaseDegrees, part_of(progress, 0.8, 1));
  for (std::string& warning : model.warnings) warning = path + ": " + warning;
  return model;
}

std::string formats() {
  Assimp::Importer importer;
  std::string list;
  importer.GetExtensionList(list);  // "*.3ds;*.obj"
  std::erase(list, '*');
  std::replace(list.begin(), list.end(), ';', ',');
  return list;
}

template <class Work>
int answer(const Work& work, tessera_import_take_function* take, void* user, char* message,
           std::size_t message_size) {
  try {
    const std::string bytes = work();
    take(user, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    return 0;
  } catch (const std::bad_alloc&) {
    return 2;
  } catch (const std::exception& error) {
    std::snprintf(message, message_size, "%s", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace tessera::program

extern "C" TESSERA_API int tessera_import_5(const char* path, tessera_import_progress_function* progress,
                                            void* progress_user, tessera_import_take_function* take,
                                            void* user, char* message, std::size_t message_size) {
  const auto report = [&](double done) { progress(progress_user, done); };
  return tessera::program::answer(
      [&] { return tessera::program::to_bytes(tessera::program::read(path, report)); }, take, user, message,
      message_size);
}

extern "C" TESSERA_API int tessera_import_formats_1(tessera_import_take_function* take, void* user,
                                                    char* message, std::size_t message_size) {
  return tessera::program::answer([] { return tessera::program::formats(); }, take, user, message,
                                  message_size);
}
