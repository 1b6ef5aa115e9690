// Names and units of prices, and the time of a frame that follows from its work.
#include "engine/tessera/prices.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "engine/tessera/types.hpp"

namespace tessera {
namespace {

struct ItemWords {
  PriceItem item;
  std::string_view code;  ///< stable, for programs
  PriceUnit unit;
};
constexpr ItemWords kItems[] = {
    {PriceItem::frame, "frame", PriceUnit::frame},
    {PriceItem::draw, "draw", PriceUnit::draw},
    {PriceItem::shown_pixel, "shown_pixel", PriceUnit::frame_pixel},
    {PriceItem::shown_tile_pixel, "shown_tile_pixel", PriceUnit::frame_pixel},
    {PriceItem::shown_index_pixel, "shown_index_pixel", PriceUnit::frame_pixel},
    {PriceItem::depth_tile_pixel, "depth_tile_pixel", PriceUnit::frame_pixel},
    {PriceItem::stored_1, "stored_1", PriceUnit::frame_pixel},
    {PriceItem::stored_2, "stored_2", PriceUnit::frame_pixel},
    {PriceItem::stored_4, "stored_4", PriceUnit::frame_pixel},
    {PriceItem::stored_8, "stored_8", PriceUnit::frame_pixel},
    {PriceItem::stored_16, "stored_16", PriceUnit::frame_pixel},
    {PriceItem::stored_24, "stored_24", PriceUnit::frame_pixel},
    {PriceItem::stored_depth_16, "stored_depth_16", PriceUnit::frame_pixel},
    {PriceItem::stored_depth_24, "stored_depth_24", PriceUnit::frame_pixel},
    {PriceItem::stored_depth_32, "stored_depth_32", PriceUnit::frame_pixel},
    {PriceItem::stored_stencil_8, "stored_stencil_8", PriceUnit::frame_pixel},
    {PriceItem::loaded_24, "loaded_24", PriceUnit::frame_pixel},
    {PriceItem::dithered_clear, "dithered_clear", PriceUnit::frame_pixel},
    {PriceItem::accumulated, "accumulated", PriceUnit::frame_pixel},
    {PriceItem::returned, "returned", PriceUnit::frame_pixel},
    {PriceItem::resolved_4, "resolved_4", PriceUnit::frame_pixel},
    {PriceItem::resolved_8, "resolved_8", PriceUnit::frame_pixel},
    {PriceItem::vertex, "vertex", PriceUnit::vertex},
    {PriceItem::vertex_colors, "vertex_colors", PriceUnit::vertex},
    {PriceItem::vertex_lighting, "vertex_lighting", PriceUnit::vertex},
    {PriceItem::vertex_normalization, "vertex_normalization", PriceUnit::vertex},
    {PriceItem::vertex_directional_light, "vertex_directional_light", PriceUnit::vertex},
    {PriceItem::vertex_point_light, "vertex_point_light", PriceUnit::vertex},
    {PriceItem::vertex_attenuation, "vertex_attenuation", PriceUnit::vertex},
    {PriceItem::vertex_spot, "vertex_spot", PriceUnit::vertex},
    {PriceItem::vertex_highlight, "vertex_highlight", PriceUnit::vertex},
    {PriceItem::vertex_local_viewer, "vertex_local_viewer", PriceUnit::vertex},
    {PriceItem::vertex_second_side, "vertex_second_side", PriceUnit::vertex},
    {PriceItem::vertex_normals, "vertex_normals", PriceUnit::vertex},
    {PriceItem::generated_normal, "generated_normal", PriceUnit::vertex},
    {PriceItem::face_normal, "face_normal", PriceUnit::element},
    {PriceItem::triangle_outside, "triangle_outside", PriceUnit::element},
    {PriceItem::triangle_culled, "triangle_culled", PriceUnit::element},
    {PriceItem::triangle_clipped, "triangle_clipped", PriceUnit::element},
    {PriceItem::triangle_0, "triangle_0", PriceUnit::element},
    {PriceItem::triangle_1, "triangle_1", PriceUnit::element},
    {PriceItem::triangle_4, "triangle_4", PriceUnit::element},
    {PriceItem::triangle_16, "triangle_16", PriceUnit::element},
    {PriceItem::triangle_64, "triangle_64", PriceUnit::element},
    {PriceItem::triangle_256, "triangle_256", PriceUnit::element},
    {PriceItem::triangle_1024, "triangle_1024", PriceUnit::element},
    {PriceItem::triangle_4096, "triangle_4096", PriceUnit::element},
    {PriceItem::point, "point", PriceUnit::element},
    {PriceItem::line_16, "line_16", PriceUnit::element},
    {PriceItem::point_fragments, "point_fragments", PriceUnit::element},
    {PriceItem::line_16_fragments, "line_16_fragments", PriceUnit::element},
    {PriceItem::outlined_triangle, "outlined_triangle", PriceUnit::element},
    {PriceItem::outlined_pixel, "outlined_pixel", PriceUnit::covered_pixel},
    {PriceItem::texel_pixel, "texel_pixel", PriceUnit::covered_pixel},
    {PriceItem::depth_triangle, "depth_triangle", PriceUnit::element},
    {PriceItem::depth_unorm16_pixel, "depth_unorm16_pixel", PriceUnit::covered_pixel},
    {PriceItem::depth_unorm24_pixel, "depth_unorm24_pixel", PriceUnit::covered_pixel},
    {PriceItem::depth_unorm32_pixel, "depth_unorm32_pixel", PriceUnit::covered_pixel},
    {PriceItem::depth_float32_pixel, "depth_float32_pixel", PriceUnit::covered_pixel},
    {PriceItem::interpolated_triangle, "interpolated_triangle", PriceUnit::element},
    {PriceItem::interpolated_pixel, "interpolated_pixel", PriceUnit::covered_pixel},
    {PriceItem::samples_4_triangle, "samples_4_triangle", PriceUnit::element},
    {PriceItem::samples_4_pixel, "samples_4_pixel", PriceUnit::covered_pixel},
    {PriceItem::samples_8_triangle, "samples_8_triangle", PriceUnit::element},
    {PriceItem::samples_8_pixel, "samples_8_pixel", PriceUnit::covered_pixel},
    {PriceItem::source_alpha_blend_triangle, "source_alpha_blend_triangle", PriceUnit::element},
    {PriceItem::source_alpha_blend_pixel, "source_alpha_blend_pixel", PriceUnit::covered_pixel},
    {PriceItem::fragment_operations_triangle, "fragment_operations_triangle", PriceUnit::element},
    {PriceItem::fragment_operations_pixel, "fragment_operations_pixel", PriceUnit::covered_pixel},
    {PriceItem::fragment_passed, "fragment_passed", PriceUnit::shaded_pixel},
    {PriceItem::fragment_samples_4_triangle, "fragment_samples_4_triangle", PriceUnit::element},
    {PriceItem::fragment_samples_4_pixel, "fragment_samples_4_pixel", PriceUnit::covered_pixel},
    {PriceItem::fragment_samples_8_triangle, "fragment_samples_8_triangle", PriceUnit::element},
    {PriceItem::fragment_samples_8_pixel, "fragment_samples_8_pixel", PriceUnit::covered_pixel},
    {PriceItem::alpha_test, "alpha_test", PriceUnit::covered_pixel},
    {PriceItem::blending, "blending", PriceUnit::shaded_pixel},
    {PriceItem::stencil_test, "stencil_test", PriceUnit::covered_pixel},
    {PriceItem::logic_op, "logic_op", PriceUnit::shaded_pixel},
    {PriceItem::dither, "dither", PriceUnit::shaded_pixel},
    {PriceItem::write_masks, "write_masks", PriceUnit::shaded_pixel},
    {PriceItem::polygon_offset, "polygon_offset", PriceUnit::covered_pixel},
    {PriceItem::palette_search_16, "palette_search_16", PriceUnit::shaded_pixel},
    {PriceItem::palette_search_256, "palette_search_256", PriceUnit::shaded_pixel},
    {PriceItem::deferred_triangle, "deferred_triangle", PriceUnit::element},
    {PriceItem::deferred_pixel, "deferred_pixel", PriceUnit::shaded_pixel},
    {PriceItem::interpolated_deferred_pixel, "interpolated_deferred_pixel", PriceUnit::shaded_pixel},
    {PriceItem::shaded_pixel, "shaded_pixel", PriceUnit::shaded_pixel},
    {PriceItem::pixel_directional_light, "pixel_directional_light", PriceUnit::shaded_pixel},
    {PriceItem::pixel_point_light, "pixel_point_light", PriceUnit::shaded_pixel},
    {PriceItem::pixel_attenuation, "pixel_attenuation", PriceUnit::shaded_pixel},
    {PriceItem::pixel_spot, "pixel_spot", PriceUnit::shaded_pixel},
    {PriceItem::pixel_highlight, "pixel_highlight", PriceUnit::shaded_pixel},
    {PriceItem::pixel_local_viewer, "pixel_local_viewer", PriceUnit::shaded_pixel},
    {PriceItem::pixel_second_side, "pixel_second_side", PriceUnit::shaded_pixel},
    {PriceItem::texture_nearest, "texture_nearest", PriceUnit::shaded_pixel},
    {PriceItem::texture_linear, "texture_linear", PriceUnit::shaded_pixel},
    {PriceItem::texture_nearest_mipmap_nearest, "texture_nearest_mipmap_nearest", PriceUnit::shaded_pixel},
    {PriceItem::texture_linear_mipmap_nearest, "texture_linear_mipmap_nearest", PriceUnit::shaded_pixel},
    {PriceItem::texture_nearest_mipmap_linear, "texture_nearest_mipmap_linear", PriceUnit::shaded_pixel},
    {PriceItem::texture_linear_mipmap_linear, "texture_linear_mipmap_linear", PriceUnit::shaded_pixel},
    {PriceItem::diffused_pixel, "diffused_pixel", PriceUnit::frame_pixel},
    {PriceItem::diffused_index_pixel, "diffused_index_pixel", PriceUnit::frame_pixel},
};
static_assert(std::size(kItems) == kPriceItems);
constexpr bool are_in_order() {
  for (std::size_t i = 0; i < kPriceItems; ++i)
    if (static_cast<std::size_t>(kItems[i].item) != i) return false;
  return true;
}
static_assert(are_in_order());

constexpr std::string_view kUnits[] = {"frame",   "draw",          "pixel of the frame", "vertex",
                                       "element", "covered pixel", "shaded pixel"};

/// Triangles whose price is known, in ascending size.
struct SizedTriangle {
  double pixels;
  PriceItem item;
};
constexpr SizedTriangle kSizes[] = {{0, PriceItem::triangle_0},       {1, PriceItem::triangle_1},
                                    {4, PriceItem::triangle_4},       {16, PriceItem::triangle_16},
                                    {64, PriceItem::triangle_64},     {256, PriceItem::triangle_256},
                                    {1024, PriceItem::triangle_1024}, {4096, PriceItem::triangle_4096}};

}  // namespace

std::string_view code(PriceItem item) {
  const auto index = static_cast<std::size_t>(item);
  return index < kPriceItems ? kItems[index].code : std::string_view();
}

PriceUnit unit(PriceItem item) {
  return kItems[std::min(static_cast<std::size_t>(item), kPriceItems - 1)].unit;
}

std::string_view name(PriceUnit unit) {
  const auto index = static_cast<std::size_t>(unit);
  return index < std::size(kUnits) ? kUnits[index] : std::string_view();
}

bool is_triangle_size(PriceItem item) {
  return std::any_of(std::begin(kSizes), std::end(kSizes),
                     [&](const SizedTriangle& size) { return size.item == item; });
}

void add_triangles(WorkCounts& counts, double triangles, double covered_pixels) {
  if (!(triangles > 0)) return;
  const double size = covered_pixels / triangles;
  std::size_t larger = 1;
  while (larger + 1 < std::size(kSizes) && kSizes[larger].pixels < size) ++larger;
  const SizedTriangle &below = kSizes[larger - 1], &above = kSizes[larger];
  // Above the largest size, the line through the two largest continues.
  const double share = (size - below.pixels) / (above.pixels - below.pixels);
  counts[below.item] += (1 - share) * triangles;
  counts[above.item] += share * triangles;
}

double predicted_seconds(const WorkCounts& counts, const PriceList& prices, int threads) {
  if (threads < 1)
    throw Error(ErrorCode::invalid_argument,
                "predicted_seconds: threads: found " + std::to_string(threads) + ", expected at least 1");
  double serial = 0, parallel = 0;
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    const auto item = static_cast<PriceItem>(i);
    const bool is_diffusion = item == PriceItem::diffused_pixel || item == PriceItem::diffused_index_pixel;
    const bool is_serial = item == PriceItem::frame || item == PriceItem::draw || is_diffusion;
    (is_serial ? serial : parallel) += counts[item] * prices[item].nanoseconds;
  }
  return 1e-9 * std::max(serial + parallel / threads, 0.0);
}

}  // namespace tessera
