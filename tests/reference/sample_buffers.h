// The buffers of a frame: colour, depth and stencil per sample, accumulation per pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accumulation.h"
#include "pixel_format.h"
#include "render.h"
#include "scene.h"

namespace tessera::reference {

/// New buffers hold colour 0, depth 1, stencil 0, accumulation 0.
class SampleBuffers {
 public:
  struct Sample {
    double depth = 1;  ///< depth of the last stored fragment, before rounding to a level
    std::uint32_t depth_level = 0;
    std::uint32_t stencil = 0;
    Vec4 unrounded{};  ///< colour before rounding to levels
  };

  explicit SampleBuffers(const FrameBufferFormat& format);

  const FrameBufferFormat& format() const { return format_; }
  const ColorFormat& colors() const { return colors_; }
  Rect rect() const { return {0, 0, format_.width_px, format_.height_px}; }

  /// @param x, y  window coordinates inside the buffer, y up; likewise below.
  std::uint32_t& word(int x, int y, int sample) {
    return words_[first_sample(x, y) + static_cast<std::size_t>(sample)];
  }
  Sample& sample(int x, int y, int index) {
    return samples_[first_sample(x, y) + static_cast<std::size_t>(index)];
  }
  AccumPixel& accumulation(int x, int y) { return accumulation_[pixel(x, y)]; }

  /// Resolved colour of a pixel: the mean of its samples.
  std::uint32_t resolved(int x, int y) const;

  /// Writes all samples of a pixel through the writable planes.
  void write_word(int x, int y, std::uint32_t word, std::uint32_t planes);

  /// Writes the unrounded colour of all samples of a pixel through a colour mask.
  void write_unrounded(int x, int y, Vec4 color, const std::array<bool, 4>& mask);

  /// Records the primitive and command that wrote the colour last.
  void record_writer(int x, int y, std::int32_t command, std::int32_t primitive);

  /// A copy of the current contents.
  Picture picture() const;

 private:
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(format_.height_px - 1 - y) * static_cast<std::size_t>(format_.width_px) +
           static_cast<std::size_t>(x);
  }
  std::size_t first_sample(int x, int y) const {
    return pixel(x, y) * static_cast<std::size_t>(format_.samples);
  }

  FrameBufferFormat format_;
  ColorFormat colors_;
  std::vector<std::uint32_t> words_;  // the samples of a pixel are adjacent; rows from the top
  std::vector<Sample> samples_;
  std::vector<AccumPixel> accumulation_;  // empty without the buffer
  std::vector<std::int32_t> commands_;
  std::vector<std::int32_t> primitives_;
};

}  // namespace tessera::reference
