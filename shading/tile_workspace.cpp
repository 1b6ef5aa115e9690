#include "shading/tile_workspace.h"

namespace tessera::detail {

TileWorkspace::TileWorkspace() : memory_(std::make_unique<Memory>()) {
  // Rendering a tile allocates nothing.
  memory_->visible_triangles.reserve(kVisibleTriangleCapacity);
  memory_->edges64.reserve(kVisibleTriangleCapacity);
  allocate_colors(1);
}
TileWorkspace::~TileWorkspace() = default;
TileWorkspace::TileWorkspace(TileWorkspace&&) noexcept = default;
std::uint32_t* TileWorkspace::color() { return memory_->color; }
std::uint32_t* TileWorkspace::select_color(std::size_t tile) {
  return memory_->color = memory_->colors[tile].packed;
}
std::int32_t* TileWorkspace::depth() { return memory_->depth; }
std::int32_t* TileWorkspace::stencil() { return memory_->stencil->value; }
const std::uint32_t* TileWorkspace::sample_color(int sample) const { return memory_->samples->color[sample]; }
AccumulatedPixels TileWorkspace::accumulation() { return memory_->levels(); }
float* TileWorkspace::normals(int component) { return memory_->normals->component[component]; }
void TileWorkspace::allocate_colors(int tiles) {
  if (memory_->colors.size() >= static_cast<std::size_t>(tiles)) return;
  memory_->colors.resize(static_cast<std::size_t>(tiles));
  select_color(0);
}
void TileWorkspace::set_meter(DrawMeter* meter) { memory_->meter = meter; }
void TileWorkspace::allocate_normals() {
  if (!memory_->normals) memory_->normals = std::make_unique<TileNormals>();
}

void TileWorkspace::allocate_samples() {
  if (memory_->samples) return;
  memory_->samples = std::make_unique_for_overwrite<TileSamples>();
  memory_->samples->clean_samples = memory_->samples->clean_pixels = 0;
}

void TileWorkspace::allocate_stencil() {
  if (!memory_->stencil) memory_->stencil = std::make_unique<TileStencil>();
}
void TileWorkspace::allocate_stage_depth() {
  if (!memory_->stage_depth) memory_->stage_depth = std::make_unique<TileStageDepth>();
}
void TileWorkspace::allocate_accumulation() {
  if (!memory_->accumulation) memory_->accumulation = std::make_unique<TileLevels>();
}

}  // namespace tessera::detail
