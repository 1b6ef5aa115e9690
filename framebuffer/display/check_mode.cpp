#include "framebuffer/display/check_mode.h"

#include <algorithm>
#include <string>

#include "framebuffer/display/screen_layout.h"

namespace tessera::detail {

void check_mode(const VideoMode& mode) {
  constexpr int kMaxSize = 16384;
  const auto require = [](bool is_valid, const std::string& text) {
    if (!is_valid) throw DisplayError(text);
  };
  require(mode.width >= 1 && mode.width <= kMaxSize && mode.height >= 1 && mode.height <= kMaxSize,
          "the mode has " + std::to_string(mode.width) + "x" + std::to_string(mode.height) +
              " pixels, expected 1x1 to 16384x16384");
  require(mode.pixel_aspect >= 0.1 && mode.pixel_aspect <= 10,
          "the pixels' aspect is " + short_number(mode.pixel_aspect) + ", expected 0.1 to 10");
  if (!mode.timing) return;
  const ScanTiming& timing = *mode.timing;
  require(timing.lines_per_row >= 1 && timing.total_columns >= mode.width &&
              timing.total_lines >= mode.height * timing.lines_per_row,
          "the timing has " + std::to_string(timing.total_columns) + " columns and " +
              std::to_string(timing.total_lines) + " lines in all, the picture needs at least " +
              std::to_string(mode.width) + " and " +
              std::to_string(mode.height * std::max(timing.lines_per_row, 1)));
  require(timing.pixel_clock_hz >= 1e3 && timing.pixel_clock_hz <= 1e12,
          "the pixel clock is " + short_number(timing.pixel_clock_hz) + " Hz, expected 1e3 to 1e12");
}

}  // namespace tessera::detail
