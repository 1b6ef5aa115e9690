// A frame, stage by stage: plan, vertices, bins, tiles, store.
#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include "engine/frame_commands.h"
#include "engine/image_target.h"
#include "engine/out_of_memory.h"
#include "engine/parallel.h"
#include "engine/recording.h"
#include "engine/tile_stage.h"
#include "raster/binning.h"
#include "shading/tile_renderer.h"

namespace tessera {
namespace {

constexpr std::size_t kVerticesPerTask = 512;
constexpr std::size_t kTrianglesPerBatch = 1024;

InstructionSet public_name(Isa isa) {
  return isa == Isa::avx512 ? InstructionSet::avx512 : isa == Isa::avx2 ? InstructionSet::avx2 : InstructionSet::scalar;
}
Isa internal_name(InstructionSet set) {
  return set == InstructionSet::avx512 ? Isa::avx512 : set == InstructionSet::avx2 ? Isa::avx2 : Isa::scalar;
}

/// Ranges of elements of several draws, cut into tasks.
struct Range {
  std::size_t draw, first, last;
};
std::vector<Range> cut_into_tasks(const std::vector<GeometryDraw>& draws, bool triangles) {
  std::vector<Range> tasks;
  for (std::size_t d = 0; d < draws.size(); ++d) {
    if (triangles && draws[d].plan->source != ColorSource::triangle_word) continue;
    const std::size_t count = triangles ? draws[d].mesh->triangles : draws[d].mesh->vertices;
    for (std::size_t first = 0; first < count; first += kVerticesPerTask) tasks.push_back({d, first, std::min(count, first + kVerticesPerTask)});
  }
  return tasks;
}

}  // namespace

struct RendererState {
  RendererOptions options;
  Isa isa = Isa::scalar;
  Parallel parallel;
  std::deque<DrawBuffers> draw_buffers;
  std::vector<Bins> bins;
  std::vector<TileWorkspace> workspaces;  // one for each worker

  explicit RendererState(const RendererOptions& o) : options(o), parallel(o.threads) {}

  FrameStats run(FrameRecording& recording, const ImageTarget* image);

 private:
  void process_geometry(FrameCommands& commands);
  std::size_t fill_bins(const FrameCommands& commands, const TileGrid& grid);
  void render_tiles(const TileStage& stage, FrameStats& stats);
  int tile_size_for(const FrameBufferFormat& format) const;
};

std::string_view version() { return TESSERA_VERSION; }

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const Isa isa : available_isas()) sets.push_back(public_name(isa));
  return sets;
}

std::string_view name(InstructionSet set) {
  switch (set) {
    case InstructionSet::automatic: return "automatic";
    case InstructionSet::scalar: return "scalar";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
  }
  return "";
}

Renderer::Renderer(RendererOptions options) {
  if (options.threads < 0 || options.threads > 1024) throw Error("Renderer: threads is " + std::to_string(options.threads) + ", must be 0 (all cores) to 1024");
  if (options.tile_size != 0 && options.tile_size != 32 && options.tile_size != 64 && options.tile_size != 128)
    throw Error("Renderer: tile_size is " + std::to_string(options.tile_size) + ", must be 0 (chosen), 32, 64 or 128");
  const std::vector<InstructionSet> sets = available_instruction_sets();
  if (options.instruction_set == InstructionSet::automatic) options.instruction_set = sets.front();
  if (std::find(sets.begin(), sets.end(), options.instruction_set) == sets.end()) {
    std::string known;
    for (const InstructionSet set : sets) known += (known.empty() ? "" : ", ") + std::string(name(set));
    throw Error("Renderer: the instruction set " + std::string(name(options.instruction_set)) + " is not in this build or machine, which have " + known);
  }
  if (options.threads == 0) options.threads = available_cores();
  state_ = with_memory("Renderer", [&] { return std::make_unique<RendererState>(options); });
  state_->options.threads = state_->parallel.threads();
  state_->isa = internal_name(options.instruction_set);
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
const RendererOptions& Renderer::options() const noexcept { return state_->options; }

namespace {

FrameStats finish_frame(RendererState& state, FrameRecording& recording, const ImageTarget* image) {
  return with_memory("Renderer::finish", [&] {
    const FrameStats stats = state.run(recording, image);
    recording.clear();
    return stats;
  });
}

}  // namespace

FrameStats Renderer::finish(Frame& frame) { return finish_frame(*state_, *frame.recording_, nullptr); }

FrameStats Renderer::finish(Frame& frame, const ImageTarget& target) {
  check_image_target(target, frame.recording_->target->format);
  return finish_frame(*state_, *frame.recording_, &target);
}

int RendererState::tile_size_for(const FrameBufferFormat& format) const {
  if (options.tile_size != 0) return options.tile_size;
  // Large tiles repeat less setup; small ones keep more threads busy.
  const double pixels = static_cast<double>(format.width) * format.height;
  return pixels / parallel.threads() >= 64 * 128 * 128 / 4 ? 128 : 64;
}

void RendererState::process_geometry(FrameCommands& commands) {
  for (const GeometryDraw& draw : commands.geometry) prepare_geometry(draw);
  const std::vector<Range> vertices = cut_into_tasks(commands.geometry, false);
  parallel.for_each(vertices.size(), [&](std::size_t i, int) { process_vertices(commands.geometry[vertices[i].draw], vertices[i].first, vertices[i].last, isa); });
  const std::vector<Range> triangles = cut_into_tasks(commands.geometry, true);
  parallel.for_each(triangles.size(), [&](std::size_t i, int) { process_triangles(commands.geometry[triangles[i].draw], triangles[i].first, triangles[i].last, isa); });
}

std::size_t RendererState::fill_bins(const FrameCommands& commands, const TileGrid& grid) {
  std::vector<std::size_t> first_triangle{0};  // of each draw, counted through the frame
  for (const GeometryDraw& draw : commands.geometry) first_triangle.push_back(first_triangle.back() + draw.mesh->triangles);
  const std::size_t total = first_triangle.back();
  const std::size_t batches = std::clamp<std::size_t>(total / kTrianglesPerBatch, 1, 4 * static_cast<std::size_t>(parallel.threads()));
  if (bins.size() < batches) bins.resize(batches);
  std::vector<BinDraw> draws;
  for (std::size_t d = 0; d < commands.geometry.size(); ++d) {
    const GeometryDraw& geometry = commands.geometry[d];
    const DrawPlan& plan = *geometry.plan;
    BinDraw draw;
    draw.draw = static_cast<std::uint32_t>(d);
    draw.vertices = geometry.buffers->vertices.data();
    draw.indices = geometry.indices();
    draw.codes = geometry.buffers->codes.data();
    draw.any_code = geometry.buffers->any_code;
    draw.keep_front = plan.keep_front;
    draw.keep_back = plan.keep_back;
    draw.front_is_clockwise = plan.front_is_clockwise;
    draw.rect = plan.rect;
    draw.transform = &plan.transform;
    draw.positions = geometry.mesh->positions;
    draw.components = geometry.mesh->components;
    draw.attributes = geometry.buffers->attributes.data();
    draw.attribute_count = draw.attribute_stride = plan.attribute_count;
    draws.push_back(draw);
  }
  parallel.for_each(batches, [&](std::size_t b, int) {
    bins[b].reset(grid.count());
    const std::size_t begin = total * b / batches, end = total * (b + 1) / batches;
    for (std::size_t d = 0; d < draws.size(); ++d) {
      const std::size_t low = std::max(begin, first_triangle[d]), high = std::min(end, first_triangle[d + 1]);
      if (low < high)
        bin_triangles(bins[b], grid, draws[d], static_cast<std::uint32_t>(low - first_triangle[d]), static_cast<std::uint32_t>(high - first_triangle[d]), isa);
    }
  });
  return batches;
}

void RendererState::render_tiles(const TileStage& stage, FrameStats& stats) {
  struct alignas(64) WorkerCounts {
    std::uint64_t shaded_pixels = 0, touched = 0;
  };
  std::vector<WorkerCounts> counts(static_cast<std::size_t>(parallel.threads()));
  while (workspaces.size() < counts.size()) workspaces.emplace_back();
  const std::vector<TileStrip> strips = stage.strips();
  parallel.for_each(strips.size(), [&](std::size_t i, int worker) {
    WorkerCounts& mine = counts[static_cast<std::size_t>(worker)];
    mine.touched += stage.render(strips[i], workspaces[static_cast<std::size_t>(worker)], mine.shaded_pixels);
  });
  for (const WorkerCounts& c : counts) {
    stats.shaded_pixels += c.shaded_pixels;
    stats.tiles_touched += c.touched;
  }
}

FrameStats RendererState::run(FrameRecording& recording, const ImageTarget* image) {
  const FloatingPointMode mode;
  FrameBufferState& target = *recording.target;
  FrameCommands commands = plan_frame(recording, image != nullptr, draw_buffers);

  const bool stencil_touched = std::any_of(recording.clears.begin(), recording.clears.end(), [](const RecordedClear& c) { return c.clear.stencil.has_value(); });
  const bool keep_stencil = recording.keep ? std::count(recording.keep->begin(), recording.keep->end(), Buffer::stencil) > 0 : !(image != nullptr && stencil_touched);

  // Memory for what will be stored is taken before anything changes.
  if (stencil_touched && keep_stencil) prepare_stencil_clears(recording);
  if (commands.color.store && !target.color.planes.allocated()) target.color.planes.allocate(target.color.word);
  if (commands.depth.store && !target.depth.planes.allocated()) target.depth.planes.allocate(target.depth.word);

  FrameStats stats;
  for (const GeometryDraw& draw : commands.geometry) stats.vertices += draw.mesh->vertices;
  const TileGrid grid{target.format.width, target.format.height, tile_size_for(target.format)};
  stats.tiles = static_cast<std::uint64_t>(grid.count());
  stats.tile_size = grid.tile_size;

  process_geometry(commands);
  const std::size_t batches = fill_bins(commands, grid);
  connect_draws(commands);

  TileFrame frame;
  frame.grid = grid;
  frame.layout = target.layout;
  frame.palette_search = target.layout.index && !commands.plans.empty() ? target.search() : nullptr;
  frame.depth_kind = target.depth_kind;
  frame.draws = commands.tile_draws.data();
  frame.draw_count = static_cast<std::uint32_t>(commands.tile_draws.size());
  frame.clears = commands.clears.data();
  frame.clear_count = static_cast<std::uint32_t>(commands.clears.size());
  frame.bins = bins.data();
  frame.bin_count = static_cast<std::uint32_t>(batches);
  frame.shade_at_once = !options.defer_shading;
  if (commands.color.store || commands.depth.store || image || !commands.plans.empty()) render_tiles(TileStage(commands, frame, target, image, isa), stats);

  const auto settle = [](const BufferTraffic& traffic, StoredBuffer& stored) {
    if (traffic.store)
      stored.content = StoredBuffer::Content::planes;
    else if (traffic.keep && traffic.ends_uniform)
      stored.become_uniform(traffic.uniform_word);
    else if (!traffic.keep && traffic.touched)
      stored.content = StoredBuffer::Content::lost;
  };
  settle(commands.color, target.color);
  settle(commands.depth, target.depth);
  if (stencil_touched) run_stencil_clears(recording, keep_stencil);

  for (std::size_t b = 0; b < batches; ++b) {
    const BinCounts& c = bins[b].counts;
    stats.triangles_in += c.triangles_in;
    stats.dropped_non_finite += c.non_finite;
    stats.outside += c.outside;
    stats.culled += c.culled;
    stats.zero_area += c.zero_area;
    stats.clipped += c.clipped;
    stats.binned += c.binned;
    stats.bin_entries += c.entries;
  }
  return stats;
}

}  // namespace tessera
