#include "shading/fragment_stage.h"

namespace tessera::detail {

void call_fragment_stage(const TileFragmentStage& tile_stage, FragmentBlock block, int count,
                         ShadingBatch& batch, StageArrays& arrays, StageFailure& failure) {
  if (failure.any()) return;
  const FragmentStage& stage = tile_stage.stage;
  block.count = static_cast<std::size_t>(count);
  if (stage.reads.position) {
    block.x = arrays.field[kStageX];
    block.y = arrays.field[kStageY];
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (stage.reads.eye) block.eye[c] = arrays.field[kStageEye + c];
    if (stage.reads.normal) block.normal[c] = arrays.field[kStageNormal + c];
    block.color[c] = batch.field[kColorR + c];
  }
  block.color[3] = arrays.field[kStageAlpha];
  for (std::size_t k = 0; k < static_cast<std::size_t>(stage.reads.extras); ++k)
    block.extras[k] = arrays.field[kStageExtras + k];
  if (stage.reads.depth || stage.writes_depth) block.depth = arrays.depth;
  if (stage.discards) {
    block.keep = arrays.keep;
    for (int i = 0; i < count; ++i) arrays.keep[i] = 1;
  }
  try {
    stage.run(block, stage.data);
  } catch (...) {
    failure.set(std::current_exception());
  }
}

}  // namespace tessera::detail
