// A television: encodes rows of pixels as the signal of NTSC or PAL, and decodes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "framebuffer/display/television_decoder.h"
#include "framebuffer/display/television_encoder.h"
#include "framebuffer/display/television_raster.h"
#include "framebuffer/tessera/enums.hpp"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Signal and receiver of one display mode. Const use is thread-safe.
class TelevisionSignal {
 public:
  /// @param kind  ntsc or pal
  TelevisionSignal(DisplayKind kind, const Television& television, const VideoMode& mode,
                   InstructionSet isa = InstructionSet::automatic);

  /// Samples of the part of a line that shows pixels. Sample k is at (k + 0.5) / samples_per_pixel() pixels
  /// from the left edge of the first pixel.
  int samples() const { return raster_.samples(); }
  double samples_per_pixel() const { return raster_.samples_per_pixel(); }

  /// Encodes rows and decodes them.
  /// - The results of a row depend neither on the other rows of the call nor on the instruction set.
  /// @param rgb          all rows of the picture, because receivers compare rows: red, green, blue and
  ///                     `pixel_bytes` - 3 more bytes per pixel
  /// @param frame        number of the frame, which decides the phase of the subcarrier
  /// @param out          for each row of [first_row, last_row): samples() of red, of green, of blue. R'G'B'
  ///                     with 0 black and 1 white, not clipped.
  void decode_rows(const std::uint8_t* rgb, std::ptrdiff_t stride_bytes, int pixel_bytes, std::int64_t frame,
                   int first_row, int last_row, float* out) const;

  /// All lines of a frame.
  VideoSignal encode_frame(const std::uint8_t* rgb, std::ptrdiff_t stride_bytes, int pixel_bytes,
                           std::int64_t frame) const;

 private:
  class Lines;

  const TelevisionSystem& system_;
  Television television_;
  int height_;
  TelevisionKernels kernels_;
  TelevisionRaster raster_;
  TelevisionDecoder decoder_;
  SampleRange range_;
  TelevisionEncoder encoder_;
};

}  // namespace tessera::detail
