// Coarse shading: a triangle is lit once per cell of 2x2 or 4x4 pixels. Twin: coarse_cells_reference.h.
//
// Cells are fixed to the frame buffer: the first one begins at its top left pixel, so that a cell lies within
// one block. The lit colour of a cell depends on the triangle and the cell alone: inputs of lighting are
// evaluated at
//   1. the cell's centre, if it is inside of the triangle; otherwise at
//   2. the centre of a pixel of the cell that the triangle covers: the first one in kPixelOrder; otherwise
//   3. the cell's centre, where negative weights count as 0. With several samples a pixel may be visible
//      whose centre is not covered.
// Weights are never negative, so values never leave the range of the vertices, except for rounding.
#if defined(TESSERA_SHADING_COARSE_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_COARSE_CELLS_INL_H_
#undef TESSERA_SHADING_COARSE_CELLS_INL_H_
#else
#define TESSERA_SHADING_COARSE_CELLS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>

#include "shading/batch_surface-inl.h"
#include "shading/coarse_cells.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void light_points_lanes(const LightingProgram& program, ShadingBatch& batch, int count);  // lighting.cpp

/// Weights of one triangle's vertices at the cells of a block, lane by lane.
struct CellWeights {
  alignas(64) float w[3][kLanes];
};

/// Pixels of the block whose centres the triangle covers, 16 bits. Not those that are visible.
HWY_INLINE std::uint32_t covered_pixels(const ShadedTriangle& t, const Edges64* edges64, int bx, int by) {
  std::uint32_t bits = 0;
  if (t.edges64_index < 0) {
    const BlockEdges32 edges(t, bx, by);
    for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
      const Int signs = hn::Or(hn::Or(edges.at(0, chunk), edges.at(1, chunk)), edges.at(2, chunk));
      bits |= mask_bits(kInt, hn::Gt(signs, splat(-1))) << (chunk * kLanes);
    }
    return bits;
  }
  const Edges64& edges = edges64[t.edges64_index];
  for (int p = 0; p < kBlockPixels; ++p) {
    bool is_inside = true;
    for (int k = 0; k < 3; ++k)
      is_inside &= edges.e[k] + edges.a[k] * (bx + kBlockColumn[p]) + edges.b[k] * (by + kBlockRow[p]) >= 0;
    bits |= (is_inside ? 1u : 0u) << p;
  }
  return bits;
}

/// Weight of vertex k at the centre of a pixel.
HWY_INLINE float weight_at_pixel(const ShadedTriangle& t, const Edges64* edges64, int k, int x, int y) {
  if (t.edges64_index < 0) return std::fma(static_cast<float>(t.edges.at(k, x, y)), t.scale[k], t.shift[k]);
  const Edges64& edges = edges64[t.edges64_index];
  return static_cast<float>(edges.e[k] + edges.a[k] * x + edges.b[k] * y) * t.scale[k];
}

/// Exact edge k of a narrow triangle at pixels.
HWY_INLINE Int edges_at(const ShadedTriangle& t, int k, Int x, Int y) {
  return hn::Add(splat(t.edges.e[k]),
                 hn::Add(hn::Mul(splat(t.edges.a[k]), x), hn::Mul(splat(t.edges.b[k]), y)));
}

/// Replaces the weights of cells of 2x2 pixels of a narrow triangle, where `outside`, by those at the cell's
/// first covered pixel.
/// @param edges  at the cells' first pixels
template <class Mask>
HWY_INLINE void move_to_pixels_2x2(const ShadedTriangle& t, const Int (&edges)[3], Mask outside,
                                   Float (&weights)[3]) {
  // In reverse order: the first one remains.
  for (int pixel = 3; pixel >= 0; --pixel) {
    Int at[3];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t step = ((pixel & 1) != 0 ? t.edges.a[k] : 0) + ((pixel & 2) != 0 ? t.edges.b[k] : 0);
      at[k] = hn::Add(edges[k], splat(step));
    }
    const auto covered = hn::Gt(hn::Or(hn::Or(at[0], at[1]), at[2]), splat(-1));
    const auto moved = hn::And(outside, hn::RebindMask(kFloat, covered));
    for (int k = 0; k < 3; ++k)
      weights[k] = hn::IfThenElse(
          moved, mul_add(hn::ConvertTo(kFloat, at[k]), splat(t.scale[k]), splat(t.shift[k])), weights[k]);
  }
}

/// Replaces the weights of cells whose centre is outside by those at a covered pixel of the cell, if any.
/// @param first    cell of lane 0
/// @param outside  one bit per lane
inline HWY_NOINLINE void move_to_pixels(const ShadedTriangle& t, const Edges64* edges64, int size, int bx,
                                        int by, int first, std::uint32_t outside, CellWeights& weights) {
  const std::uint32_t covered = covered_pixels(t, edges64, bx, by);
  for (std::uint32_t left = outside; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    const int pixel = first_covered_pixel(size, first + lane, covered);
    if (pixel < 0) continue;
    for (int k = 0; k < 3; ++k)
      weights.w[k][lane] = weight_at_pixel(t, edges64, k, bx + kBlockColumn[pixel], by + kBlockRow[pixel]);
  }
}

/// Weights of a wide triangle at the centres of `cells` cells from `first` on.
inline HWY_NOINLINE void wide_weights(const ShadedTriangle& t, const Edges64& edges, int size, int bx, int by,
                                      int first, int cells, Float (&weights)[3]) {
  const double to_center = (size - 1) * 0.5;
  for (int k = 0; k < 3; ++k) {
    alignas(64) float w[kLanes] = {};
    for (int l = 0; l < std::min(cells, kLanes); ++l)
      w[l] = static_cast<float>(edges.e[k] + edges.a[k] * (bx + cell_columns(size)[first + l] + to_center) +
                                edges.b[k] * (by + cell_rows(size)[first + l] + to_center)) *
             t.scale[k];
    weights[k] = hn::Load(kFloat, w);
  }
}

/// Barycentric coordinates at which lanes of cells, from cell `first` of the block on, are lit.
/// @param wanted  cells that are needed, one bit per lane
HWY_INLINE Barycentric barycentric_of_cells(const ShadedTriangle& t, const Edges64* edges64, int size, int bx,
                                            int by, int first, std::uint32_t wanted) {
  const Float zero = hn::Zero(kFloat);
  const bool is_narrow = t.edges64_index < 0;
  Int edges[3];
  Float w[3];
  if (HWY_LIKELY(is_narrow)) {
    const Int x = hn::Add(splat(bx), hn::LoadU(kInt, cell_columns(size) + first));
    const Int y = hn::Add(splat(by), hn::LoadU(kInt, cell_rows(size) + first));
    const float to_center = static_cast<float>(size - 1) * 0.5f;
    for (int k = 0; k < 3; ++k) {
      edges[k] = edges_at(t, k, x, y);
      const float steps = to_center * static_cast<float>(t.edges.a[k] + t.edges.b[k]);  // exact
      w[k] = mul_add(hn::ConvertTo(kFloat, edges[k]), splat(t.scale[k]),
                     splat(std::fma(steps, t.scale[k], t.shift[k])));
    }
  } else {
    wide_weights(t, edges64[t.edges64_index], size, bx, by, first, cells_per_block(size), w);
  }
  const auto outside = hn::Not(hn::And(hn::And(hn::Ge(w[0], zero), hn::Ge(w[1], zero)), hn::Ge(w[2], zero)));
  const std::uint32_t outside_bits = wanted & mask_bits(kFloat, outside);
  if (outside_bits != 0 && size == 2 && is_narrow) {
    move_to_pixels_2x2(t, edges, outside, w);
  } else if (outside_bits != 0) {
    CellWeights weights;
    for (int k = 0; k < 3; ++k) hn::Store(w[k], kFloat, weights.w[k]);
    move_to_pixels(t, edges64, size, bx, by, first, outside_bits, weights);
    for (int k = 0; k < 3; ++k) w[k] = hn::Load(kFloat, weights.w[k]);
  }
  for (Float& weight : w) weight = greater_of(weight, zero);
  const Float inverse = hn::Div(splat(1.0f), hn::Add(hn::Add(w[0], w[1]), w[2]));
  return {hn::Mul(w[1], inverse), hn::Mul(w[2], inverse), inverse};
}

/// Adds a cell that is lit at barycentric coordinates b1 and b2. Lanes are attributes.
HWY_INLINE void add_cell(const BatchSurface& surface, const std::uint8_t* fields,
                         const InterpolantArrays& values, float b1, float b2, CellBatch& cells) {
  alignas(64) float value[kAttributePadding];
  for (int j = 0; j < surface.cell_attribute_count; j += kLanes) {
    const InterpolantLanes lanes{hn::Load(kFloat, values.first + j), hn::Load(kFloat, values.to_second + j),
                                 hn::Load(kFloat, values.to_third + j)};
    hn::Store(interpolate({splat(b1), splat(b2), splat(1.0f)}, lanes), kFloat, value + j);
  }
  for (int j = 0; j < surface.cell_attribute_count; ++j)
    cells.points.field[fields[j]][cells.count] = value[j];
  ++cells.count;
}

/// add_cell() for the cells in lanes 0 to 3. Lanes are cells. @pre kBatchPoints has room for a vector
HWY_INLINE void add_four_cells(const BatchSurface& surface, const std::uint8_t* fields,
                               const InterpolantArrays& values, const Barycentric& at, CellBatch& cells) {
  for (int j = 0; j < surface.cell_attribute_count; ++j)
    hn::StoreU(interpolate(at, values, j), kFloat, cells.points.field[fields[j]] + cells.count);
  cells.count += 4;
}

/// Adds the cells of one triangle in the block at (bx, by) that contain one of `covered`, and stores the cell
/// of each of these pixels. @pre `cells` has room for them: CellBatch::has_room()
/// @param covered        16 bits
/// @param cell_of_pixel  16 numbers; those of other pixels are unchanged
inline HWY_NOINLINE void add_cells(const TileContext& context, const BatchSurface& surface,
                                   const ShadedTriangle& triangle, int bx, int by, std::uint32_t covered,
                                   CellBatch& cells, std::int32_t* cell_of_pixel) {
  const Edges64* const edges64 = context.memory.edges64.data();
  const std::uint8_t* const fields = surface.tile_draw->fields;
  const int size = surface.cell_size;
  const std::uint32_t wanted = cells_of_pixels(size, covered);
  const std::int32_t* const ranks = cell_ranks(size, wanted);
  for (int chunk = 0; chunk < kChunksPerBlock; ++chunk) {
    const Int cell = hn::Add(splat(cells.count), hn::Load(kInt, ranks + chunk * kLanes));
    store_where(mask_from_bits(chunk_bits(covered, chunk)), cell, kInt, cell_of_pixel + chunk * kLanes);
  }
  const InterpolantArrays values(triangle, surface.first_attribute, surface.cell_attribute_count);
  constexpr std::uint32_t kLaneBits = (1u << kLanes) - 1;
  for (int first = 0; first < cells_per_block(size); first += kLanes) {
    const std::uint32_t bits = wanted >> first & kLaneBits;
    if (bits == 0) continue;
    const Barycentric at = barycentric_of_cells(triangle, edges64, size, bx, by, first, bits);
    if (kLanes >= 4 && bits == 15 && cells.count + kLanes <= kBatchPoints) {
      add_four_cells(surface, fields, values, at, cells);
      continue;
    }
    alignas(64) float b1[kLanes], b2[kLanes];
    hn::Store(at.b1, kFloat, b1);
    hn::Store(at.b2, kFloat, b2);
    for (std::uint32_t left = bits; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      add_cell(surface, fields, values, b1[lane], b2[lane], cells);
    }
  }
}

/// Lights the cells.
HWY_INLINE void light_cells(const BatchSurface& surface, CellBatch& cells) {
  light_points_lanes(*surface.cell_program, cells.points, (cells.count + kLanes - 1) / kLanes * kLanes);
}

/// Copies the lit colours of cells to `count` points of the batch, whole vectors.
/// @param cell_of_point  numbers of points that are not used may be any within CellBatch
HWY_INLINE void spread_cells(const CellBatch& cells, const std::int32_t* cell_of_point, ShadingBatch& batch,
                             int count) {
  for (int c = 0; c < 3; ++c) {
    const auto* const colors = reinterpret_cast<const std::uint32_t*>(cells.points.field[kColorR + c]);
    for (int point = 0; point < count; point += kLanes)
      hn::Store(hn::BitCast(kFloat, load_words(colors, hn::Load(kInt, cell_of_point + point))), kFloat,
                batch.field[kColorR + c] + point);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
