#include <algorithm>
#include <new>
#include <string>

#include "engine/buffers/frame_buffer_state.h"
#include "engine/buffers/image_target.h"
#include "engine/buffers/view_depth.h"
#include "engine/plan/draw_plan.h"
#include "engine/record/checks.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/runtime/worker_pool.h"
#include "engine/tessera/tessera.hpp"
#include "framebuffer/accumulation.h"
#include "framebuffer/bit_transpose.h"
#include "framebuffer/scan_out.h"

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

void require_image(const ImageTarget& target, const FrameBufferFormat& format, const char* function) {
  if (target.pixels == nullptr)
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the target's pixels are a null pointer");
  if (target.width != format.width || target.height != format.height)
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the target is " + std::to_string(target.width) + " x " +
                    std::to_string(target.height) + " pixels, the frame buffer is " +
                    std::to_string(format.width) + " x " + std::to_string(format.height));
  const std::ptrdiff_t row = std::ptrdiff_t{4} * target.width;
  const bool rows_overlap = row_stride(target) < row && row_stride(target) > -row;
  if (target.height > 1 && rows_overlap)
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": the target's stride is " +
                                                 std::to_string(target.stride_bytes) +
                                                 " bytes, a row takes " + std::to_string(row));
  require_enum({function, ": the target's order"}, target.order, PixelOrder::bgra8);
  if (target.region && (target.region->width < 0 || target.region->height < 0))
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the target's region is " + std::to_string(target.region->width) +
                    " x " + std::to_string(target.region->height) + " pixels, must not be negative");
}

template <class T>
void require_pixels(std::span<T> span, const FrameBufferFormat& format, const char* function,
                    std::size_t components = 1) {
  const std::size_t pixels = static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height);
  if (span.size() != components * pixels)
    throw Error(ErrorCode::invalid_argument,
                std::string(function) + ": the span holds " + std::to_string(span.size()) +
                    " elements, the frame buffer has " + std::to_string(pixels) + " pixels" +
                    (components > 1 ? " of " + std::to_string(components) + " components" : ""));
}

}  // namespace

namespace detail {

void check_image_target(const ImageTarget& target, const FrameBufferFormat& format) {
  require_image(target, format, "Renderer::finish");
}

PixelRect target_region(const ImageTarget& target) {
  const PixelRect whole{0, 0, target.width, target.height};
  if (!target.region) return whole;
  const PixelRect region = intersect(whole, raster_rect(*target.region, target.height));
  return region.empty() ? PixelRect{} : region;
}

}  // namespace detail

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

namespace {

const Attachment& require_defined(FrameBufferState& state, Buffer which, const char* function) {
  const Attachment& buffer = state.stored_buffer(which);
  if (buffer.planes.plane_count() == 0)
    throw Error(ErrorCode::incompatible_format,
                std::string(function) + ": the frame buffer has no " + std::string(name(which)) + " buffer");
  if (buffer.content == Attachment::Content::undefined)
    throw Error(ErrorCode::invalid_state, std::string(function) + ": the last frame did not keep the " +
                                              std::string(name(which)) + " buffer; name it in Frame::keep()");
  return buffer;
}

/// Calls use(words of a row, y) for every row from the top. Planes are read in bands of tiles.
template <class Use>
void for_each_row(const Attachment& buffer, const char* function, const Use& use) {
  constexpr int kBandRows = 32;
  const int width = buffer.planes.width_px();
  const int height = buffer.planes.height_px();
  LoadPlanesFn* const load =
      translate_bad_alloc(function, [] { return load_planes_for(available_isas().front()); });
  auto band = translate_bad_alloc(function, [&] {
    return std::vector<std::uint32_t>(static_cast<std::size_t>(width) * kBandRows, buffer.clear_value);
  });
  const auto row = [&](int y) {
    return band.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  };
  alignas(kPlaneAlignment) std::uint32_t tile[kBandRows * kBandRows];
  for (int y0 = 0; y0 < height; y0 += kBandRows) {
    const int rows = std::min(kBandRows, height - y0);
    if (buffer.content != Attachment::Content::fast_cleared) {
      for (int x0 = 0; x0 < width; x0 += kBandRows) {
        load(tile, {x0, y0, kBandRows, 0}, buffer.planes);
        for (int y = 0; y < rows; ++y)
          for (int x = 0; x < std::min(kBandRows, width - x0); x += kBlockSize)
            std::copy_n(tile + tile_index(x, y, kBandRows), std::min(kBlockSize, width - x0 - x),
                        row(y) + x0 + x);
      }
    }
    for (int y = 0; y < rows; ++y)
      use(std::span<const std::uint32_t>(row(y), static_cast<std::size_t>(width)),
          static_cast<std::size_t>(y0 + y));
  }
}
template <class Use>
void for_each_row(FrameBufferState& state, Buffer which, const char* function, const Use& use) {
  for_each_row(require_defined(state, which, function), function, use);
}

}  // namespace

PlaneView FrameBuffer::plane(Buffer which, int k) const try {
  require_enum({"FrameBuffer::plane: buffer"}, which, Buffer::accumulation);
  require_defined(*state_, which, "FrameBuffer::plane");
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

void FrameBuffer::read_color(const ImageTarget& target) const {
  require_image(target, state_->format, "FrameBuffer::read_color");
  const FloatingPointMode mode;
  const auto scan_out = translate_bad_alloc("FrameBuffer::read_color", [&] {
    return ScanOut(state_->stored_layout, state_->stored_layout.index ? &state_->palette : nullptr,
                   target.order, available_isas().front());
  });
  const PixelRect region = target_region(target);
  for_each_row(*state_, Buffer::color, "FrameBuffer::read_color",
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 if (static_cast<int>(y) < region.y0 || static_cast<int>(y) >= region.y1) return;
                 auto* const pixels = static_cast<std::uint8_t*>(target.pixels) +
                                      static_cast<std::ptrdiff_t>(y) * row_stride(target);
                 scan_out.row(row.data() + region.x0, region.x1 - region.x0,
                              pixels + 4 * static_cast<std::ptrdiff_t>(region.x0));
               });
}

void FrameBuffer::read_packed_colors(std::span<std::uint32_t> words) const {
  require_pixels(words, state_->format, "FrameBuffer::read_packed_colors");
  for_each_row(*state_, Buffer::color, "FrameBuffer::read_packed_colors",
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 std::copy(row.begin(), row.end(),
                           words.begin() + static_cast<std::ptrdiff_t>(y * row.size()));
               });
}

void FrameBuffer::read_depth(std::span<float> depth) const {
  require_pixels(depth, state_->format, "FrameBuffer::read_depth");
  const DepthFormat kind = state_->depth_format;
  const FloatingPointMode mode;
  for_each_row(*state_, Buffer::depth, "FrameBuffer::read_depth",
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 for (std::size_t x = 0; x < row.size(); ++x)
                   depth[y * row.size() + x] = static_cast<float>(dequantize_depth(kind, row[x]));
               });
}

void FrameBuffer::read_stored_depths(std::span<std::uint32_t> words) const {
  require_pixels(words, state_->format, "FrameBuffer::read_stored_depths");
  for_each_row(*state_, Buffer::depth, "FrameBuffer::read_stored_depths",
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 std::copy(row.begin(), row.end(),
                           words.begin() + static_cast<std::ptrdiff_t>(y * row.size()));
               });
}

void FrameBuffer::read_view_depth(std::span<float> depth, const Camera& camera, float background) const {
  constexpr const char* kFunction = "FrameBuffer::read_view_depth";
  require_pixels(depth, state_->format, kFunction);
  const DepthFormat kind = state_->depth_format;
  const FloatingPointMode mode;
  const ViewDepth distance(camera, background, kFunction);
  for_each_row(*state_, Buffer::depth, kFunction, [&](std::span<const std::uint32_t> row, std::size_t y) {
    for (std::size_t x = 0; x < row.size(); ++x)
      depth[y * row.size() + x] = distance.at(dequantize_depth(kind, row[x]));
  });
}

void FrameBuffer::read_stencil(std::span<std::uint8_t> stencil) const {
  require_pixels(stencil, state_->format, "FrameBuffer::read_stencil");
  for_each_row(*state_, Buffer::stencil, "FrameBuffer::read_stencil",
               [&](std::span<const std::uint32_t> row, std::size_t y) {
                 for (std::size_t x = 0; x < row.size(); ++x)
                   stencil[y * row.size() + x] = static_cast<std::uint8_t>(row[x]);
               });
}

void FrameBuffer::read_accumulation(std::span<float> rgba) const {
  constexpr const char* kFunction = "FrameBuffer::read_accumulation";
  require_pixels(rgba, state_->format, kFunction, 4);
  require_defined(*state_, Buffer::accumulation, kFunction);
  const int bits = state_->format.accumulation_bits;
  const FloatingPointMode mode;
  for (std::size_t c = 0; c < 4; ++c)
    for_each_row(state_->accumulation[c], kFunction, [&](std::span<const std::uint32_t> row, std::size_t y) {
      // The lowest level lies one step below -1.
      for (std::size_t x = 0; x < row.size(); ++x)
        rgba[4 * (y * row.size() + x) + c] = static_cast<float>(
            std::max(accumulation_level_from_stored(row[x], bits) / accumulation_one(bits), -1.0));
    });
}

}  // namespace tessera
