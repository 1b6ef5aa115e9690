#include "engine/program/cli/memory_dump.h"

#include <string_view>
#include <vector>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/ilbm.h"
#include "engine/program/imageio/pcx.h"
#include "engine/program/imageio/screen_picture.h"
#include "engine/program/scene/file_extension.h"

namespace tessera::program::cli {
namespace {

std::string raw_memory(const FrameBuffer& buffer, const DisplayMode& mode) {
  std::vector<std::uint32_t> words(static_cast<std::size_t>(mode.width) *
                                   static_cast<std::size_t>(mode.height));
  buffer.read_packed_colors(words);
  std::vector<std::uint8_t> memory(memory_bytes(mode));
  write_memory(mode, words, memory);
  return {memory.begin(), memory.end()};
}

std::string encoded_dump(const FrameBuffer& buffer, const DisplayMode& mode, std::string_view extension) {
  if (extension == ".iff" || extension == ".ilbm" || extension == ".lbm")
    return encode_ilbm(screen_picture(buffer, mode.pixel_aspect));
  if (extension == ".pcx") return encode_pcx(screen_picture(buffer, mode.pixel_aspect));
  return raw_memory(buffer, mode);
}

}  // namespace

void write_memory_dump(const FrameBuffer& buffer, const DisplayMode& mode, const std::string& path) {
  write_file_atomically(path, encoded_dump(buffer, mode, lower_case_extension(path)));
}

}  // namespace tessera::program::cli
