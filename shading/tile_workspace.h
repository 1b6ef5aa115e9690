// Memory in which a worker renders tiles.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "raster/sample_positions.h"
#include "raster/triangle_setup.h"
#include "shading/coarse_cells.h"
#include "shading/fragment_stage.h"
#include "shading/interpolate.h"
#include "shading/lighting.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;
/// Number of visible triangles after which a tile is shaded. Bounds memory; the pixels do not depend on it.
inline constexpr std::size_t kMaxVisibleTriangles = 1024;
/// The number is checked after each group.
inline constexpr std::size_t kVisibleTriangleCapacity = kMaxVisibleTriangles + kGroupSize;

struct alignas(64) TileNormals {
  float component[3][kMaxTileSize * kMaxTileSize];
};

/// Depth keys of visible fragments whose stage reads depth.
struct alignas(64) TileStageDepth {
  std::int32_t key[kMaxTileSize * kMaxTileSize];
};

struct alignas(64) TileStencil {
  std::int32_t value[kMaxTileSize * kMaxTileSize];
};

/// Buffers that draws work on: those of the tile, or of one sample.
struct TileAttachments {
  std::uint32_t* color;
  std::int32_t* depth;
  std::uint32_t* visibility;  ///< visibility buffer: numbers of triangles, or kNoTriangle
  std::int32_t* stencil;      ///< null if the frame has none
};

/// Attachments of a tile's samples. Depth, visibility and stencil of sample 0 are those of the tile.
struct alignas(64) TileSamples {
  /// Five cache lines more than a tile, so that the samples of a pixel map to different cache sets.
  static constexpr int kStride = kMaxTileSize * kMaxTileSize + 80;
  std::uint32_t color[kMaxSamples][kStride];
  std::int32_t depth[kMaxSamples][kStride];
  std::uint32_t visibility[kMaxSamples][kStride];
  std::int32_t stencil[kMaxSamples][kStride];
  /// The group, moved by the opposite of each sample's offset. For wide triangles and fragment operations.
  TriangleGroup group[kMaxSamples];
  SampleGroup samples32;
  /// Hierarchical z, per block: upper bound of the samples' depth keys.
  std::int32_t hiz_max[kMaxTileSize * kMaxTileSize / kBlockPixels];
  int clean_samples = 0, clean_pixels = 0;  ///< part of `visibility` that is known to be kNoTriangle

  TileAttachments of(int sample, bool has_stencil) {
    return {color[sample], depth[sample], visibility[sample], has_stencil ? stencil[sample] : nullptr};
  }
};

struct alignas(64) TileLevels {
  std::int32_t component[4][kMaxTileSize * kMaxTileSize];
};

/// Blocks that a point or line touches. Empty between two elements.
struct TouchedBlocks {
  static constexpr int kBlocks = kMaxTileSize * kMaxTileSize / kBlockPixels;
  int count = 0;
  std::uint16_t list[kBlocks];
  std::uint32_t samples[kBlocks] = {};            ///< samples with covered pixels, one bit each
  std::uint16_t bits[kMaxSamples][kBlocks] = {};  ///< covered pixels
};

/// A pixel after those of the tile. Kernels write pixels to it that must not change.
inline constexpr int kDiscardPixel = kMaxTileSize * kMaxTileSize;

struct alignas(64) TileColors {
  std::uint32_t packed[kDiscardPixel + 1];
};

struct alignas(64) TileWorkspace::Memory {
  std::uint32_t* color = nullptr;  ///< current tile: one of `colors`
  alignas(64) std::int32_t depth[kDiscardPixel + 1];
  alignas(64) std::uint32_t visibility[kMaxTileSize * kMaxTileSize];
  bool visibility_clean = false;  ///< all of `visibility` is kNoTriangle, as shading leaves it
  std::vector<ShadedTriangle> visible_triangles;
  std::vector<Edges64> edges64;
  TriangleGroup group;
  // Per triangle of the group: attributes of its vertices, and its number in the draw.
  const float* attributes[3][kGroupSize];
  std::uint32_t source[kGroupSize];
  ShadingBatch batch;
  CellBatch cells;      ///< empty, except while a surface with coarse shading is shaded
  CoarseBlocks coarse;  ///< the same
  StageArrays stage;    ///< points of `batch`, while a fragment stage runs
  // Per visible triangle, while they are shaded.
  TriangleInterpolants interpolants[kVisibleTriangleCapacity];
  std::int32_t surfaces[kVisibleTriangleCapacity];
  TouchedBlocks touched;
  DrawMeter* meter = nullptr;  ///< used if TileFrame::meter_pass asks for it
  std::vector<TileColors> colors;
  std::unique_ptr<TileNormals> normals;         ///< for captures
  std::unique_ptr<TileStencil> stencil;         ///< null if the frame has none
  std::unique_ptr<TileStageDepth> stage_depth;  ///< for stages that read depth and run on visible pixels
  std::unique_ptr<TileSamples> samples;         ///< with several samples per pixel
  std::unique_ptr<TileLevels> accumulation;     ///< for commands of the accumulation buffer

  AccumulatedPixels levels() {
    return {accumulation->component[0], accumulation->component[1], accumulation->component[2],
            accumulation->component[3]};
  }
};

}  // namespace tessera::detail
