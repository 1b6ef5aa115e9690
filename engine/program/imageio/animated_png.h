// Animated PNG files [PNG, 4.10 and 11.3.6]: frames in one file, which players repeat without end. Programs
// without animations show the first frame.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/png_image.h"

namespace tessera::program {

/// Longest time of a frame in milliseconds: a fraction of 16-bit numbers.
inline constexpr int kMaxDelayMs = 65535;

/// Writes a file frame by frame. A file that finish() did not complete leaves nothing behind.
class AnimatedPng {
 public:
  /// @param frames    number of frames that will follow
  /// @param delay_ms  time of each frame, 1 .. kMaxDelayMs
  /// @throws Error if the file cannot be created
  AnimatedPng(const std::string& path, int frames, int delay_ms);

  /// @param image  its pixels are not read
  /// @param data   compress_pixels(image)
  /// @throws Error if writing fails, or if size, format or palette are not those of the first frame
  void add(const PngImage& image, std::string_view data);
  /// @throws Error if writing fails
  void finish();

 private:
  void append_frame_control(std::string& bytes);

  std::string path_;
  AtomicFile file_;
  int frames_, delay_ms_;
  int added_ = 0;                    ///< frames
  std::uint32_t next_sequence_ = 0;  ///< number of the next chunk of a frame
  PngFormat format_;
  std::vector<std::uint8_t> palette_;
};

}  // namespace tessera::program
