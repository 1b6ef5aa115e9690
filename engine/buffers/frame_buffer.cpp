#include <algorithm>
#include <new>
#include <string>

#include "engine/buffers/frame_buffer_state.h"
#include "engine/record/checks.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/tessera/tessera.hpp"

namespace tessera {
using namespace detail;

namespace detail {

std::string_view name(Buffer buffer) {
  switch (buffer) {
    case Buffer::color: return "colour";
    case Buffer::depth: return "depth";
    case Buffer::stencil: return "stencil";
    default: return "accumulation";
  }
}

const Attachment& require_readable(FrameBufferState& state, Buffer which, const char* function) {
  const Attachment& buffer = state.stored_buffer(which);
  if (buffer.planes.plane_count() == 0)
    throw Error(ErrorCode::incompatible_format,
                std::string(function) + ": the frame buffer has no " + std::string(name(which)) + " buffer");
  if (buffer.content == Attachment::Content::undefined)
    throw Error(ErrorCode::invalid_state, std::string(function) + ": the last frame did not keep the " +
                                              std::string(name(which)) + " buffer; name it in Frame::keep()");
  return buffer;
}

}  // namespace detail

namespace {

void require_range(const std::string& what, long long value, long long low, long long high,
                   const char* unit = "") {
  if (value < low || value > high)
    throw Error(ErrorCode::invalid_argument, "FrameBuffer: " + what + " is " + std::to_string(value) + unit +
                                                 ", must be " + std::to_string(low) + " to " +
                                                 std::to_string(high));
}

Color to_color(Rgb8 c) { return {c.r / 255.0f, c.g / 255.0f, c.b / 255.0f, 1}; }

std::vector<Color> to_colors(const std::vector<Rgb8>& entries) {
  std::vector<Color> colors;
  colors.reserve(entries.size());
  for (const Rgb8& entry : entries) colors.push_back(to_color(entry));
  return colors;
}

}  // namespace

std::vector<Color> named_palette(std::string_view palette_name, int color_bits) try {
  require_range("color_bits", color_bits, 1, 24);
  const FloatingPointMode mode;
  const auto entries = palette_entries(palette_name, color_bits);
  if (!entries)
    throw Error(ErrorCode::invalid_argument,
                "palette: \"" + std::string(palette_name) +
                    "\" is unknown, it must be bw, gray, ega16, vga256 or web216");
  if (entries->size() > std::size_t{1} << color_bits)
    throw Error(ErrorCode::invalid_argument, "palette: " + std::string(palette_name) + " has " +
                                                 std::to_string(entries->size()) + " entries, " +
                                                 std::to_string(color_bits) + " bits hold at most " +
                                                 std::to_string(std::size_t{1} << color_bits));
  return to_colors(*entries);
} catch (const std::bad_alloc&) {
  throw Error(ErrorCode::out_of_memory, "palette: not enough memory");
}

std::vector<Color> default_palette(int color_bits) {
  require_range("color_bits", color_bits, 1, 24);
  const FloatingPointMode mode;
  return translate_bad_alloc("palette", [&] { return to_colors(default_palette_of(color_bits).entries); });
}

namespace {

void require_palette_size(std::size_t entries, int bits) {
  if (entries > std::size_t{1} << bits)
    throw Error(ErrorCode::invalid_argument, "FrameBuffer: the palette has " + std::to_string(entries) +
                                                 " entries, " + std::to_string(bits) + " bits hold at most " +
                                                 std::to_string(std::size_t{1} << bits));
}

void check_format(const FrameBufferFormat& format) {
  require_range("width", format.width, 1, kMaxFrameBufferSize, " px");
  require_range("height", format.height, 1, kMaxFrameBufferSize, " px");
  require_enum({"FrameBuffer: color_mode"}, format.color_mode, ColorMode::index);
  require_enum({"FrameBuffer: depth"}, format.depth, DepthFormat::float32);
  require_enum({"FrameBuffer: dither"}, format.dither, Dither::pattern);
  require_enum({"FrameBuffer: dither_in"}, format.dither_in, DitherSpace::light);
  const float gamma = format.dither_gamma;
  if (!(gamma == 0 || (gamma >= 1 && gamma <= 4)))
    throw Error(ErrorCode::invalid_argument, "FrameBuffer: dither_gamma is " + std::to_string(gamma) +
                                                 ", must be 1 to 4, or 0 for the curve of sRGB");
  require_range("color_bits", format.color_bits, 1, 24);
  require_range("stencil_bits", format.stencil_bits, 0, 8);
  if (format.alpha_bits != 0 && format.alpha_bits != 8)
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer: alpha_bits is " + std::to_string(format.alpha_bits) + ", must be 0 or 8");
  if (format.alpha_bits != 0 && format.color_mode == ColorMode::index)
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer: alpha planes are asked for, but the colour mode is index; they belong to rgb");
  if (format.samples != 1 && format.samples != 4 && format.samples != 8)
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer: samples is " + std::to_string(format.samples) + ", must be 1, 4 or 8");
  if (format.samples != 1 && format.color_mode == ColorMode::index)
    throw Error(
        ErrorCode::invalid_argument,
        "FrameBuffer: several samples a pixel are asked for, but the colour mode is index; indices have no "
        "mean");
  if (format.accumulation_bits != 0 && format.accumulation_bits != 16 && format.accumulation_bits != 32)
    throw Error(ErrorCode::invalid_argument, "FrameBuffer: accumulation_bits is " +
                                                 std::to_string(format.accumulation_bits) +
                                                 ", must be 0, 16 or 32");
  if (format.accumulation_bits != 0 && format.color_mode == ColorMode::index)
    throw Error(
        ErrorCode::invalid_argument,
        "FrameBuffer: an accumulation buffer is asked for, but the colour mode is index; it belongs to rgb");
  if (format.color_mode == ColorMode::rgb && !format.palette.empty())
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer: a palette is given, but the colour mode is rgb; palettes belong to index mode");
  require_palette_size(format.palette.size(), format.color_bits);
}

/// Checks and quantizes a palette.
Palette checked_palette(std::span<const Color> colors, int bits, Dither dither) {
  require_palette_size(colors.size(), bits);
  if (dither == Dither::pattern && colors.size() > kMaxMixedEntries)
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer: dither is pattern and the palette has " + std::to_string(colors.size()) +
                    " entries; pattern mixes at most " + std::to_string(kMaxMixedEntries));
  Palette palette{.bits = bits, .entries = {}};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Color& c = colors[i];
    for (const float component : {c.r, c.g, c.b, c.a})
      if (!(component >= 0 && component <= 1))
        throw Error(ErrorCode::invalid_argument, "FrameBuffer: palette entry " + std::to_string(i) +
                                                     " has a component " + std::to_string(component) +
                                                     ", must be 0 to 1");
    palette.entries.push_back(quantize_rgb8(c.r, c.g, c.b));
  }
  return palette;
}

void set_layouts(FrameBufferState& s) {
  const FrameBufferFormat& format = s.format;
  const bool is_index = format.color_mode == ColorMode::index;
  s.stored_layout = is_index ? index_layout(format.color_bits) : rgb_layout(format.color_bits);
  s.stored_layout.alpha_bits = format.alpha_bits;
  s.layout = is_error_diffusion(format.dither) ? working_layout(s.stored_layout) : s.stored_layout;
  s.depth_format = format.depth;
}

void make_planes(FrameBufferState& s) {
  s.color.planes = BitplaneStack(s.format.width, s.format.height, s.layout.planes());
  if (is_error_diffusion(s.format.dither))
    s.diffused.planes = BitplaneStack(s.format.width, s.format.height, s.stored_layout.planes());
  s.depth.planes = BitplaneStack(s.format.width, s.format.height, depth_bits(s.depth_format));
  s.stencil.planes = BitplaneStack(s.format.width, s.format.height, s.format.stencil_bits);
  for (Attachment& component : s.accumulation)
    component.planes = BitplaneStack(s.format.width, s.format.height, s.format.accumulation_bits);
}

/// Calls use() for each stack of planes, in the order of the caller's memory.
template <class Use>
void for_each_attachment(FrameBufferState& state, const Use& use) {
  for (const Buffer which : kBuffers)
    for (Attachment& attachment : state.stored_attachments(which)) use(attachment);
  if (is_error_diffusion(state.format.dither)) use(state.color);
}

}  // namespace

FrameBuffer::FrameBuffer(FrameBufferFormat format) try : state_(std::make_unique<FrameBufferState>()) {
  const FloatingPointMode mode;
  check_format(format);
  FrameBufferState& s = *state_;
  if (format.color_mode == ColorMode::index) {
    if (format.palette.empty()) format.palette = default_palette(format.color_bits);
    s.palette = checked_palette(format.palette, format.color_bits, format.dither);
  }
  s.format = std::move(format);
  set_layouts(s);
  make_planes(s);
  s.build_dither();
  s.color.clear_value = s.layout.index_flag();  // index 0
  if (s.depth_format != DepthFormat::none) s.depth.fast_clear(quantize_depth(s.depth_format, 1.0));
} catch (const std::bad_alloc&) {
  throw Error(ErrorCode::out_of_memory, "FrameBuffer: not enough memory");
}

FrameBuffer::FrameBuffer(FrameBufferFormat format, std::span<std::byte> memory)
    : FrameBuffer(std::move(format)) {
  const std::size_t needed = memory_bytes(state_->format);
  if (memory.size() < needed)
    throw Error(ErrorCode::invalid_argument, "FrameBuffer: the memory given takes " +
                                                 std::to_string(memory.size()) + " bytes, the format needs " +
                                                 std::to_string(needed));
  if (reinterpret_cast<std::uintptr_t>(memory.data()) % kPlaneAlignment != 0)
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer: the memory given is at an address that is no multiple of " +
                    std::to_string(kPlaneAlignment));
  auto* at = reinterpret_cast<std::uint8_t*>(memory.data());
  for_each_attachment(*state_, [&](Attachment& attachment) {
    attachment.planes.use_external_memory(at);
    at += attachment.planes.needed_bytes();
    attachment.materialize_external_memory();
  });
}

std::size_t FrameBuffer::memory_bytes(const FrameBufferFormat& format) {
  check_format(format);
  FrameBufferState state;
  state.format = format;
  set_layouts(state);
  make_planes(state);
  std::size_t bytes = 0;
  for_each_attachment(state, [&](Attachment& attachment) { bytes += attachment.planes.needed_bytes(); });
  return bytes;
}

FrameBuffer::~FrameBuffer() = default;
FrameBuffer::FrameBuffer(FrameBuffer&&) noexcept = default;
FrameBuffer& FrameBuffer::operator=(FrameBuffer&&) noexcept = default;

const FrameBufferFormat& FrameBuffer::format() const noexcept { return state_->format; }

void FrameBuffer::set_palette(std::span<const Color> entries) {
  FrameBufferState& s = *state_;
  if (!s.stored_layout.index)
    throw Error(ErrorCode::incompatible_format,
                "FrameBuffer::set_palette: the colour mode is rgb; palettes belong to index mode");
  translate_bad_alloc("FrameBuffer::set_palette", [&] {
    const FloatingPointMode mode;
    std::vector<Color> colors = entries.empty() ? default_palette(s.format.color_bits)
                                                : std::vector<Color>(entries.begin(), entries.end());
    Palette palette = checked_palette(colors, s.format.color_bits, s.format.dither);
    std::swap(s.palette, palette);
    try {
      s.build_dither();
    } catch (...) {
      std::swap(s.palette, palette);
      throw;
    }
    s.format.palette = std::move(colors);
    s.palette_search.reset();
  });
}

int FrameBuffer::plane_count(Buffer buffer) const noexcept {
  if (buffer == Buffer::color) return state_->stored_color().planes.plane_count();
  int planes = 0;
  for (const Attachment& attachment : state_->attachments(buffer)) planes += attachment.planes.plane_count();
  return planes;
}
std::size_t FrameBuffer::allocated_bytes(Buffer buffer) const noexcept {
  std::size_t bytes = 0;
  for (const Attachment& attachment : state_->attachments(buffer)) bytes += attachment.planes.bytes();
  if (buffer == Buffer::color) bytes += state_->diffused.planes.bytes();
  return bytes;
}

PlaneView FrameBuffer::plane(Buffer which, int k) const try {
  require_enum({"FrameBuffer::plane: buffer"}, which, Buffer::accumulation);
  require_readable(*state_, which, "FrameBuffer::plane");
  if (k < 0 || k >= plane_count(which))
    throw Error(ErrorCode::invalid_argument,
                "FrameBuffer::plane: plane " + std::to_string(k) + " of the " + std::string(name(which)) +
                    " buffer, which has planes 0 to " + std::to_string(plane_count(which) - 1));
  const std::span<Attachment> attachments = state_->stored_attachments(which);
  for (Attachment& attachment : attachments) attachment.materialize();
  const int planes = attachments.front().planes.plane_count();
  const Attachment& buffer = attachments[static_cast<std::size_t>(k / planes)];
  return {buffer.planes.plane(k % planes), buffer.planes.width_px(), buffer.planes.height_px(),
          buffer.planes.stride_bytes()};
} catch (const std::bad_alloc&) {
  throw Error(ErrorCode::out_of_memory,
              "FrameBuffer::plane: not enough memory for the " + std::string(name(which)) + " planes");
}

}  // namespace tessera
