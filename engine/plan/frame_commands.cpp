#include "engine/plan/frame_commands.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <string>

#include "engine/plan/fragment_plan.h"
#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kDrawsPerTask = 16;

PixelRect whole_buffer(const FrameBufferState& target) {
  return {0, 0, target.format.width, target.format.height};
}

PixelRect rect_of(const std::optional<Rect>& scissor, const FrameBufferState& target) {
  const PixelRect whole = whole_buffer(target);
  return scissor ? intersect(whole, raster_rect(*scissor, target.format.height)) : whole;
}

bool covers(const PixelRect& rect, const PixelRect& whole) {
  return rect.x0 <= whole.x0 && rect.y0 <= whole.y0 && rect.x1 >= whole.x1 && rect.y1 >= whole.y1;
}

bool keeps_buffer(const FrameRecording& recording, Buffer buffer, bool touched, bool presented) {
  return recording.has_keep_list ? recording.kept[static_cast<std::size_t>(buffer)] : touched && !presented;
}

void set_clear_color(TileClear& to, const Clear& clear, FrameBufferState& target) {
  if (clear.index) {
    to.packed_color = *clear.index;
    return;
  }
  const FragmentOps ops = dither_ops(target);
  const Color& c = *clear.color;
  to.packed_color = pack_color_or_index(target.layout, target.ensure_palette_search(), c.r, c.g, c.b, c.a);
  if (!ops.dither) return;
  for (std::size_t i = 0; i < to.pattern.size(); ++i) {
    const float t = ops.threshold[i / kDitherSize][i % kDitherSize], moved = (t - 0.5f) * ops.palette_spread;
    to.pattern[i] = target.layout.index ? target.ensure_palette_search()->nearest_unclamped(
                                              c.r + moved, c.g + moved, c.b + moved)
                                        : pack_color(target.layout, {c.r, c.g, c.b, c.a}, t);
    to.dithered |= to.pattern[i] != to.packed_color;
  }
}

// Calls one of the three for each command of a frame, in order.
template <class OnClear, class OnAccumulation, class OnDraw>
void for_each_command(const FrameCommands& commands, const OnClear& on_clear,
                      const OnAccumulation& on_accumulation, const OnDraw& on_draw) {
  std::size_t clear = 0, accumulation = 0;
  const auto clears_before = [&](std::size_t draw, std::size_t end) {
    for (; clear < end && commands.clears[clear].before_draw <= draw; ++clear)
      on_clear(commands.clears[clear]);
  };
  for (std::size_t draw = 0; draw <= commands.plans.size(); ++draw) {
    for (; accumulation < commands.accumulations.size() &&
           commands.accumulations[accumulation].before_draw <= draw;
         ++accumulation) {
      clears_before(draw, commands.accumulations[accumulation].after_clears);
      on_accumulation(commands.accumulations[accumulation]);
    }
    clears_before(draw, commands.clears.size());
    if (draw < commands.plans.size()) on_draw(*commands.plans[draw]);
  }
}

// What an accumulation does to a buffer.
enum class BufferAccess : std::uint8_t { none, read, modify, overwrite /* all of it, whatever was there */ };

BufferAccess color_access(const TileAccumulation& command, const PixelRect& whole) {
  const AccumOp op = command.arithmetic.op();
  if (op == AccumOp::accum || op == AccumOp::load) return BufferAccess::read;
  if (op != AccumOp::return_color) return BufferAccess::none;
  return command.write_mask == 0xffffffffu && covers(command.rect, whole) ? BufferAccess::overwrite
                                                                          : BufferAccess::modify;
}
BufferAccess accumulation_access(const TileAccumulation& command, const PixelRect& whole) {
  const AccumOp op = command.arithmetic.op();
  if (op == AccumOp::return_color) return BufferAccess::read;
  return op == AccumOp::load && covers(command.rect, whole) ? BufferAccess::overwrite : BufferAccess::modify;
}

// Decides what tiles load and store of one buffer. `clear_touches` and `words` look at a clear;
// `draw_touches` at a plan; `access_of` at an accumulation.
template <class ClearTouches, class DrawTouches, class AccessOf, class Words>
void plan_attachment_ops(AttachmentOps& attachment_ops, const FrameCommands& commands,
                         const Attachment& stored, const PixelRect& whole, const ClearTouches& clear_touches,
                         const DrawTouches& draw_touches, const AccessOf& access_of, const Words& words,
                         Buffer which) {
  bool any = false, starts_anew = false, clears_are_whole = true, is_used = false, is_changed = false;
  const TileClear* last_clear = nullptr;
  const auto begin = [&](bool anew) {
    if (!any) starts_anew = anew;
    any = true;
  };
  for_each_command(
      commands,
      [&](const TileClear& clear) {
        if (!clear_touches(clear)) return;
        begin(covers(clear.rect, whole));
        clears_are_whole &= covers(clear.rect, whole);
        last_clear = &clear;
      },
      [&](const TileAccumulation& command) {
        const BufferAccess access = access_of(command, whole);
        if (access == BufferAccess::none) return;
        begin(access == BufferAccess::overwrite);
        is_used = true;
        is_changed |= access != BufferAccess::read;
      },
      [&](const DrawPlan& plan) {
        if (!draw_touches(plan)) return;
        begin(false);
        is_used = is_changed = true;
      });
  attachment_ops.touched = last_clear != nullptr || is_changed;
  attachment_ops.used = is_used || (attachment_ops.keep && last_clear != nullptr) || attachment_ops.used;
  if (!attachment_ops.used) return;
  attachment_ops.load = !starts_anew;
  if (attachment_ops.load && stored.content == Attachment::Content::undefined)
    throw Error("Renderer::finish: the frame starts from the " + std::string(name(which)) +
                " buffer, which the frame before did not keep; clear the whole of it first, or name it in "
                "Frame::keep() then");
  // Clears alone need no planes.
  if (!is_changed && last_clear != nullptr && clears_are_whole &&
      !(which == Buffer::color && last_clear->dithered)) {
    attachment_ops.ends_fast_cleared = true;
    attachment_ops.clear_values = words(*last_clear);
  }
  attachment_ops.store = attachment_ops.keep && attachment_ops.touched && !attachment_ops.ends_fast_cleared;
}

// nullopt: it changes nothing.
std::optional<TileAccumulation> plan_accumulation(const Accum& accum, const FrameBufferState& target) {
  TileAccumulation command{
      .rect = rect_of(accum.scissor, target),
      .arithmetic = Accumulation(accum.op, accum.value, target.format.accumulation_bits, target.layout),
      .write_mask = write_mask(accum.color_mask, ~0u, target.layout),
      .dither = dither_ops(target)};
  if (command.rect.empty() || (accum.op == AccumOp::return_color && command.write_mask == 0))
    return std::nullopt;
  return command;
}

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
    if (plan.float_colors && plan.source == ColorSource::interpolated && !plan.flat && !plan.is_index[face])
      draw.alpha_attribute[face] = draw.color_attribute[face] + 3;
  }
}

/// The plan of each draw, and which of them can change something.
void plan_draws(FrameCommands& commands, FrameRecording& recording, WorkerPool& worker_pool) {
  const std::size_t draws = recording.draws.size();
  const auto plan_range = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      plan_draw(commands.plan_memory[i], recording.draws[i], *recording.target,
                !recording.capture.normals.empty(), nullptr);
  };
  if (commands.plan_memory.size() < draws) commands.plan_memory.resize(draws);
  if (draws <= kDrawsPerTask) {
    plan_range(0, draws);
  } else {
    worker_pool.for_each((draws + kDrawsPerTask - 1) / kDrawsPerTask, [&](std::size_t task, int) {
      plan_range(task * kDrawsPerTask, std::min(draws, (task + 1) * kDrawsPerTask));
    });
  }
  for (std::size_t i = 0; i < draws; ++i) {
    const DrawPlan& plan = commands.plan_memory[i];
    commands.first_plan_at.push_back(static_cast<std::uint32_t>(commands.plans.size()));
    if (plan.is_noop || (!plan.pixel_rectangle && recording.draws[i].mesh.elements == 0)) continue;
    commands.plans.push_back(&plan);
    commands.plan_draw.push_back(i);
  }
  commands.first_plan_at.push_back(static_cast<std::uint32_t>(commands.plans.size()));
}

}  // namespace

void FrameCommands::reset() {
  plans.clear();
  plan_draw.clear();
  first_tile_draw.clear();
  geometry.clear();
  tile_draws.clear();
  tile_draw_plan.clear();
  clears.clear();
  accumulations.clear();
  first_plan_at.clear();
  clears_until.clear();
  color = depth = stencil = accumulation = {};
}

void plan_frame(FrameCommands& commands, FrameRecording& recording, bool presented,
                std::deque<DrawBuffers>& buffers, WorkerPool& worker_pool) {
  FrameBufferState& target = *recording.target;
  const PixelRect whole = whole_buffer(target);
  commands.reset();
  plan_draws(commands, recording, worker_pool);
  for (const RecordedClear& recorded : recording.clears) {
    commands.clears_until.push_back(static_cast<std::uint32_t>(commands.clears.size()));
    const Clear& clear = recorded.clear;
    TileClear tile_clear;
    tile_clear.before_draw = commands.first_plan_at[recorded.before_draw];
    tile_clear.rect = rect_of(clear.scissor, target);
    tile_clear.color = clear.color || clear.index;
    tile_clear.depth = clear.depth.has_value();
    tile_clear.stencil = clear.stencil.has_value();
    tile_clear.accumulation = clear.accumulation.has_value();
    if (tile_clear.rect.empty() ||
        (!tile_clear.color && !tile_clear.depth && !tile_clear.stencil && !tile_clear.accumulation))
      continue;
    if (tile_clear.stencil) tile_clear.stencil_value = static_cast<std::int32_t>(*clear.stencil);
    if (tile_clear.color) set_clear_color(tile_clear, clear, target);
    if (tile_clear.depth)
      tile_clear.depth_key =
          depth_key_from_stored(target.depth_format, quantize_depth(target.depth_format, *clear.depth));
    if (tile_clear.accumulation) {
      const Color& c = *clear.accumulation;
      const int bits = target.format.accumulation_bits;
      tile_clear.accumulation_levels = {accumulation_level(c.r, bits), accumulation_level(c.g, bits),
                                        accumulation_level(c.b, bits), accumulation_level(c.a, bits)};
    }
    commands.clears.push_back(tile_clear);
  }
  commands.clears_until.push_back(static_cast<std::uint32_t>(commands.clears.size()));
  for (const RecordedAccum& recorded : recording.accumulations) {
    auto command = plan_accumulation(recorded.accum, target);
    if (!command) continue;
    command->before_draw = commands.first_plan_at[recorded.before_draw];
    command->after_clears = commands.clears_until[recorded.after_clears];
    commands.accumulations.push_back(*command);
  }

  const auto any_plan = [&](auto predicate) {
    return std::any_of(commands.plans.begin(), commands.plans.end(),
                       [&](const DrawPlan* plan) { return predicate(*plan); });
  };
  const auto any_clear = [&](auto predicate) {
    return std::any_of(commands.clears.begin(), commands.clears.end(), predicate);
  };
  const auto any_modifies = [&](auto access_of) {
    return std::any_of(
        commands.accumulations.begin(), commands.accumulations.end(),
        [&](const TileAccumulation& a) { return access_of(a, whole) >= BufferAccess::modify; });
  };
  const auto draws_color = [](const DrawPlan& plan) { return plan.write_mask != 0; };
  const auto draws_depth = [](const DrawPlan& plan) { return plan.uses_depth; };
  const auto draws_stencil = [](const DrawPlan& plan) { return plan.uses_stencil; };
  const auto draws_nothing = [](const DrawPlan&) { return false; };
  const auto clears_color = [](const TileClear& clear) { return clear.color; };
  const auto clears_depth = [](const TileClear& clear) { return clear.depth; };
  const auto clears_stencil = [](const TileClear& clear) { return clear.stencil; };
  const auto clears_accumulation = [](const TileClear& clear) { return clear.accumulation; };
  const auto no_access = [](const TileAccumulation&, const PixelRect&) { return BufferAccess::none; };
  using Words = std::array<std::uint32_t, 4>;
  commands.color.keep =
      keeps_buffer(recording, Buffer::color,
                   any_plan(draws_color) || any_clear(clears_color) || any_modifies(color_access), presented);
  commands.depth.keep =
      keeps_buffer(recording, Buffer::depth, any_plan(draws_depth) || any_clear(clears_depth), presented);
  commands.stencil.keep = keeps_buffer(recording, Buffer::stencil,
                                       any_plan(draws_stencil) || any_clear(clears_stencil), presented);
  commands.accumulation.keep =
      keeps_buffer(recording, Buffer::accumulation,
                   any_clear(clears_accumulation) || any_modifies(accumulation_access), presented);
  commands.color.used = presented;
  plan_attachment_ops(
      commands.color, commands, target.color, whole, clears_color, draws_color, color_access,
      [](const TileClear& c) { return Words{c.packed_color}; }, Buffer::color);
  plan_attachment_ops(
      commands.depth, commands, target.depth, whole, clears_depth, draws_depth, no_access,
      [&](const TileClear& c) { return Words{stored_depth_from_key(target.depth_format, c.depth_key)}; },
      Buffer::depth);
  plan_attachment_ops(
      commands.stencil, commands, target.stencil, whole, clears_stencil, draws_stencil, no_access,
      [](const TileClear& c) { return Words{static_cast<std::uint32_t>(c.stencil_value)}; }, Buffer::stencil);
  plan_attachment_ops(
      commands.accumulation, commands, target.accumulation[0], whole, clears_accumulation, draws_nothing,
      accumulation_access, [](const TileClear& c) { return std::bit_cast<Words>(c.accumulation_levels); },
      Buffer::accumulation);
  // Tiles have no memory for what is not used.
  for (TileClear& clear : commands.clears) {
    clear.stencil &= commands.stencil.used;
    clear.accumulation &= commands.accumulation.used;
  }

  // From here on draws are counted as the tiles do.
  std::uint32_t tile_draws = 0;
  for (const DrawPlan* plan : commands.plans) {
    commands.first_tile_draw.push_back(tile_draws);
    tile_draws += static_cast<std::uint32_t>(std::max<std::size_t>(styles_of(*plan).size(), 1));
  }
  commands.first_tile_draw.push_back(tile_draws);
  for (TileClear& clear : commands.clears) clear.before_draw = commands.first_tile_draw[clear.before_draw];
  for (TileAccumulation& accumulation : commands.accumulations)
    accumulation.before_draw = commands.first_tile_draw[accumulation.before_draw];

  while (buffers.size() < commands.plans.size()) buffers.emplace_back();
  for (std::size_t i = 0; i < commands.plans.size(); ++i) {
    const RecordedDraw& draw = recording.draws[commands.plan_draw[i]];
    GeometryDraw geometry;
    geometry.mesh = &draw.mesh;
    geometry.plan = commands.plans[i];
    geometry.buffers = &buffers[i];
    geometry.layout = &target.layout;
    geometry.palette_search = commands.plans[i]->uses_palette() ? target.ensure_palette_search() : nullptr;
    geometry.provoking_vertex = draw.state.provoking_vertex;
    commands.geometry.push_back(geometry);
  }
}

std::span<const PolygonMode> styles_of(const DrawPlan& plan) {
  static constexpr PolygonMode kInOrder[] = {PolygonMode::fill, PolygonMode::line, PolygonMode::point},
                               kBothEnds[] = {PolygonMode::fill, PolygonMode::point};
  if (!plan.outlines) return {};
  const auto [first, last] =
      std::minmax({static_cast<std::size_t>(plan.style[0]), static_cast<std::size_t>(plan.style[1])});
  if (last - first == 2) return kBothEnds;
  return {kInOrder + first, last - first + 1};
}

void build_tile_draws(FrameCommands& commands, const PixelPathFrame& frame) {
  for (const GeometryDraw& geometry : commands.geometry) {
    const DrawPlan& plan = *geometry.plan;
    DrawBuffers& buffers = *geometry.buffers;
    TileDraw draw;
    draw.topology = plan.topology;
    draw.element_corners = corners_of(plan.topology);
    draw.size = plan.topology == Topology::points ? plan.point_size : plan.line_width;
    draw.vertices = buffers.vertices.data();
    draw.indices = geometry.indices();
    draw.attributes = buffers.attributes.data();
    draw.attribute_stride = plan.attribute_count;
    draw.attribute_count = plan.texcoord_offset >= 0          ? plan.texcoord_offset
                           : plan.captured_normal_offset >= 0 ? plan.captured_normal_offset
                                                              : plan.attribute_count;
    draw.provoking = std::max(provoking_place(geometry.mesh->primitive, geometry.provoking_vertex), 0);
    draw.rect = plan.rect;
    draw.front_is_clockwise = plan.front_is_clockwise;
    draw.facing = geometry.facing();
    draw.depth_offsets = geometry.depth_offsets();
    draw.primitive_triangles = static_cast<std::uint32_t>(geometry.mesh->triangles_per_polygon());
    draw.uses_depth = plan.uses_depth;
    draw.depth_write = plan.depth_write;
    draw.depth_test = plan.depth_test;
    if (plan.pixel_rectangle) draw.texels = &*plan.pixel_rectangle;
    draw.depth_key = plan.depth_key;
    draw.source = plan.source;
    draw.write_mask = plan.write_mask;
    draw.deferred = plan.deferred;
    draw.scaled_colors = plan.scaled_colors;
    draw.packed_colors[0] = buffers.packed_colors[0].data();
    draw.packed_colors[1] = buffers.packed_colors[plan.two_sided ? 1 : 0].data();
    draw.color_attribute[1] = plan.two_sided ? plan.color_floats() : 0;
    std::copy_n(plan.is_index, 2, draw.index);
    draw.programs[0] = &plan.front;
    draw.programs[1] = plan.two_sided ? &plan.back : &plan.front;
    if (plan.source == ColorSource::constant)
      draw.packed_color =
          plan.is_index[0]
              ? quantize_index(*geometry.layout, plan.constant_index)
              : pack_color_or_index(*geometry.layout, geometry.palette_search, plan.constant_color[0],
                                    plan.constant_color[1], plan.constant_color[2]);
    if (plan.textures_per_pixel) {
      draw.texture = &plan.texture.texture;
      for (int face = 0; face < 2; ++face)
        draw.color[face] = {plan.constant_color[0], plan.constant_color[1], plan.constant_color[2],
                            plan.alpha[face]};
    }
    if (plan.has_ops) set_fragment_ops(draw, plan, buffers);
    if (plan.source == ColorSource::per_pixel) {
      // The order in which the vertex stage stores them.
      int next = 0;
      const auto add = [&](int field) {
        for (int c = 0; c < 3; ++c) draw.fields[next++] = static_cast<std::uint8_t>(field + c);
      };
      if (plan.front.needs_normal || (plan.two_sided && plan.back.needs_normal)) add(kNormalX);
      if (plan.front.needs_position || (plan.two_sided && plan.back.needs_position)) add(kPositionX);
      if (plan.uses_vertex_colors) add(kVertexR);
      if (plan.float_colors && plan.vertex_alpha) {
        draw.alpha_attribute[0] = draw.alpha_attribute[1] = next;
        --draw.attribute_count;  // it is no input of lighting
      }
    }
    const std::size_t plan_number = static_cast<std::size_t>(&geometry - commands.geometry.data());
    const auto add = [&] {
      draw.path = choose_pixel_path(frame, draw);
      commands.tile_draws.push_back(draw);
      commands.tile_draw_plan.push_back(plan_number);
    };
    const std::span<const PolygonMode> styles = styles_of(plan);
    if (styles.empty()) add();
    for (const PolygonMode style : styles) {
      if (style != PolygonMode::fill) {
        draw.topology = style == PolygonMode::line ? Topology::lines : Topology::points;
        draw.size = style == PolygonMode::line ? plan.line_width : plan.point_size;
      }
      add();
    }
  }
}

}  // namespace tessera::detail
