#include "engine/program/cli/shown_pictures.h"

#include <cstddef>
#include <cstdint>
#include <iostream>

#include "engine/program/cli/output.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/usage_error.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/float_picture.h"
#include "engine/program/scene/file_extension.h"

namespace tessera::program::cli {
namespace {

/// The screen that options describe.
/// @throws UsageError for parts and scales that the screen does not have
Screen screen_for(const DisplayRequest& request, const VideoMode& mode, const ScreenWorkers& workers,
                  InstructionSet instruction_set) {
  try {
    return {*request.display, mode, request.view, workers, instruction_set};
  } catch (const DisplayError& error) {
    throw UsageError(error.what());
  }
}

bool receives_light(const std::string& path) { return lower_case_extension(path) == ".pfm"; }

}  // namespace

VideoMode video_mode(const DisplayMode& mode) {
  frame_buffer_format(mode);  // refuses character cells
  return {.width = mode.width,
          .height = mode.height,
          .pixel_aspect = mode.pixel_aspect.value(),
          .timing = mode.timing};
}

ShownPictures::ShownPictures(const DisplayRequest& request, const VideoMode& mode, const std::string& path,
                             int threads, InstructionSet instruction_set)
    : workers_(threads),
      screen_(screen_for(request, mode, ScreenWorkers(workers_), instruction_set)),
      start_ms_(request.start_ms),
      frame_ms_(request.frame_ms > 0 ? request.frame_ms : screen_.frame_ms()),
      image_(screen_.width(), screen_.height()) {
  if (receives_light(path)) light_.resize(image_.rgba.size() / 4 * 3);
}

void ShownPictures::print_notes() const {
  for (const std::string& note : screen_.notes()) std::cerr << "tessera: note: " << printable(note) << "\n";
}

void ShownPictures::show(const Picture& picture) {
  std::vector<std::uint8_t> rgb(image_.rgba.size() / 4 * 3);
  screen_.show({.rgb = picture.rgba, .pixel_bytes = 4}, next_ms(),
               {.rgb = rgb.data(), .light = light_.empty() ? nullptr : light_.data()});
  ++shown_;
  for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) image_.rgba[4 * pixel + c] = rgb[3 * pixel + c];
    image_.rgba[4 * pixel + 3] = 255;
  }
}

void ShownPictures::write(const std::string& path, int compression) const {
  if (receives_light(path)) write_file_atomically(path, encode_pfm(image_.width, image_.height, 3, light_));
  else write_output(image_, path, compression);
}

}  // namespace tessera::program::cli
