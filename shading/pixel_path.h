// The code that the pixels of a draw go through. It is chosen once per draw, when the frame is planned;
// tiles map it to functions of their instruction set and decide nothing themselves.
#pragma once

#include <cstdint>
#include <string>

#include "framebuffer/format.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

struct TileDraw;

/// How a visible pixel gets its color.
enum class ColorWrite : std::uint8_t {
  none,          ///< no color plane changes
  constant,      ///< one packed color per primitive
  interpolated,  ///< interpolated in registers, stored at once
  blended,       ///< interpolated in registers, mixed by alpha with the stored 8-bit RGB color
  evaluated,     ///< floating-point colors of a block, which go through the fragment operations
  deferred       ///< the visibility buffer gets the primitive; its pixels are shaded later, in batches
};

constexpr bool is_interpolated(ColorWrite write) {
  return write == ColorWrite::interpolated || write == ColorWrite::blended;
}

/// Code that tests depth and stencil.
enum class DepthTestPath : std::uint8_t {
  less_write,  ///< Compare::less with depth writes and without operations, which most draws use
  generic      ///< any test, with or without writes; triangles may have a stencil test
};

struct PixelPath {
  enum class Kind : std::uint8_t {
    triangles,           ///< by size: pixels, boxes or rows of blocks
    triangles_msaa,      ///< the same with several samples; groups with wide triangles: as fragments
    textured_triangles,  ///< texels and colors in registers, stored at once
    fragments,           ///< triangles with fragment operations, block by block
    fragments_msaa,      ///< the same with several samples
    points,              ///< packed colors, just stored
    lines,               ///< packed or interpolated colors, just stored
    point_fragments,     ///< blocks of fragments, as for triangles
    line_fragments,      ///< blocks of fragments, as for triangles
    pixel_rectangle      ///< a bitmap or an image: blocks of fragments
  };
  Kind kind = Kind::triangles;
  ColorWrite color_write = ColorWrite::constant;
  DepthTestPath depth_test = DepthTestPath::generic;  ///< triangles, triangles_msaa
  DepthFormat depth_format = DepthFormat::none;       ///< none: the draw uses no depth

  bool uses_depth() const { return depth_format != DepthFormat::none; }
  bool operator==(const PixelPath&) const = default;
};

/// Properties of a frame that decide the paths of its draws.
struct PixelPathFrame {
  ColorLayout layout;
  DepthFormat depth_format = DepthFormat::none;
  int samples = 1;                 ///< per pixel: 1, 4 or 8
  bool shade_immediately = false;  ///< as TileFrame::shade_immediately
  InstructionSet isa = InstructionSet::scalar;
};

/// Reads everything of `draw` but its path and the contents of its arrays.
PixelPath choose_pixel_path(const PixelPathFrame& frame, const TileDraw& draw);

const char* name(PixelPath::Kind kind);
const char* name(ColorWrite color_write);
/// One line without its end, for example "triangles, colour interpolated, depth unorm24, less and write".
std::string describe(const PixelPath& path);

}  // namespace tessera::detail
