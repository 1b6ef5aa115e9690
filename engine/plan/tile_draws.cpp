#include "engine/plan/tile_draws.h"

#include <algorithm>

#include "engine/plan/frame_commands.h"

namespace tessera::detail {
namespace {

void set_fragment_ops(TileDraw& draw, const DrawPlan& plan, DrawBuffers& buffers) {
  draw.ops = &plan.ops;
  draw.plain_colors = !plan.float_colors;
  draw.offset_factor = plan.offset_factor;
  draw.offset_units = plan.offset_units;
  draw.flat = plan.flat;
  for (int face = 0; face < 2; ++face) {
    const int side = plan.two_sided ? face : 0;
    if (plan.flat && plan.has_per_triangle_colors())
      draw.face_colors[face] = buffers.face_colors[side].data();
    for (std::size_t c = 0; c < 3; ++c) draw.color[face][c] = plan.constant_color[c];
    if (plan.is_index[face]) draw.color[face][0] = plan.constant_index;
    draw.color[face][3] = draw.alpha[face] = plan.alpha[face];
  }
}

void set_varyings(TileDraw& draw, const DrawPlan& plan) {
  const VaryingLayout& layout = plan.varyings;
  draw.attribute_stride = layout.count;
  draw.attribute_count = layout.shading_count;
  const auto map = [&](int offset, int field) {
    if (offset < 0) return;
    for (int c = 0; c < 3; ++c) draw.fields[offset + c] = static_cast<std::uint8_t>(field + c);
  };
  const bool lit_per_pixel = plan.source == ColorSource::per_pixel;
  const bool alpha_varies = plan.vertex_alpha || plan.folds_texture();
  if (lit_per_pixel) {
    map(layout.normal, kNormalX);
    map(layout.position, kPositionX);
    map(layout.color[0], kVertexR);
  }
  for (int face = 0; face < 2; ++face) {
    if (!lit_per_pixel && layout.color[face] >= 0) draw.color_attribute[face] = layout.color[face];
    if (!plan.flat && alpha_varies) draw.alpha_attribute[face] = layout.alpha[face];
  }
}

}  // namespace

std::span<const PolygonMode> polygon_modes_of(const DrawPlan& plan) {
  static constexpr PolygonMode kAll[] = {PolygonMode::fill, PolygonMode::line, PolygonMode::point};
  static constexpr PolygonMode kFillAndPoint[] = {PolygonMode::fill, PolygonMode::point};
  if (!plan.outlines) return {};
  const auto [first, last] =
      std::minmax({static_cast<std::size_t>(plan.mode[0]), static_cast<std::size_t>(plan.mode[1])});
  if (last - first == 2) return kFillAndPoint;
  return {kAll + first, last - first + 1};
}

namespace {

std::uint32_t constant_packed_color(const GeometryDraw& geometry) {
  const DrawPlan& plan = *geometry.plan;
  if (plan.is_index[0]) return quantize_index(*geometry.layout, plan.constant_index);
  return pack_color_or_index(*geometry.layout, geometry.palette_search, plan.constant_color[0],
                             plan.constant_color[1], plan.constant_color[2]);
}

TileDraw tile_draw(const GeometryDraw& geometry) {
  const DrawPlan& plan = *geometry.plan;
  DrawBuffers& buffers = *geometry.buffers;
  TileDraw draw;
  draw.topology = plan.topology;
  draw.element_corners = corners_of(plan.topology);
  draw.size = plan.topology == Topology::points ? plan.point_size : plan.line_width;
  draw.vertices = buffers.vertices.data();
  draw.indices = geometry.indices();
  draw.attributes = buffers.attributes.data();
  draw.provoking = std::max(provoking_place(geometry.mesh->primitive, geometry.provoking_vertex), 0);
  draw.rect = plan.rect;
  draw.front_is_clockwise = plan.front_is_clockwise;
  draw.facing = geometry.facing();
  draw.depth_offsets = geometry.depth_offsets();
  draw.primitive_triangles = static_cast<std::uint32_t>(geometry.mesh->triangles_per_polygon());
  draw.uses_depth = plan.uses_depth;
  draw.depth_write = plan.depth_write;
  draw.depth_test = plan.depth_test;
  draw.skips_hidden = plan.skips_hidden;
  if (plan.pixel_rectangle) draw.texels = &*plan.pixel_rectangle;
  draw.depth_key = plan.depth_key;
  draw.source = plan.source;
  draw.affine = plan.affine;
  draw.cell_size = plan.cell_size;
  draw.write_mask = plan.write_mask;
  draw.deferred = plan.deferred;
  draw.scaled_colors = plan.scaled_colors;
  draw.packed_colors[0] = buffers.packed_colors[0].data();
  draw.packed_colors[1] = buffers.packed_colors[plan.two_sided ? 1 : 0].data();
  std::copy_n(plan.is_index, 2, draw.index);
  draw.programs[0] = &plan.front;
  draw.programs[1] = plan.two_sided ? &plan.back : &plan.front;
  if (plan.source == ColorSource::constant) draw.packed_color = constant_packed_color(geometry);
  if (plan.textures_per_pixel) {
    draw.texture = &plan.texture.texture;
    for (int face = 0; face < 2; ++face)
      draw.color[face] = {plan.constant_color[0], plan.constant_color[1], plan.constant_color[2],
                          plan.alpha[face]};
  }
  if (plan.has_ops) set_fragment_ops(draw, plan, buffers);
  if (plan.fragment_stage) draw.stage = &*plan.fragment_stage;
  // Visible pixels are found as without a stage.
  const bool stores_depths = plan.fragment_stage && plan.fragment_stage->stage.reads.depth;
  if (plan.has_only_stage && plan.deferred && !stores_depths) draw.ops = nullptr;
  if (plan.defers_dither) draw.dither = plan.ops.dither;
  set_varyings(draw, plan);
  return draw;
}

/// Calls add(draw) for each tile draw of a plan, its code path included.
template <class Add>
void for_each_tile_draw(const GeometryDraw& geometry, const PixelPathFrame& frame, const Add& add) {
  const DrawPlan& plan = *geometry.plan;
  TileDraw draw = tile_draw(geometry);
  const auto add_with_path = [&] {
    draw.path = choose_pixel_path(frame, draw);
    add(draw);
  };
  const std::span<const PolygonMode> modes = polygon_modes_of(plan);
  if (modes.empty()) add_with_path();
  for (const PolygonMode mode : modes) {
    if (mode != PolygonMode::fill) {
      draw.topology = mode == PolygonMode::line ? Topology::lines : Topology::points;
      draw.size = mode == PolygonMode::line ? plan.line_width : plan.point_size;
      draw.cell_size = 0;
    }
    add_with_path();
  }
}

}  // namespace

void build_tile_draws(FrameCommands& commands, const PixelPathFrame& frame) {
  for (std::size_t plan = 0; plan < commands.geometry.size(); ++plan)
    for_each_tile_draw(commands.geometry[plan], frame, [&](const TileDraw& draw) {
      commands.tile_draws.push_back(draw);
      commands.tile_draws.back().recorded_draw = static_cast<std::uint32_t>(commands.plan_draw[plan]);
      commands.tile_draw_plan.push_back(plan);
    });
}

std::vector<PixelPath> pixel_paths_of(const RecordedDraw& draw, const DrawPlan& plan,
                                      FrameBufferState& target) {
  std::vector<PixelPath> paths;
  if (plan.is_noop || plan.is_left_out) return paths;
  DrawBuffers buffers;
  const PixelPathFrame frame{.layout = target.layout,
                             .depth_format = target.depth_format,
                             .samples = target.format.samples,
                             .isa = available_isas().front()};
  for_each_tile_draw(geometry_draw(draw, plan, target, buffers), frame,
                     [&](const TileDraw& tile_draw) { paths.push_back(tile_draw.path); });
  return paths;
}

}  // namespace tessera::detail
