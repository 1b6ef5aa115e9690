#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/vertex_colors.cpp"
#include "framebuffer/lanes.h"

#include <algorithm>

#include "shading/fragment_ops-inl.h"
#include "shading/vertex_colors.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

void pack_vertex_colors_lanes(const ColorLayout& layout, const ShadingBatch& batch, int count,
                              std::uint32_t* packed) {
  for (int first = 0; first < count; first += kLanes) {
    Colors colors{{splat(0.0f), splat(0.0f), splat(0.0f), splat(1.0f)}};
    for (int c = 0; c < 3; ++c)
      colors.c[c] = clamped_unit(hn::Load(kFloat, batch.field[kColorR + c] + first));
    alignas(64) std::int32_t lanes[kLanes];
    hn::Store(pack_colors(layout, colors, splat(0.5f)), kInt, lanes);
    std::copy_n(lanes, std::min(kLanes, count - first), reinterpret_cast<std::int32_t*>(packed + first));
  }
}

void scale_colors_lanes(const ColorLayout& layout, ShadingBatch& batch, int count) {
  constexpr float kMargin = 0x1p-12f;  // distance from whole numbers
  const int bits[3] = {layout.r_bits, layout.g_bits, layout.b_bits};
  for (int c = 0; c < 3; ++c) {
    const Float levels = splat(static_cast<float>((1 << bits[c]) - 1));
    for (int first = 0; first < count; first += kLanes) {
      float* const color = batch.field[kColorR + c] + first;
      const Float scaled = mul_add(hn::Load(kFloat, color), levels, splat(0.5f));
      const Float level = hn::ConvertTo(kFloat, truncate(scaled));
      const Float low = hn::Add(level, splat(kMargin));
      const Float high = hn::Add(level, splat(1 - kMargin));
      hn::Store(hn::Min(hn::Max(scaled, low), high), kFloat, color);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera::detail {
PackVertexColors* pack_vertex_colors(InstructionSet isa) {
  return TESSERA_KERNEL(isa, pack_vertex_colors_lanes);
}
ScaleColors* scale_colors(InstructionSet isa) { return TESSERA_KERNEL(isa, scale_colors_lanes); }
}  // namespace tessera::detail
#endif
