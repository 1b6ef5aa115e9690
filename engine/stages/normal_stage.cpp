#include "engine/stages/normal_stage.h"

#include <algorithm>
#include <cstddef>

namespace tessera::detail {
namespace {

constexpr std::size_t kMaxSmallMeshSize = 4096;  // vertices or elements

}  // namespace

void NormalStage::run(std::span<const GeometryDraw> draws, WorkerPool& worker_pool, FrameProgress& progress,
                      double done) {
  small_.clear();
  std::size_t max_vertices = 0;
  std::size_t max_elements = 0;
  for (const GeometryDraw& draw : draws) {
    if (!draw.needs_smooth_normals()) continue;
    const MeshArrays& mesh = *draw.mesh;
    float* const normals = draw.buffers->smooth_normals.resize(3 * mesh.vertices);
    if (std::max(mesh.vertices, mesh.elements) > kMaxSmallMeshSize) {
      if (generators_.empty()) generators_.emplace_back();
      generators_.front().normals.make(mesh, worker_pool, normals);
      continue;
    }
    small_.push_back(&draw);
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
    const GeometryDraw& draw = *small_[i];
    Generator& generator = generators_[static_cast<std::size_t>(worker)];
    progress.task(worker, [&] {
      generator.normals.make(*draw.mesh, generator.serial_pool, draw.buffers->smooth_normals.data());
    });
  });
}

}  // namespace tessera::detail
