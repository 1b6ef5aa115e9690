#include "engine/program/imageio/animated_png.h"

#include "engine/program/imageio/png_chunks.h"

namespace tessera::program {
namespace {

std::string size_text(const PngFormat& format) {
  return std::to_string(format.width) + "x" + std::to_string(format.height);
}

}  // namespace

AnimatedPng::AnimatedPng(const std::string& path, int frames, int delay_ms)
    : path_(path), file_(path), frames_(frames), delay_ms_(delay_ms) {}

// Frame control: sequence number, width, height, x, y, delay as a fraction of seconds, disposal "none",
// blending "source" [PNG, 11.3.6.2].
void AnimatedPng::append_frame_control(std::string& bytes) {
  std::string data;
  append_u32(next_sequence_++, data);
  append_u32(static_cast<std::uint32_t>(format_.width), data);
  append_u32(static_cast<std::uint32_t>(format_.height), data);
  append_u32(0, data);
  append_u32(0, data);
  append_u16(static_cast<std::uint32_t>(delay_ms_), data);
  append_u16(1000, data);
  data.append(2, '\0');
  append_chunk("fcTL", data, bytes);
}

void AnimatedPng::add(const PngImage& image, std::string_view data) {
  std::string bytes;
  if (added_ == 0) {
    format_ = image.format;
    palette_ = image.palette;
    append_png_header(format_, bytes);
    std::string control;  // number of frames, plays without end
    append_u32(static_cast<std::uint32_t>(frames_), control);
    append_u32(0, control);
    append_chunk("acTL", control, bytes);
    append_palette(palette_, bytes);
  }
  if (image.format != format_ || image.palette != palette_)
    throw Error("cannot write \"" + path_ + "\": frame " + std::to_string(added_) + " is " +
                size_text(image.format) + ", the first is " + size_text(format_) +
                "; frames of an animated PNG have one size and one palette");
  append_frame_control(bytes);
  if (added_++ == 0) {
    append_pixel_data(data, bytes);
  } else {
    for (std::size_t at = 0; at < data.size(); at += kMaxPngDataBytes) {
      std::string frame_data;
      append_u32(next_sequence_++, frame_data);
      frame_data += data.substr(at, kMaxPngDataBytes);
      append_chunk("fdAT", frame_data, bytes);
    }
  }
  file_.write(bytes);
}

void AnimatedPng::finish() {
  std::string end;
  append_chunk("IEND", "", end);
  file_.write(end);
  file_.commit();
}

}  // namespace tessera::program
