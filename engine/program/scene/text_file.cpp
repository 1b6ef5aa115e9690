#include "engine/program/scene/text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

std::string read_text_file(const std::string& path, std::size_t max_bytes) {
  const auto fail = [&](int reason) -> void {
    throw Error("cannot read \"" + path + "\": " + std::strerror(reason));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(errno);
  std::string text;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get())) {
    text.append(block, count);
    if (text.size() > max_bytes)
      throw Error("cannot read \"" + path + "\": it holds more than " + std::to_string(max_bytes) + " bytes");
  }
  if (std::ferror(file.get())) fail(errno);  // folders can be opened, but not read
  return text;
}

void refuse_device_or_pipe(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code unknown;  // missing files are reported when they are read
  const fs::file_status status = fs::status(path, unknown);
  if (fs::is_other(status))
    throw Error("cannot read \"" + path + "\": it is a device or a pipe, expected a file");
}

}  // namespace tessera::program
