#include "engine/stages/normal_stage.h"

#include <algorithm>
#include <cstddef>

namespace tessera::detail {
namespace {

constexpr std::size_t kMaxSmallMeshSize = 4096;  // vertices or elements

}  // namespace

void NormalStage::run(const FrameCommands& commands, WorkerPool& worker_pool, DrawMeasurer& draw_measurer,
                      FrameProgress& progress, double done) {
  small_.clear();
  std::size_t max_vertices = 0;
  std::size_t max_elements = 0;
  for (std::size_t d = 0; d < commands.geometry.size(); ++d) {
    const GeometryDraw& draw = commands.geometry[d];
    if (!draw.needs_smooth_normals()) continue;
    const MeshArrays& mesh = *draw.mesh;
    float* const normals = draw.buffers->smooth_normals.resize(3 * mesh.vertices);
    if (std::max(mesh.vertices, mesh.elements) > kMaxSmallMeshSize) {
      if (generators_.empty()) generators_.emplace_back();
      draw_measurer.run_on_all(commands.plan_draw[d], &DrawMeasurement::vertex_seconds,
                               [&] { generators_.front().normals.make(mesh, worker_pool, normals); });
      continue;
    }
    small_.push_back(d);
    if (mesh.topology() != Topology::triangles) continue;  // points and lines have normal 0 0 0
    max_vertices = std::max(max_vertices, mesh.vertices);
    max_elements = std::max(max_elements, mesh.elements);
  }
  if (small_.empty()) return;
  const std::size_t workers = worker_pool.workers_for(small_.size());
  while (generators_.size() < workers) generators_.emplace_back();
  // Any worker may get the largest mesh.
  for (std::size_t k = 0; k < workers; ++k) generators_[k].normals.reserve(max_vertices, max_elements);
  progress.begin_stage(FrameStage::vertices, done, small_.size());
  worker_pool.for_each(small_.size(), [&](std::size_t i, int worker) {
    const GeometryDraw& draw = commands.geometry[small_[i]];
    Generator& generator = generators_[static_cast<std::size_t>(worker)];
    progress.task(worker, [&] {
      draw_measurer.run(worker, commands.plan_draw[small_[i]], &DrawMeasurement::vertex_seconds, [&] {
        generator.normals.make(*draw.mesh, generator.serial_pool, draw.buffers->smooth_normals.data());
      });
    });
  });
}

}  // namespace tessera::detail
