// Which tiles a triangle may touch. Pure and without threads: each batch of triangles fills bins of its own, in submission
// order, and the tiles read the batches one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "framebuffer/check.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/tile_grid.h"
#include "raster/clip.h"
#include "raster/polygon_facing.h"
#include "raster/vertex_transform.h"

namespace tessera {

// A bin entry is a triangle of the current draw, or a marker that makes another draw current; a bitmap or an image is a marker alone.
inline constexpr std::uint32_t kDrawMarker = 0x80000000u;
inline constexpr std::uint32_t kClippedTriangle = 0x40000000u;  ///< the id counts in the batch's own list of clipped triangles
inline constexpr std::uint32_t kMaxTriangles = kClippedTriangle - 1;

/// A piece of a triangle that clipping cut, with its own vertices.
struct ClippedTriangle {
  WindowVertex vertices[3];
  float attributes[3][kMaxAttributes + kAttributePadding] = {};
  std::uint32_t source;  ///< the triangle that it was cut from
};

struct BinCounts {
  std::uint64_t triangles_in = 0, non_finite = 0, outside = 0, culled = 0, zero_area = 0, clipped = 0, binned = 0, entries = 0;
};

/// The bins of one batch: for each tile a list of blocks of entries.
class Bins {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kBlockEntries = 62;
  struct Block {
    std::uint32_t count, next;
    std::uint32_t entries[kBlockEntries];
  };

  void reset(int tile_count);
  void push(int tile, std::uint32_t draw, std::uint32_t id) {
    Tail& tail = tails_[static_cast<std::size_t>(tile)];
    if (tail.draw != draw) {
      tail.draw = draw;
      append(tail, kDrawMarker | draw);
    }
    append(tail, id);
    ++tail.triangles;
    ++counts.entries;
  }
  /// A draw that is a bitmap or an image.
  void push_draw(int tile, std::uint32_t draw) {
    Tail& tail = tails_[static_cast<std::size_t>(tile)];
    tail.draw = draw;
    append(tail, kDrawMarker | draw);
    ++tail.triangles;
    ++counts.entries;
  }
  /// The first block of a tile, or kNone.
  std::uint32_t first(int tile) const { return tails_[static_cast<std::size_t>(tile)].first; }
  /// How many triangles a tile's bin holds, bitmaps and images counted as one each.
  std::uint32_t triangles(int tile) const { return tails_[static_cast<std::size_t>(tile)].triangles; }
  const Block& block(std::uint32_t index) const { return blocks_[index]; }

  std::vector<ClippedTriangle> clipped;
  BinCounts counts;

 private:
  struct Tail {
    std::uint32_t first, last, draw, triangles;
  };
  void append(Tail& tail, std::uint32_t entry) {
    if (tail.last == kNone || blocks_[tail.last].count == kBlockEntries) add_block(tail);
    Block& block = blocks_[tail.last];
    block.entries[block.count++] = entry;
  }
  void add_block(Tail& tail);

  std::vector<Tail> tails_;
  std::vector<Block> blocks_;
  std::size_t used_ = 0;
};

/// What binning needs of a draw.
struct BinDraw {
  std::uint32_t draw = 0;                    ///< its number in the frame
  const WindowVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;    ///< null: vertices in order
  const std::uint8_t* codes = nullptr;
  bool any_code = false;                     ///< false: no vertex has one
  bool keep_front = true, keep_back = true;
  bool front_is_clockwise = false;           ///< seen in the window
  const Facing* facing = nullptr;            ///< of each triangle, where it is its polygon's; null: its own area decides
  PixelRect rect;                            ///< scissor, viewport and frame buffer
  std::int32_t sample_reach = 0;             ///< how far a pixel is looked at around its centre, 1/256 pixel
  // For clipping.
  const VertexTransform* transform = nullptr;
  StridedFloats positions;
  int components = 3;
  const float* attributes = nullptr;
  int attribute_count = 0, attribute_stride = 0;
};

/// True for a triangle whose snapped area faces the viewer; `area` is its doubled area in raster space (y down).
constexpr bool is_front(double area, bool front_is_clockwise) { return (area < 0) != front_is_clockwise; }

inline std::uint32_t vertex_index(const BinDraw& draw, std::uint32_t triangle, int corner) {
  const std::uint32_t i = triangle * 3 + static_cast<std::uint32_t>(corner);
  return draw.indices ? draw.indices[i] : i;
}

/// A triangle after clipping, in the window.
struct WindowPolygon {
  ClippedPolygon clipped;                    ///< with the attributes that were asked for
  WindowVertex window[kMaxClippedVertices];
  double area = 0;                           ///< doubled; of what snapping left of it
};
/// @param codes  the three vertices' codes or-ed
WindowPolygon clip_to_window(const BinDraw& draw, std::uint32_t triangle, std::uint8_t codes, int attribute_count);

constexpr double doubled_area(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) - static_cast<double>(c.x - a.x) * (b.y - a.y);
}

/// Bins a bitmap or an image that changes pixels of a rectangle, not empty.
void bin_pixels(Bins& bins, const TileGrid& grid, std::uint32_t draw, const PixelRect& rect);

/// Culls and bins triangles [first, last) of a draw.
void bin_triangles(Bins& bins, const TileGrid& grid, const BinDraw& draw, std::uint32_t first, std::uint32_t last, Isa isa);

}  // namespace tessera
