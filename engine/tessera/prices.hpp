// Prices: what effects cost in time on one machine, and the time of a frame that follows from them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "types.hpp"

namespace tessera {

/// An item that has a price. The price of an effect is what it adds to the item that it is an effect of:
/// blending to a covered pixel, an attenuation to a light. New enumerators are appended.
enum class PriceItem : std::uint8_t {
  // The frame and its buffers.
  frame,              ///< a frame that draws nothing
  draw,               ///< a draw of one small triangle, without its vertices and the triangle
  shown_pixel,        ///< a pixel of a tile without triangles, written to an image
  shown_tile_pixel,   ///< a pixel of a tile with triangles: cleared, then written to an image
  shown_index_pixel,  ///< addition of a palette to it
  depth_tile_pixel,   ///< addition of a depth buffer to it: its clear
  stored_1,           ///< a pixel stored in 1 colour plane
  stored_2,           ///< in 2 colour planes
  stored_4,           ///< in 4 colour planes
  stored_8,           ///< in 8 colour planes
  stored_16,          ///< in 16 colour planes
  stored_24,          ///< in 24 colour planes
  stored_depth_16,    ///< a pixel stored in 16 depth planes
  stored_depth_24,    ///< in 24 depth planes
  stored_depth_32,    ///< in 32 depth planes
  stored_stencil_8,   ///< a pixel stored in 8 stencil planes
  loaded_24,          ///< a pixel loaded from 24 colour planes
  dithered_clear,     ///< a pixel of a clear to a dithered colour
  accumulated,        ///< a pixel added to an accumulation buffer of 16 bits
  returned,           ///< a pixel returned from it to the colour buffer
  resolved_4,         ///< addition of 4 samples to it: clear and resolve
  resolved_8,         ///< addition of 8 samples to it
  // Vertices.
  vertex,                    ///< a transformed vertex
  vertex_colors,             ///< the colour of a vertex
  vertex_lighting,           ///< lighting of a vertex, without its lights
  vertex_normalization,      ///< DrawState::normalize
  vertex_directional_light,  ///< a directional light at a vertex
  vertex_point_light,        ///< a light with a position at a vertex
  vertex_attenuation,        ///< its attenuation
  vertex_spot,               ///< its cone, with an exponent
  vertex_highlight,          ///< a highlight, viewer at infinity
  vertex_local_viewer,       ///< addition of a local viewer to a highlight
  vertex_second_side,        ///< two-sided lighting of a vertex by one directional light
  vertex_normals,            ///< the normal and position of a vertex, for lit pixels
  generated_normal,          ///< a mean normal that is generated for a vertex
  face_normal,               ///< a normal that is generated for a face
  // Triangles of one colour, without depth; with their pixels.
  triangle_outside,   ///< outside the view volume
  triangle_culled,    ///< dropped by DrawState::cull
  triangle_clipped,   ///< addition of clipping to a triangle
  triangle_0,         ///< between the centres of pixels
  triangle_1,         ///< covers 1 pixel
  triangle_4,         ///< covers 4 pixels
  triangle_16,        ///< covers 16 pixels
  triangle_64,        ///< covers 64 pixels
  triangle_256,       ///< covers 256 pixels
  triangle_1024,      ///< covers 1,024 pixels
  triangle_4096,      ///< covers 4,096 pixels
  point,              ///< a point of one pixel
  line_16,            ///< a line of 16 pixels
  point_fragments,    ///< a point of one pixel with fragment operations
  line_16_fragments,  ///< a line of 16 pixels with fragment operations
  outlined_triangle,  ///< a triangle whose edges are drawn, without its pixels
  outlined_pixel,     ///< a pixel of an edge
  texel_pixel,        ///< a pixel of Frame::draw_image
  // Additions of effects to triangles and to their covered pixels.
  depth_triangle,                ///< depth test `less` and write: a triangle
  depth_unorm16_pixel,           ///< a covered pixel, by format
  depth_unorm24_pixel,           ///< a covered pixel with 24 bits
  depth_unorm32_pixel,           ///< a covered pixel with 32 bits
  depth_float32_pixel,           ///< a covered pixel with floats
  interpolated_triangle,         ///< interpolated colours, drawn immediately
  interpolated_pixel,            ///< a covered pixel with interpolated colours
  samples_4_triangle,            ///< 4 samples per pixel, with depth
  samples_4_pixel,               ///< a covered pixel with 4 samples
  samples_8_triangle,            ///< 8 samples per pixel, with depth
  samples_8_pixel,               ///< a covered pixel with 8 samples
  source_alpha_blend_triangle,   ///< blending by source alpha, which has a special code path: a triangle
  source_alpha_blend_pixel,      ///< a covered pixel in that code path
  fragment_operations_triangle,  ///< the code path of all other fragment operations
  fragment_operations_pixel,     ///< a covered pixel in that code path that fails a test
  fragment_passed,               ///< addition for a covered pixel that passes
  fragment_samples_4_triangle,   ///< 4 samples per pixel in that code path
  fragment_samples_4_pixel,      ///< a covered pixel with 4 samples in that code path
  fragment_samples_8_triangle,   ///< 8 samples per pixel in that code path
  fragment_samples_8_pixel,      ///< a covered pixel with 8 samples in that code path
  alpha_test,                    ///< on a covered pixel, in that code path, like the following
  blending,                      ///< any blending; this and the following on pixels that pass the tests
  stencil_test,                  ///< a stencil test with an action
  logic_op,                      ///< a logic operation
  dither,                        ///< ordered dither
  write_masks,                   ///< a colour mask
  polygon_offset,                ///< a polygon offset
  palette_search_16,             ///< nearest of 16 palette entries
  palette_search_256,            ///< nearest of 256 palette entries
  // Additions of shading to visible pixels.
  deferred_triangle,               ///< a triangle in the visibility buffer
  deferred_pixel,                  ///< a visible pixel that is shaded from it, in one colour
  interpolated_deferred_pixel,     ///< interpolated colours of a visible pixel
  shaded_pixel,                    ///< lighting of a pixel, without its lights, normals renormalized
  pixel_directional_light,         ///< a directional light at a pixel
  pixel_point_light,               ///< a light with a position at a pixel
  pixel_attenuation,               ///< its attenuation
  pixel_spot,                      ///< its cone, with an exponent
  pixel_highlight,                 ///< a highlight, viewer at infinity
  pixel_local_viewer,              ///< addition of a local viewer to a highlight
  pixel_second_side,               ///< two-sided lighting of a pixel
  texture_nearest,                 ///< a texture on a pixel, by filter
  texture_linear,                  ///< four texels
  texture_nearest_mipmap_nearest,  ///< one texel of one level
  texture_linear_mipmap_nearest,   ///< four texels of one level
  texture_nearest_mipmap_linear,   ///< one texel of two levels
  texture_linear_mipmap_linear,    ///< four texels of two levels
  // The finished frame.
  diffused_pixel,       ///< a pixel of a frame with error diffusion, on one thread
  diffused_index_pixel  ///< addition of a palette to it
};
inline constexpr std::size_t kPriceItems = static_cast<std::size_t>(PriceItem::diffused_index_pixel) + 1;

/// Unit in which an item is counted.
enum class PriceUnit : std::uint8_t {
  frame,
  draw,
  frame_pixel,  ///< pixel of the frame buffer, drawn or not
  vertex,
  element,        ///< triangle, point or line
  covered_pixel,  ///< before any test; overdraw counts
  shaded_pixel    ///< evaluation of a colour: FrameStats::shaded_pixels
};

/// Stable name for programs: "pixel_spot". Empty for values that are no enumerators.
TESSERA_API std::string_view code(PriceItem item);
TESSERA_API PriceUnit unit(PriceItem item);
TESSERA_API std::string_view name(PriceUnit unit);

/// Time of one unit of an item on one thread.
struct Price {
  double nanoseconds = 0;    ///< noise can make small prices negative
  double low = 0, high = 0;  ///< 95 % confidence interval
};

/// The prices of one machine. `tessera price` measures them.
struct PriceList {
  std::string processor{};        ///< name of the CPU
  std::string instruction_set{};  ///< name(InstructionSet)
  std::string version{};          ///< version() of the library
  std::array<Price, kPriceItems> prices{};

  Price& operator[](PriceItem item) { return prices[static_cast<std::size_t>(item)]; }
  const Price& operator[](PriceItem item) const { return prices[static_cast<std::size_t>(item)]; }
};

/// The work of a frame: how many units of each item it has.
struct WorkCounts {
  std::array<double, kPriceItems> units{};

  double& operator[](PriceItem item) { return units[static_cast<std::size_t>(item)]; }
  double operator[](PriceItem item) const { return units[static_cast<std::size_t>(item)]; }
};

/// Whether an item is a triangle of a certain number of pixels: `triangle_0` to `triangle_4096`.
TESSERA_API bool is_triangle_size(PriceItem item);
/// Counts triangles by their mean size: between two sizes that have a price, as a mixture of both.
/// @param covered_pixels  of all of them together
TESSERA_API void add_triangles(WorkCounts& counts, double triangles, double covered_pixels);

/// Time of a frame with this work: the sum of units times prices. Items without a price count as 0. `frame`,
/// `draw` and error diffusion count on one thread; the rest is divided by the threads.
/// @param threads  at least 1
/// @throws Error  for threads out of range
TESSERA_API double predicted_seconds(const WorkCounts& counts, const PriceList& prices, int threads);

}  // namespace tessera
