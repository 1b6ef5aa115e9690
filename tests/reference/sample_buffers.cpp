#include "sample_buffers.h"

namespace tessera::reference {

SampleBuffers::SampleBuffers(const FrameBufferFormat& format) : format_(format), colors_(format) {
  const auto pixels = static_cast<std::size_t>(format.width_px) * static_cast<std::size_t>(format.height_px);
  const std::size_t samples = pixels * static_cast<std::size_t>(format.samples);
  words_.assign(samples, 0);
  samples_.assign(samples, Sample{1, depth_level(format.depth, 1), 0, {}});
  if (format.accumulation_bits > 0) accumulation_.assign(pixels, AccumPixel{});
  commands_.assign(pixels, -1);
  primitives_.assign(pixels, -1);
}

std::uint32_t SampleBuffers::resolved(int x, int y) const {
  const std::size_t first = first_sample(x, y);
  if (format_.samples == 1) return words_[first];
  return colors_.mean(std::span(words_).subspan(first, static_cast<std::size_t>(format_.samples)));
}

void SampleBuffers::write_word(int x, int y, std::uint32_t word_in, std::uint32_t planes) {
  for (int s = 0; s < format_.samples; ++s) {
    std::uint32_t& stored = word(x, y, s);
    stored = (stored & ~planes) | (word_in & planes);
  }
}

void SampleBuffers::write_unrounded(int x, int y, Vec4 color, const std::array<bool, 4>& mask) {
  for (int s = 0; s < format_.samples; ++s)
    sample(x, y, s).unrounded = masked(color, sample(x, y, s).unrounded, mask);
}

void SampleBuffers::record_writer(int x, int y, std::int32_t command, std::int32_t primitive) {
  commands_[pixel(x, y)] = command;
  primitives_[pixel(x, y)] = primitive;
}

Picture SampleBuffers::picture() const {
  Picture picture;
  picture.width_px = format_.width_px;
  picture.height_px = format_.height_px;
  for (int y = format_.height_px - 1; y >= 0; --y)
    for (int x = 0; x < format_.width_px; ++x) {
      const Sample& first = samples_[first_sample(x, y)];
      picture.words.push_back(resolved(x, y));
      Vec4 sum;
      for (int s = 0; s < format_.samples; ++s)
        sum = sum + samples_[first_sample(x, y) + static_cast<std::size_t>(s)].unrounded;
      picture.unrounded.push_back(1.0 / format_.samples * sum);
      for (const std::uint8_t component : colors_.shown(picture.words.back()))
        picture.rgb.push_back(component);
      picture.depth.push_back(first.depth);
      picture.depth_levels.push_back(first.depth_level);
      picture.stencil.push_back(static_cast<std::uint8_t>(first.stencil));
    }
  picture.accumulation = accumulation_;
  picture.sample_words = words_;
  picture.draws = commands_;
  picture.primitives = primitives_;
  return picture;
}

}  // namespace tessera::reference
