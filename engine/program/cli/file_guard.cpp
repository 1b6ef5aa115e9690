#include "engine/program/cli/file_guard.h"

#include <filesystem>

#include <sys/stat.h>

#include "engine/program/imageio/picture.h"

namespace tessera::program::cli {

namespace fs = std::filesystem;

FileGuard::FileGuard(const std::set<std::string>& inputs, const std::string& reference,
                     std::string default_picture)
    : default_picture_(std::move(default_picture)) {
  for (const std::string& file : inputs)
    if (const auto id = id_of(file)) inputs_.insert(*id);
  if (!reference.empty()) reference_ = id_of(reference);
}

void FileGuard::check_picture(const std::string& file) const {
  check(file, "file with -o");
  std::error_code error;  // what cannot be looked at is told by whoever writes it
  if (default_picture_.empty() || !fs::exists(file, error)) return;
  if (!fs::is_regular_file(file, error))
    throw Error("\"" + file + "\" is there already, and is no regular file; name another file with -o");
  if (!is_tessera_png(file))
    throw Error("\"" + file + "\" is there already, and does not say that Tessera made it; -o \"" +
                default_picture_ + "\" replaces it");
}

void FileGuard::check_plane(const std::string& file) const { check(file, "folder with --planes"); }

std::optional<FileGuard::FileId> FileGuard::id_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
}

void FileGuard::check(const std::string& file, const char* instead) const {
  std::optional<FileId> id = id_of(file);
  std::error_code error;
  if (!id && !fs::exists(("." / fs::path(file)).parent_path(), error))
    id = id_of(fs::weakly_canonical(file, error).string());  // once its folder is made
  if (!id) return;
  if (id == reference_) throw Error("\"" + file + "\" is the reference itself; name another " + instead);
  if (inputs_.contains(*id))
    throw Error("\"" + file + "\" is one of the input's own files; name another " + instead);
}

}  // namespace tessera::program::cli
