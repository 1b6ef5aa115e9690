#include "engine/frame_commands.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <string>

#include "engine/fragment_plan.h"
#include "shading/fragment_word.h"

namespace tessera {
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

bool wants(const FrameRecording& recording, Buffer buffer, bool touched, bool presented) {
  return recording.keeps_chosen ? recording.kept[static_cast<std::size_t>(buffer)] : touched && !presented;
}

void set_clear_color(TileClear& to, const Clear& clear, FrameBufferState& target) {
  if (clear.index) {
    to.color_word = *clear.index;
    return;
  }
  const FragmentOps ops = dither_of(target);
  const Color& c = *clear.color;
  to.color_word = color_word(target.layout, target.search(), c.r, c.g, c.b, c.a);
  if (!ops.dither) return;
  for (std::size_t i = 0; i < to.pattern.size(); ++i) {
    const float t = ops.threshold[i / kDitherSize][i % kDitherSize], moved = (t - 0.5f) * ops.palette_spread;
    to.pattern[i] = target.layout.index
                        ? target.search()->nearest_unclamped(c.r + moved, c.g + moved, c.b + moved)
                        : stored_word(target.layout, {c.r, c.g, c.b, c.a}, t);
    to.dithered |= to.pattern[i] != to.color_word;
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
enum class Work : std::uint8_t { none, reads, changes, replaces /* all of it, whatever was there */ };

Work work_on_color(const TileAccumulation& command, const PixelRect& whole) {
  const AccumulationOp op = command.arithmetic.op();
  if (op == AccumulationOp::accumulate || op == AccumulationOp::load) return Work::reads;
  if (op != AccumulationOp::give_back) return Work::none;
  return command.write_mask == 0xffffffffu && covers(command.rect, whole) ? Work::replaces : Work::changes;
}
Work work_on_accumulation(const TileAccumulation& command, const PixelRect& whole) {
  const AccumulationOp op = command.arithmetic.op();
  if (op == AccumulationOp::give_back) return Work::reads;
  return op == AccumulationOp::load && covers(command.rect, whole) ? Work::replaces : Work::changes;
}

// Decides what tiles load and store of one buffer. `clears_it` and `words` look at a clear; `draw_touches` at
// a plan; `work_of` at an accumulation.
template <class ClearsIt, class DrawTouches, class WorkOf, class Words>
void plan_traffic(BufferTraffic& traffic, const FrameCommands& commands, const StoredBuffer& stored,
                  const PixelRect& whole, const ClearsIt& clears_it, const DrawTouches& draw_touches,
                  const WorkOf& work_of, const Words& words, Buffer which) {
  bool any = false, starts_anew = false, clears_are_whole = true, is_used = false, is_changed = false;
  const TileClear* last_clear = nullptr;
  const auto begin = [&](bool anew) {
    if (!any) starts_anew = anew;
    any = true;
  };
  for_each_command(
      commands,
      [&](const TileClear& clear) {
        if (!clears_it(clear)) return;
        begin(covers(clear.rect, whole));
        clears_are_whole &= covers(clear.rect, whole);
        last_clear = &clear;
      },
      [&](const TileAccumulation& command) {
        const Work work = work_of(command, whole);
        if (work == Work::none) return;
        begin(work == Work::replaces);
        is_used = true;
        is_changed |= work != Work::reads;
      },
      [&](const DrawPlan& plan) {
        if (!draw_touches(plan)) return;
        begin(false);
        is_used = is_changed = true;
      });
  traffic.touched = last_clear != nullptr || is_changed;
  traffic.used = is_used || (traffic.keep && last_clear != nullptr) || traffic.used;
  if (!traffic.used) return;
  traffic.load = !starts_anew;
  if (traffic.load && stored.content == StoredBuffer::Content::lost)
    throw Error("Renderer::finish: the frame starts from the " + std::string(name(which)) +
                " buffer, which the frame before did not keep; clear the whole of it first, or name it in "
                "Frame::keep() then");
  // Clears alone need no planes.
  if (!is_changed && last_clear != nullptr && clears_are_whole &&
      !(which == Buffer::color && last_clear->dithered)) {
    traffic.ends_uniform = true;
    traffic.uniform_words = words(*last_clear);
  }
  traffic.store = traffic.keep && traffic.touched && !traffic.ends_uniform;
}

// nullopt: it changes nothing.
std::optional<TileAccumulation> plan_accumulation(const Accum& accum, const FrameBufferState& target) {
  static_assert(static_cast<int>(AccumOp::accum) == static_cast<int>(AccumulationOp::accumulate) &&
                static_cast<int>(AccumOp::return_) == static_cast<int>(AccumulationOp::give_back));
  TileAccumulation command{.rect = rect_of(accum.scissor, target),
                           .arithmetic = Accumulation(static_cast<AccumulationOp>(accum.op), accum.value,
                                                      target.format.accumulation_bits, target.layout),
                           .write_mask = write_mask(accum.color_mask, ~0u, target.layout),
                           .dither = dither_of(target)};
  if (command.rect.empty() || (accum.op == AccumOp::return_ && command.write_mask == 0)) return std::nullopt;
  return command;
}

void connect_operations(TileDraw& draw, const DrawPlan& plan, DrawBuffers& buffers) {
  draw.ops = &plan.ops;
  draw.plain_colors = !plan.float_colors;
  draw.offset_factor = plan.offset_factor;
  draw.offset_units = plan.offset_units;
  draw.flat = plan.flat;
  for (int face = 0; face < 2; ++face) {
    const int side = plan.two_sided ? face : 0;
    if (plan.flat && plan.colors_triangles()) draw.face_colors[face] = buffers.face_colors[side].data();
    for (std::size_t c = 0; c < 3; ++c) draw.color[face][c] = plan.constant_color[c];
    if (plan.index[face]) draw.color[face][0] = plan.constant_index;
    draw.color[face][3] = draw.alpha[face] = plan.alpha[face];
    if (plan.float_colors && plan.source == ColorSource::interpolated && !plan.flat && !plan.index[face])
      draw.alpha_attribute[face] = draw.color_attribute[face] + 3;
  }
}

/// The plan of each draw, and which of them can change something.
void plan_draws(FrameCommands& commands, FrameRecording& recording, Parallel& parallel) {
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
    parallel.for_each((draws + kDrawsPerTask - 1) / kDrawsPerTask, [&](std::size_t task, int) {
      plan_range(task * kDrawsPerTask, std::min(draws, (task + 1) * kDrawsPerTask));
    });
  }
  for (std::size_t i = 0; i < draws; ++i) {
    const DrawPlan& plan = commands.plan_memory[i];
    commands.first_plan_at.push_back(static_cast<std::uint32_t>(commands.plans.size()));
    if (plan.invisible || (!plan.texels && recording.draws[i].mesh.elements == 0)) continue;
    commands.plans.push_back(&plan);
    commands.plan_draw.push_back(i);
  }
  commands.first_plan_at.push_back(static_cast<std::uint32_t>(commands.plans.size()));
}

}  // namespace

void FrameCommands::start_anew() {
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
                std::deque<DrawBuffers>& buffers, Parallel& parallel) {
  FrameBufferState& target = *recording.target;
  const PixelRect whole = whole_buffer(target);
  commands.start_anew();
  plan_draws(commands, recording, parallel);
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
          depth_key_from_word(target.depth_kind, depth_word(target.depth_kind, *clear.depth));
    if (tile_clear.accumulation) {
      const Color& c = *clear.accumulation;
      const int bits = target.format.accumulation_bits;
      tile_clear.accumulation_levels = {accumulation_level(c.r, bits), accumulation_level(c.g, bits),
                                        accumulation_level(c.b, bits), accumulation_level(c.a, bits)};
    }
    commands.clears.push_back(tile_clear);
  }
  commands.clears_until.push_back(static_cast<std::uint32_t>(commands.clears.size()));
  for (const RecordedAccum& recorded : recording.accums) {
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
  const auto any_work = [&](auto work_of) {
    return std::any_of(commands.accumulations.begin(), commands.accumulations.end(),
                       [&](const TileAccumulation& a) { return work_of(a, whole) >= Work::changes; });
  };
  const auto draws_color = [](const DrawPlan& plan) { return plan.write_mask != 0; };
  const auto draws_depth = [](const DrawPlan& plan) { return plan.uses_depth; };
  const auto draws_stencil = [](const DrawPlan& plan) { return plan.uses_stencil; };
  const auto draws_nothing = [](const DrawPlan&) { return false; };
  const auto clears_color = [](const TileClear& clear) { return clear.color; };
  const auto clears_depth = [](const TileClear& clear) { return clear.depth; };
  const auto clears_stencil = [](const TileClear& clear) { return clear.stencil; };
  const auto clears_accumulation = [](const TileClear& clear) { return clear.accumulation; };
  const auto no_work = [](const TileAccumulation&, const PixelRect&) { return Work::none; };
  using Words = std::array<std::uint32_t, 4>;
  commands.color.keep =
      wants(recording, Buffer::color,
            any_plan(draws_color) || any_clear(clears_color) || any_work(work_on_color), presented);
  commands.depth.keep =
      wants(recording, Buffer::depth, any_plan(draws_depth) || any_clear(clears_depth), presented);
  commands.stencil.keep =
      wants(recording, Buffer::stencil, any_plan(draws_stencil) || any_clear(clears_stencil), presented);
  commands.accumulation.keep =
      wants(recording, Buffer::accumulation, any_clear(clears_accumulation) || any_work(work_on_accumulation),
            presented);
  commands.color.used = presented;
  plan_traffic(
      commands.color, commands, target.color, whole, clears_color, draws_color, work_on_color,
      [](const TileClear& c) { return Words{c.color_word}; }, Buffer::color);
  plan_traffic(
      commands.depth, commands, target.depth, whole, clears_depth, draws_depth, no_work,
      [&](const TileClear& c) { return Words{depth_word_from_key(target.depth_kind, c.depth_key)}; },
      Buffer::depth);
  plan_traffic(
      commands.stencil, commands, target.stencil, whole, clears_stencil, draws_stencil, no_work,
      [](const TileClear& c) { return Words{static_cast<std::uint32_t>(c.stencil_value)}; }, Buffer::stencil);
  plan_traffic(
      commands.accumulation, commands, target.accumulation[0], whole, clears_accumulation, draws_nothing,
      work_on_accumulation, [](const TileClear& c) { return std::bit_cast<Words>(c.accumulation_levels); },
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
    geometry.search = commands.plans[i]->looks_up_colors() ? target.search() : nullptr;
    geometry.provoking_vertex = draw.state.provoking_vertex;
    commands.geometry.push_back(geometry);
  }
}

std::span<const PolygonStyle> styles_of(const DrawPlan& plan) {
  static constexpr PolygonStyle kInOrder[] = {PolygonStyle::fill, PolygonStyle::line, PolygonStyle::point},
                                kBothEnds[] = {PolygonStyle::fill, PolygonStyle::point};
  if (!plan.outlines) return {};
  const auto [first, last] =
      std::minmax({static_cast<std::size_t>(plan.style[0]), static_cast<std::size_t>(plan.style[1])});
  if (last - first == 2) return kBothEnds;
  return {kInOrder + first, last - first + 1};
}

void connect_draws(FrameCommands& commands) {
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
    draw.attribute_count = plan.texcoords >= 0         ? plan.texcoords
                           : plan.captured_normal >= 0 ? plan.captured_normal
                                                       : plan.attribute_count;
    draw.provoking = std::max(provoking_place(geometry.mesh->primitive, geometry.provoking_vertex), 0);
    draw.rect = plan.rect;
    draw.front_is_clockwise = plan.front_is_clockwise;
    draw.facing = geometry.facing();
    draw.depth_offsets = geometry.depth_offsets();
    draw.primitive_triangles = static_cast<std::uint32_t>(geometry.mesh->polygon_triangles());
    draw.uses_depth = plan.uses_depth;
    draw.depth_write = plan.depth_write;
    draw.depth_test = plan.depth_test;
    if (plan.texels) draw.texels = &*plan.texels;
    draw.depth_key = plan.depth_key;
    draw.source = plan.source;
    draw.write_mask = plan.write_mask;
    draw.deferred = plan.deferred;
    draw.scaled_colors = plan.scaled_colors;
    draw.words[0] = buffers.words[0].data();
    draw.words[1] = buffers.words[plan.two_sided ? 1 : 0].data();
    draw.color_attribute[1] = plan.two_sided ? plan.color_floats() : 0;
    std::copy_n(plan.index, 2, draw.index);
    draw.programs[0] = &plan.front;
    draw.programs[1] = plan.two_sided ? &plan.back : &plan.front;
    if (plan.source == ColorSource::constant)
      draw.word = plan.index[0] ? index_word(*geometry.layout, plan.constant_index)
                                : color_word(*geometry.layout, geometry.search, plan.constant_color[0],
                                             plan.constant_color[1], plan.constant_color[2]);
    if (plan.textures_pixels) {
      draw.texture = &plan.texture.texture;
      for (int face = 0; face < 2; ++face)
        draw.color[face] = {plan.constant_color[0], plan.constant_color[1], plan.constant_color[2],
                            plan.alpha[face]};
    }
    if (plan.has_ops) connect_operations(draw, plan, buffers);
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
      commands.tile_draws.push_back(draw);
      commands.tile_draw_plan.push_back(plan_number);
    };
    const std::span<const PolygonStyle> styles = styles_of(plan);
    if (styles.empty()) add();
    for (const PolygonStyle style : styles) {
      if (style != PolygonStyle::fill) {
        draw.topology = style == PolygonStyle::line ? Topology::lines : Topology::points;
        draw.size = style == PolygonStyle::line ? plan.line_width : plan.point_size;
      }
      add();
    }
  }
}

}  // namespace tessera
