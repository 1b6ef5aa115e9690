// The geometry stage: assembly of elements, generated normals, vertices, colours of whole triangles.
#include "engine/runtime/renderer_state.h"
#include "engine/stages/frame_context.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kVerticesPerTask = 512;
constexpr std::size_t kElementsPerTask = 4096;

}  // namespace

template <class Count, class Work>
void RendererState::run_ranges(FrameContext& frame, const GeometryPass& pass, const Count& count,
                               const Work& work) {
  ranges.split(
      commands.geometry.size(), [&](std::size_t d) { return count(commands.geometry[d]); }, pass.range_size);
  frame.progress.begin_stage(pass.stage, pass.done, ranges.size());
  worker_pool.for_each(ranges.size(), [&](std::size_t i, int worker) {
    const DrawRange range = ranges[i];
    frame.progress.task(worker, [&] {
      draw_measurer.run(worker, commands.plan_draw[range.draw], &DrawMeasurement::vertex_seconds,
                        [&] { work(commands.geometry[range.draw], range.first, range.last); });
    });
    if (pass.is_of_vertices)
      draw_measurer.count_vertices(worker, commands.plan_draw[range.draw], range.first, range.last);
  });
}

void RendererState::run_geometry(FrameContext& frame) {
  for (const GeometryDraw& draw : commands.geometry) prepare_geometry(draw);
  run_ranges(
      frame, {FrameStage::vertices, kElementsDone, kElementsPerTask},
      [](const GeometryDraw& draw) { return draw.assembles() ? draw.mesh->elements : 0; },
      [](const GeometryDraw& draw, std::size_t first, std::size_t last) {
        assemble_elements(draw, first, last);
      });
  normal_stage.run(commands, worker_pool, draw_measurer, frame.progress, kNormalsDone);
  run_ranges(
      frame, {FrameStage::vertices, kVerticesDone, kVerticesPerTask, true},
      [](const GeometryDraw& draw) { return draw.mesh->vertices; },
      [this](const GeometryDraw& draw, std::size_t first, std::size_t last) {
        process_vertices(draw, first, last, isa);
      });
  run_ranges(
      frame, {FrameStage::flat_colors, kFlatColorsDone, kVerticesPerTask},
      [](const GeometryDraw& draw) { return draw.plan->has_per_triangle_colors() ? draw.mesh->elements : 0; },
      [this](const GeometryDraw& draw, std::size_t first, std::size_t last) {
        compute_flat_colors(draw, first, last, isa);
      });
  frame.stats.vertex_seconds = frame.clock.lap();
}

}  // namespace tessera::detail
