#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/vertex_words.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "shading/vertex_words.h"
#include "shading/fragment_ops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

void vertex_words_lanes(const ColorLayout& layout, const ShadingBatch& batch, int count, std::uint32_t* words) {
  for (int first = 0; first < count; first += kLanes) {
    Colors colors{{splat(0.0f), splat(0.0f), splat(0.0f), splat(1.0f)}};
    for (int c = 0; c < 3; ++c) colors.c[c] = clamped_unit(hn::Load(kFloat, batch.field[kColorR + c] + first));
    alignas(64) std::int32_t lanes[kLanes];
    hn::Store(words_of(layout, colors, splat(0.5f)), kInt, lanes);
    std::copy_n(lanes, std::min(kLanes, count - first), reinterpret_cast<std::int32_t*>(words + first));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {
VertexWords* vertex_words(Isa isa) { return TESSERA_KERNEL(isa, vertex_words_lanes); }
}  // namespace tessera
#endif
