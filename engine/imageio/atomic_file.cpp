#include "engine/imageio/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) { throw Error("cannot write \"" + path + "\": " + reason); }

void write_plainly(const std::string& path, const std::string& shown_path, std::string_view content) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(shown_path, std::strerror(errno));
  const bool is_written = std::fwrite(content.data(), 1, content.size(), file) == content.size() && std::fflush(file) == 0;
  const int reason = errno;
  const bool is_closed = std::fclose(file) == 0;
  if (!is_written || !is_closed) fail(shown_path, std::strerror(is_written ? errno : reason));
}

}  // namespace

void write_file_atomically(const std::string& path, std::string_view content) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, std::strerror(EISDIR));
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_plainly(path, path, content);

  const fs::path target = fs::exists(status) ? fs::canonical(path, error) : fs::path(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) fail(path, "there is no folder \"" + folder.string() + "\"");
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
  std::string name = ".";
  name += target.filename().string() + ".part-" + std::to_string(::getpid());
  const std::string temporary = (folder / name).string();
  try {
    write_plainly(temporary, path, content);
    fs::rename(temporary, target);
  } catch (const fs::filesystem_error& failure) {
    fs::remove(temporary, error);
    fail(path, failure.code().message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

}  // namespace tessera
