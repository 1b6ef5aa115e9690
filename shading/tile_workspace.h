// The memory that a worker renders tiles in.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "raster/sample_positions.h"
#include "raster/triangle_setup.h"
#include "shading/interpolate.h"
#include "shading/lighting.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;
/// Triangles that a tile collects before it shades them: bounds the memory, changes no bit.
inline constexpr std::size_t kMaxVisibleTriangles = 1024;
inline constexpr std::size_t kVisibleTriangleCapacity =
    kMaxVisibleTriangles + kGroupSize;  ///< with the group in which it gets there

struct alignas(64) TileNormals {
  float component[3][kMaxTileSize * kMaxTileSize];
};

struct alignas(64) TileStencil {
  std::int32_t value[kMaxTileSize * kMaxTileSize];
};

/// The pixels that draws work on: of the tile, or of one of its samples.
struct TileAttachments {
  std::uint32_t* color;
  std::int32_t* depth;
  std::uint32_t* visibility;  ///< triangles seen and not shaded yet; kNoTriangle elsewhere
  std::int32_t* stencil;      ///< null where the frame has none
};

/// What a tile's samples hold. Depth, visibility and stencil of sample 0 are the tile's own.
struct alignas(64) TileSamples {
  /// Five cache lines more than a tile: the same pixel of two samples falls into different sets of a cache.
  static constexpr int kStride = kMaxTileSize * kMaxTileSize + 80;
  std::uint32_t color[kMaxSamples][kStride];
  std::int32_t depth[kMaxSamples][kStride];
  std::uint32_t visibility[kMaxSamples][kStride];
  std::int32_t stencil[kMaxSamples][kStride];
  TriangleGroup
      group[kMaxSamples];  ///< moved the other way: of wide triangles, and for draws with operations
  SampleGroup samples32;
  std::int32_t hiz_max[kMaxTileSize * kMaxTileSize /
                       kBlockPixels];       ///< no depth key of a sample in the block is greater
  int clean_samples = 0, clean_pixels = 0;  ///< so much of `visibility` is kNoTriangle

  TileAttachments of(int sample, bool has_stencil) {
    return {color[sample], depth[sample], visibility[sample], has_stencil ? stencil[sample] : nullptr};
  }
};

struct alignas(64) TileLevels {
  std::int32_t component[4][kMaxTileSize * kMaxTileSize];
};

/// The blocks that a point or line touches. Between two of them all is zero.
struct TouchedBlocks {
  static constexpr int kBlocks = kMaxTileSize * kMaxTileSize / kBlockPixels;
  int count = 0;
  std::uint16_t list[kBlocks];
  std::uint32_t samples[kBlocks] = {};            ///< that have bits
  std::uint16_t bits[kMaxSamples][kBlocks] = {};  ///< of the pixels
};

/// A pixel behind those of a tile: what is stored there nobody sees.
inline constexpr int kDiscardPixel = kMaxTileSize * kMaxTileSize;

struct alignas(64) TileColors {
  std::uint32_t packed[kDiscardPixel + 1];
};

struct alignas(64) TileWorkspace::Memory {
  std::uint32_t* color = nullptr;  ///< of the tile that is rendered: one of `colors`
  alignas(64) std::int32_t depth[kDiscardPixel + 1];
  alignas(64) std::uint32_t
      visibility[kMaxTileSize * kMaxTileSize];  ///< triangles seen and not shaded yet; kNoTriangle elsewhere
  bool visibility_clean = false;                ///< every id is kNoTriangle: shading leaves them so
  std::vector<ShadedTriangle> visible_triangles;
  std::vector<Edges64> edges64;
  TriangleGroup group;
  // Of the group's triangles.
  const float* attributes[3][kGroupSize];
  std::uint32_t source[kGroupSize];
  ShadingBatch batch;
  // Of the triangles that were collected, while they are shaded.
  TriangleInterpolants interpolants[kVisibleTriangleCapacity];
  std::int32_t surfaces[kVisibleTriangleCapacity];
  TouchedBlocks touched;
  std::vector<TileColors> colors;
  std::unique_ptr<TileNormals> normals;      ///< only where a capture wants them
  std::unique_ptr<TileStencil> stencil;      ///< only where a draw or clear has it
  std::unique_ptr<TileSamples> samples;      ///< only where a frame has several for each pixel
  std::unique_ptr<TileLevels> accumulation;  ///< only where a command works on it

  AccumulatedPixels levels() {
    return {accumulation->component[0], accumulation->component[1], accumulation->component[2],
            accumulation->component[3]};
  }
};

}  // namespace tessera::detail
