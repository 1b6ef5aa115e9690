// The code path of a draw's pixels. It is chosen once per draw, when the frame is planned; tiles only map it
// to functions of their instruction set.
#pragma once

#include <cstdint>
#include <string>

#include "framebuffer/format.h"
#include "framebuffer/tessera/enums.hpp"

namespace tessera::detail {

struct TileDraw;

/// How a visible pixel gets its colour.
enum class ColorWrite : std::uint8_t {
  none,          ///< no colour plane changes
  constant,      ///< one packed colour per primitive
  interpolated,  ///< interpolated in registers, stored immediately
  blended,       ///< interpolated in registers, mixed by alpha with the stored 8-bit RGB colour
  evaluated,     ///< floating-point colours of a block, which go through the fragment operations
  deferred       ///< the primitive's number goes to the visibility buffer; batches are shaded later
};

constexpr bool is_interpolated(ColorWrite write) {
  return write == ColorWrite::interpolated || write == ColorWrite::blended;
}

/// Code that tests depth and stencil.
enum class DepthTestPath : std::uint8_t {
  less_write,  ///< Compare::less with depth writes and without fragment operations: the most common case
  generic      ///< any test, with or without writes; triangles may have a stencil test
};

struct PixelPath {
  enum class Kind : std::uint8_t {
    triangles,           ///< depending on size: pixels, boxes or rows of blocks
    triangles_msaa,      ///< several samples, block by block; groups with wide triangles: fragments_msaa
    textured_triangles,  ///< texels and colours in registers, stored immediately
    fragments,           ///< triangles with fragment operations, block by block
    fragments_msaa,      ///< `fragments` with several samples
    points,              ///< packed colours, stored immediately
    lines,               ///< packed or interpolated colours, stored immediately
    point_fragments,     ///< points as blocks of fragments
    line_fragments,      ///< lines as blocks of fragments
    pixel_rectangle      ///< a bitmap or an image: blocks of fragments
  };
  Kind kind = Kind::triangles;
  ColorWrite color_write = ColorWrite::constant;
  DepthTestPath depth_test = DepthTestPath::generic;  ///< triangles, triangles_msaa
  DepthFormat depth_format = DepthFormat::none;       ///< none: depths of the draw are not computed

  bool uses_depth() const { return depth_format != DepthFormat::none; }
  bool operator==(const PixelPath&) const = default;
};

/// Properties of a frame on which the paths of its draws depend.
struct PixelPathFrame {
  ColorLayout layout;
  DepthFormat depth_format = DepthFormat::none;
  int samples = 1;                 ///< per pixel: 1, 4 or 8
  bool shade_immediately = false;  ///< as TileFrame::shade_immediately
  InstructionSet isa = InstructionSet::scalar;
};

/// Reads all fields of `draw` except `path`, and no elements of its arrays.
PixelPath choose_pixel_path(const PixelPathFrame& frame, const TileDraw& draw);

const char* name(PixelPath::Kind kind);
const char* name(ColorWrite color_write);
/// One line without its end, for example "triangles, colour interpolated, depth unorm24, less and write".
std::string describe(const PixelPath& path);

}  // namespace tessera::detail
