#include "engine/program/imageio/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error("cannot write \"" + path + "\": " + reason);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Targets of links in /proc are descriptions rather than paths: "pipe:[7]", or the name of a deleted file.
bool is_in_proc(const fs::path& file) {
  std::error_code error;
  return fs::canonical(folder_of(file), error).native().starts_with("/proc/");
}

}  // namespace

std::optional<fs::path> require_writable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) fail(path, error.message());
  if (fs::is_directory(status)) fail(path, std::strerror(EISDIR));
  if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
  if (fs::exists(status) && !fs::is_regular_file(status)) return std::nullopt;
  fs::path target = path;
  while (fs::is_symlink(target, error)) {
    if (is_in_proc(target)) return std::nullopt;
    target = target.parent_path() / fs::read_symlink(target);
  }
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, error)) fail(path, "there is no folder \"" + folder.string() + "\"");
  if (::access(folder.c_str(), W_OK) != 0)
    fail(path, "cannot create a file in \"" + folder.string() + "\": " + std::strerror(errno));
  return fs::canonical(folder) / target.filename();
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(require_writable(path)) {
  std::string opened = path;
  if (target_) {
    std::string name = ".";
    name += target_->filename().string() + ".part-" + std::to_string(::getpid());
    temporary_ = folder_of(*target_) / name;
    opened = temporary_.string();
  }
  file_ = std::fopen(opened.c_str(), "wb");
  if (file_ == nullptr) fail(path_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code error;
  if (!temporary_.empty()) fs::remove(temporary_, error);
}

void AtomicFile::write(std::string_view content) {
  if (std::fwrite(content.data(), 1, content.size(), file_) != content.size() || std::fflush(file_) != 0)
    fail(path_, std::strerror(errno));
}

void AtomicFile::commit() {
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(path_, std::strerror(errno));
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, *target_, error);
  if (error) fail(path_, error.message());
  temporary_.clear();
}

void write_file_atomically(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace tessera::program
