#include "engine/program/imageio/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error("cannot write \"" + path + "\": " + reason);
}

void write_directly(const std::string& path, const std::string& shown_path, std::string_view content) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(shown_path, std::strerror(errno));
  const bool is_written =
      std::fwrite(content.data(), 1, content.size(), file) == content.size() && std::fflush(file) == 0;
  const int reason = errno;
  const bool is_closed = std::fclose(file) == 0;
  if (!is_written || !is_closed) fail(shown_path, std::strerror(is_written ? errno : reason));
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

void write_file_atomically(const std::string& path, std::string_view content) {
  const std::optional<fs::path> target = require_writable(path);
  if (!target) return write_directly(path, path, content);

  std::error_code error;
  std::string name = ".";
  name += target->filename().string() + ".part-" + std::to_string(::getpid());
  const std::string temporary = (folder_of(*target) / name).string();
  try {
    write_directly(temporary, path, content);
    fs::rename(temporary, *target);
  } catch (const fs::filesystem_error& failure) {
    fs::remove(temporary, error);
    fail(path, failure.code().message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

}  // namespace tessera::program
