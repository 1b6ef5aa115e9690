// Frame buffers: bitplanes of colour, depth, stencil and accumulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <tessera/enums.hpp>

#include "types.hpp"

namespace tessera {

struct Camera;
class Renderer;

inline constexpr int kMaxFrameBufferSize = 16384;  ///< largest width and height, pixels

/// Contents of the colour planes: RGB levels, or indices into a palette.
enum class ColorMode : std::uint8_t { rgb, index };

/// The attachments of a frame buffer.
enum class Buffer : std::uint8_t { color, depth, stencil, accumulation };

struct FrameBufferFormat {
  int width = 640;   ///< pixels, 1 to kMaxFrameBufferSize
  int height = 480;  ///< pixels, 1 to kMaxFrameBufferSize
  ColorMode color_mode = ColorMode::rgb;
  int color_bits = 24;  ///< colour planes, 1 to 24: split between R, G and B, or the bits of an index
  /// Palette of a colour-index buffer: at most 2^color_bits entries, components 0 to 1.
  /// Empty: default_palette(color_bits).
  std::vector<Color> palette{};
  DepthFormat depth = DepthFormat::unorm24;
  int stencil_bits = 8;  ///< 0 to 8
  int alpha_bits = 0;    ///< 0 or 8, stored above the colour planes. 0: alpha reads as 1. RGB buffers only
  /// - Error diffusion refuses logic operations and partial plane masks. Pixels that draws gave an index keep
  ///   it and pass no error on.
  /// - Dither::pattern takes palettes of at most 256 entries.
  Dither dither = Dither::none;
  DitherSpace dither_in = DitherSpace::levels;
  /// DitherSpace::light: light is the stored value raised to this exponent, 1 to 4; 0: sRGB's curve.
  float dither_gamma = 0;
  int accumulation_bits = 0;  ///< 0, 16 or 32 per component, signed. RGB buffers only
  /// Coverage samples per pixel: 1, 4 or 8 (MSAA). RGB buffers only.
  /// - Coverage, depth test and stencil run per sample, at the Direct3D 11 standard positions.
  /// - Colour is evaluated once per pixel, at its centre, clamped to the range of the triangle's vertices.
  /// - Samples exist only within a frame: stored colour is their mean (resolve), stored depth and stencil are
  ///   sample 0. A frame that loads them starts every sample from the stored values.
  int samples = 1;
};

/// A built-in palette: "bw", "gray", "ega16", "vga256" or "web216".
/// @throws Error  for another name, or if the palette has more than 2^color_bits entries
TESSERA_API std::vector<Color> named_palette(std::string_view name, int color_bits);
/// bw at 1 bit, gray at 2 and 3 bits, ega16 at 4 to 7 bits, vga256 from 8 bits on.
TESSERA_API std::vector<Color> default_palette(int color_bits);

/// One bitplane as a 1-bit image: rows from the top, bit 7 of a byte is the leftmost pixel.
/// Borrowed from the frame buffer; valid until the next frame is finished or the frame buffer is destroyed.
struct PlaneView {
  const std::uint8_t* bits = nullptr;
  int width = 0, height = 0;        ///< pixels
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below
};

/// The caller's memory for a picture, 4 bytes per pixel. Alpha is 255, or the stored alpha.
struct ImageTarget {
  void* pixels = nullptr;           ///< the top row
  int width = 0, height = 0;        ///< pixels; must equal the frame buffer's
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below; 0: 4 * width; may be negative
  PixelOrder order = PixelOrder::rgba8;
  std::optional<Rect> region{};  ///< only these pixels are written; clipped to the picture; absent: all
};

/// How functions of FrameBuffer read a buffer back.
struct ReadOptions {
  /// The pixels that are read, down to one; must lie in the frame buffer. Absent: all.
  std::optional<Rect> region{};
  /// Reads with the workers of this renderer; null: on the calling thread. The values are the same.
  /// - The call and the renderer's finish() must not run concurrently. Within the renderer's own progress
  ///   callback, reading is single-threaded.
  Renderer* workers = nullptr;
};

/// A stack of bitplanes, one bit per pixel and plane.
/// - New buffers hold colour 0, depth 1, stencil 0, accumulation 0.
/// - Memory of a buffer is allocated when a frame first stores drawn content in it; a clear alone allocates
///   nothing.
/// - A frame buffer that was moved from may only be assigned to or destroyed.
/// @code
/// FrameBuffer buffer({.width = 320, .height = 200, .color_bits = 12, .depth = DepthFormat::float32});
/// Frame frame(buffer);
/// frame.clear({.color = Color{0.2f, 0.4f, 0.6f, 1}, .depth = 1.0});
/// renderer.finish(frame);
/// float depth = 0;
/// buffer.read_depth({&depth, 1}, {.region = Rect{160, 100, 1, 1}});
/// const PlaneView lowest_bit_of_blue = buffer.plane(Buffer::color, 0);
/// @endcode
class TESSERA_API FrameBuffer {
 public:
  /// @throws Error  for sizes, bits or palettes out of range, or out of memory
  explicit FrameBuffer(FrameBufferFormat format);
  /// Keeps the planes in the caller's memory, which must outlive the frame buffer.
  /// - Size: memory_bytes(format). Alignment: 64 bytes.
  /// - Order: planes of colour, depth, stencil, accumulation, each laid out as plane() returns it; with error
  ///   diffusion then the planes that keep 8 bits per component.
  /// - After finish() the memory holds the buffers that the frame kept; other buffers are unspecified.
  /// @throws Error  as above, and for memory that is too small or not aligned
  FrameBuffer(FrameBufferFormat format, std::span<std::byte> memory);
  /// Bytes that the planes of this format take.
  /// @throws Error  for sizes, bits or palettes out of range
  static std::size_t memory_bytes(const FrameBufferFormat& format);
  ~FrameBuffer();
  FrameBuffer(FrameBuffer&&) noexcept;
  FrameBuffer& operator=(FrameBuffer&&) noexcept;

  const FrameBufferFormat& format() const noexcept;

  /// Replaces the palette of a colour-index buffer.
  /// - At most 2^color_bits entries, components 0 to 1; empty: default_palette(color_bits).
  /// - Stored indices stay. Frames finished from now on map colours to the nearest of the new entries.
  /// @throws Error  for an RGB buffer, for entries out of range or too many, or out of memory; then the old
  ///                palette stays
  void set_palette(std::span<const Color> entries);

  /// Number of planes: colour and alpha bits; depth bits (0, 16, 24 or 32); stencil bits; 4 times the
  /// accumulation bits. 0 for a value that is no Buffer.
  int plane_count(Buffer buffer) const noexcept;
  /// Bytes allocated for the planes of a buffer; 0 before the first store, and for a value that is no Buffer.
  /// Colour includes the planes that error diffusion reads.
  std::size_t allocated_bytes(Buffer buffer) const noexcept;
  /// Plane k, counted from the lowest bit (of blue, of the index, of depth). Accumulation: all planes of red
  /// first, then green, blue, alpha. Allocates the buffer if necessary.
  /// @throws Error  if there is no such plane, or the last frame did not keep the buffer
  PlaneView plane(Buffer buffer, int k) const;

  // Functions that read the planes back, rows from the top. Spans hold one element per pixel that is read.
  // They throw Error for spans of another size, for regions that are not in the frame buffer, for a buffer
  // that the format lacks or that the last frame did not keep, and for a moved-from renderer.

  /// The picture that a display shows, through the palette.
  /// @param workers  see ReadOptions::workers; `target` has the region
  void read_color(const ImageTarget& target, Renderer* workers = nullptr) const;
  /// Stored words A:R:G:B, or indices.
  void read_packed_colors(std::span<std::uint32_t> words, const ReadOptions& options = {}) const;
  /// Depth, 0 near to 1 far.
  void read_depth(std::span<float> depth, const ReadOptions& options = {}) const;
  /// Stored levels of unorm formats; the bits of the float for float32.
  void read_stored_depths(std::span<std::uint32_t> words, const ReadOptions& options = {}) const;
  /// Distances from the eye plane along the view direction, in the camera's units.
  /// - Valid for draws with this projection and the depth range 0 to 1. The camera's view is ignored.
  /// - `background`, any float, is written where the depth is that of the far end.
  /// @throws Error  also if the projection is not finite, or does not map depth to one distance
  void read_view_depth(std::span<float> depth, const Camera& camera, float background = 0,
                       const ReadOptions& options = {}) const;
  /// Stencil values, 0 to 2^stencil_bits - 1.
  void read_stencil(std::span<std::uint8_t> stencil, const ReadOptions& options = {}) const;
  /// r g b a, -1 to 1: 4 floats per pixel.
  void read_accumulation(std::span<float> rgba, const ReadOptions& options = {}) const;

 private:
  friend class Renderer;
  friend class Frame;
  /// Null without a renderer. @throws Error  if it was moved from
  static detail::WorkerPool* worker_pool(Renderer* renderer, const char* function);
  std::unique_ptr<detail::FrameBufferState> state_;
};

}  // namespace tessera
