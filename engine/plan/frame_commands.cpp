#include "engine/plan/frame_commands.h"

#include <algorithm>
#include <optional>

#include "engine/plan/fragment_plan.h"
#include "engine/plan/tile_draws.h"
#include "shading/fragment_scalar.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kDrawsPerTask = 16;

PixelRect rect_of(const std::optional<Rect>& scissor, const FrameBufferState& target) {
  const PixelRect whole = whole_buffer(target);
  return scissor ? intersect(whole, raster_rect(*scissor, target.format.height)) : whole;
}

/// Packed colours of a colour by position, as in DitherPattern. The last ones are kept.
const std::vector<std::uint32_t>& dithered_pattern(const Color& c, FrameBufferState& target) {
  DitheredColor& kept = target.dithered_color;
  const std::array<float, 4> color{c.r, c.g, c.b, c.a};
  if (!kept.pattern.empty() && kept.color == color) return kept.pattern;
  const ColorDither& dither = *target.dither;
  const PaletteSearch* const search = target.ensure_palette_search();
  kept.pattern.clear();
  for (int y = 0; y < dither.pattern().size(); ++y)
    for (int x = 0; x < dither.pattern().columns(); ++x) {
      const float threshold = dither.pattern().at(x, y);
      kept.pattern.push_back(search != nullptr ? dithered_entry(dither, *search, c.r, c.g, c.b, threshold)
                                               : pack_color(target.layout, color, threshold, &dither));
    }
  kept.color = color;
  return kept.pattern;
}

/// Appends the pattern of a dithered clear, unless all of its colours are equal.
void set_dithered_color(TileClear& to, const Color& c, FrameBufferState& target,
                        std::vector<std::uint32_t>& patterns) {
  const std::vector<std::uint32_t>& pattern = dithered_pattern(c, target);
  to.packed_color = pattern.front();
  to.dithered = std::any_of(pattern.begin(), pattern.end(),
                            [&](std::uint32_t packed) { return packed != to.packed_color; });
  if (!to.dithered) return;
  to.first_of_pattern = static_cast<std::uint32_t>(patterns.size());
  patterns.insert(patterns.end(), pattern.begin(), pattern.end());
}

void set_clear_color(TileClear& to, const Clear& clear, FrameBufferState& target,
                     std::vector<std::uint32_t>& patterns) {
  const ColorLayout& layout = target.layout;
  if (clear.index) {
    to.packed_color = *clear.index | layout.index_flag();
    return;
  }
  const Color& c = *clear.color;
  if (target.dither) return set_dithered_color(to, c, target, patterns);
  to.packed_color = pack_color_or_index(layout, target.ensure_palette_search(), c.r, c.g, c.b, c.a);
}

/// Null if the accumulation changes nothing.
std::optional<TileAccumulation> plan_accumulation(const Accum& accum, const FrameBufferState& target) {
  TileAccumulation command{
      .rect = rect_of(accum.scissor, target),
      .arithmetic = Accumulation(accum.op, accum.value, target.format.accumulation_bits, target.layout),
      .write_mask = write_mask(accum.color_mask, ~0u, target.layout),
      .dither = target.dither.get()};
  if (command.rect.empty() || (accum.op == AccumOp::return_color && command.write_mask == 0))
    return std::nullopt;
  return command;
}

/// Captures show draws that change no colour, too.
bool has_captures(const Capture& capture) {
  return !capture.draw_ids.empty() || !capture.primitive_ids.empty() || !capture.normals.empty();
}

/// Plans each draw, and lists the plans of draws that can change a pixel.
void plan_draws(FrameCommands& commands, FrameRecording& recording, PlanOptions options,
                WorkerPool* worker_pool) {
  const std::size_t draws = recording.draws.size();
  options.capture_normals = !recording.capture.normals.empty();
  const auto plan_range = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      plan_draw(commands.plan_memory[i], recording.draws[i], *recording.target, options,
                EffectNotes(nullptr));
  };
  if (commands.plan_memory.size() < draws) commands.plan_memory.resize(draws);
  if (draws <= kDrawsPerTask || worker_pool == nullptr) {
    plan_range(0, draws);
  } else {
    worker_pool->for_each((draws + kDrawsPerTask - 1) / kDrawsPerTask, [&](std::size_t task, int) {
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

/// Null if the clear changes nothing.
std::optional<TileClear> plan_clear(const Clear& clear, FrameBufferState& target,
                                    std::vector<std::uint32_t>& patterns) {
  TileClear command;
  command.rect = rect_of(clear.scissor, target);
  command.color = clear.color || clear.index;
  command.depth = clear.depth.has_value();
  command.stencil = clear.stencil.has_value();
  command.accumulation = clear.accumulation.has_value();
  const bool any_buffer = command.color || command.depth || command.stencil || command.accumulation;
  if (command.rect.empty() || !any_buffer) return std::nullopt;
  if (command.stencil) command.stencil_value = static_cast<std::int32_t>(*clear.stencil);
  if (command.color) set_clear_color(command, clear, target, patterns);
  if (command.depth)
    command.depth_key =
        depth_key_from_stored(target.depth_format, quantize_depth(target.depth_format, *clear.depth));
  if (command.accumulation) {
    const Color& c = *clear.accumulation;
    const int bits = target.format.accumulation_bits;
    command.accumulation_levels = {accumulation_level(c.r, bits), accumulation_level(c.g, bits),
                                   accumulation_level(c.b, bits), accumulation_level(c.a, bits)};
  }
  return command;
}

void plan_clears(FrameCommands& commands, FrameRecording& recording) {
  for (std::size_t i = 0; i < recording.clears.size(); ++i) {
    const RecordedClear& recorded = recording.clears[i];
    commands.first_clear_at.push_back(static_cast<std::uint32_t>(commands.clears.size()));
    std::optional<TileClear> command = plan_clear(recorded.clear, *recording.target, commands.clear_patterns);
    if (!command) continue;
    command->before_draw = commands.first_plan_at[recorded.before_draw];
    commands.clears.push_back(*command);
    commands.clear_record.push_back(i);
  }
  commands.first_clear_at.push_back(static_cast<std::uint32_t>(commands.clears.size()));
}

void plan_accumulations(FrameCommands& commands, const FrameRecording& recording) {
  for (std::size_t i = 0; i < recording.accumulations.size(); ++i) {
    const RecordedAccum& recorded = recording.accumulations[i];
    std::optional<TileAccumulation> command = plan_accumulation(recorded.accum, *recording.target);
    if (!command) continue;
    command->before_draw = commands.first_plan_at[recorded.before_draw];
    command->after_clears = commands.first_clear_at[recorded.after_clears];
    commands.accumulations.push_back(*command);
    commands.accumulation_record.push_back(i);
  }
}

/// Removes the items for which `is_live(i)` is false. Afterwards new_index[i] is the number of items that
/// were kept before item i; one element past the last.
template <class Item, class IsLive>
void keep_live(std::vector<Item>& items, const IsLive& is_live, std::vector<std::uint32_t>* new_index) {
  std::size_t kept = 0;
  if (new_index != nullptr) new_index->clear();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (new_index != nullptr) new_index->push_back(static_cast<std::uint32_t>(kept));
    if (!is_live(i)) continue;
    if (kept != i) items[kept] = items[i];
    ++kept;
  }
  if (new_index != nullptr) new_index->push_back(static_cast<std::uint32_t>(kept));
  items.erase(items.begin() + static_cast<std::ptrdiff_t>(kept), items.end());
}

/// Removes draws that are left out, and commands whose result nothing reads. A clear keeps the buffers for
/// which it is read.
void drop_dead_commands(FrameCommands& commands, const FrameRecording& recording, bool presented) {
  BufferFlags read_at_end;
  for (const Buffer buffer : kBuffers)
    read_at_end[static_cast<std::size_t>(buffer)] = commands.attachments[buffer].stores();
  read_at_end[static_cast<std::size_t>(Buffer::color)] |= presented;
  find_live_commands(commands.live, recording, read_at_end);
  for (std::size_t i = 0; i < commands.plans.size(); ++i)
    if (commands.plans[i]->is_left_out) commands.live.draws[commands.plan_draw[i]] = 0;

  const auto is_live_plan = [&](std::size_t i) { return commands.live.draws[commands.plan_draw[i]] != 0; };
  keep_live(commands.plans, is_live_plan, &commands.first_plan_at);
  std::erase_if(commands.plan_draw, [&](std::size_t draw) { return commands.live.draws[draw] == 0; });
  for (std::size_t i = 0; i < commands.clears.size(); ++i) {
    TileClear& clear = commands.clears[i];
    const BufferFlags& is_read = commands.live.clears[commands.clear_record[i]];
    clear.color &= is_read[0];
    clear.depth &= is_read[1];
    clear.stencil &= is_read[2];
    clear.accumulation &= is_read[3];
    clear.before_draw = commands.first_plan_at[clear.before_draw];
  }
  keep_live(
      commands.clears,
      [&](std::size_t i) {
        const TileClear& clear = commands.clears[i];
        return clear.color || clear.depth || clear.stencil || clear.accumulation;
      },
      &commands.first_clear_at);
  for (TileAccumulation& accumulation : commands.accumulations) {
    accumulation.before_draw = commands.first_plan_at[accumulation.before_draw];
    accumulation.after_clears = commands.first_clear_at[accumulation.after_clears];
  }
  const auto is_live_accumulation = [&](std::size_t i) {
    return commands.live.accumulations[commands.accumulation_record[i]] != 0;
  };
  keep_live(commands.accumulations, is_live_accumulation, nullptr);
}

/// Renumbers `before_draw` from plans to tile draws.
void count_tile_draws(FrameCommands& commands) {
  std::uint32_t tile_draws = 0;
  for (const DrawPlan* plan : commands.plans) {
    commands.first_tile_draw.push_back(tile_draws);
    tile_draws += static_cast<std::uint32_t>(std::max<std::size_t>(polygon_modes_of(*plan).size(), 1));
  }
  commands.first_tile_draw.push_back(tile_draws);
  for (TileClear& clear : commands.clears) clear.before_draw = commands.first_tile_draw[clear.before_draw];
  for (TileAccumulation& accumulation : commands.accumulations)
    accumulation.before_draw = commands.first_tile_draw[accumulation.before_draw];
}

void plan_geometry(FrameCommands& commands, FrameRecording& recording, std::deque<DrawBuffers>& buffers) {
  FrameBufferState& target = *recording.target;
  while (buffers.size() < commands.plans.size()) buffers.emplace_back();
  for (std::size_t i = 0; i < commands.plans.size(); ++i) {
    const RecordedDraw& draw = recording.draws[commands.plan_draw[i]];
    commands.geometry.push_back(geometry_draw(draw, *commands.plans[i], target, buffers[i]));
  }
}

}  // namespace

GeometryDraw geometry_draw(const RecordedDraw& draw, const DrawPlan& plan, FrameBufferState& target,
                           DrawBuffers& buffers) {
  return {.mesh = &draw.mesh,
          .plan = &plan,
          .buffers = &buffers,
          .layout = &target.layout,
          .palette_search = plan.uses_palette() ? target.ensure_palette_search() : nullptr,
          .provoking_vertex = draw.state.provoking_vertex};
}

void FrameCommands::reset() {
  plans.clear();
  plan_draw.clear();
  first_tile_draw.clear();
  geometry.clear();
  tile_draws.clear();
  tile_draw_plan.clear();
  clears.clear();
  clear_patterns.clear();
  clear_record.clear();
  accumulations.clear();
  accumulation_record.clear();
  first_plan_at.clear();
  first_clear_at.clear();
  attachments = {};
}

void plan_frame(FrameCommands& commands, FrameRecording& recording, bool presented, PlanOptions options,
                std::deque<DrawBuffers>& buffers, WorkerPool* worker_pool) {
  commands.reset();
  options.elide &= !has_captures(recording.capture);
  plan_draws(commands, recording, options, worker_pool);
  plan_clears(commands, recording);
  plan_accumulations(commands, recording);
  commands.attachments = plan_attachments(commands, recording, presented);
  if (options.elide) drop_dead_commands(commands, recording, presented);
  // Tiles have no memory for attachments that are not used.
  for (TileClear& clear : commands.clears) {
    clear.stencil &= commands.attachments.stencil.used();
    clear.accumulation &= commands.attachments.accumulation.used();
  }
  count_tile_draws(commands);
  plan_geometry(commands, recording, buffers);
}

}  // namespace tessera::detail
