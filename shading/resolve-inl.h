// MSAA resolve: a pixel's colour is the mean of its samples' stored levels. Twin: resolve_reference.h.
#if defined(TESSERA_SHADING_RESOLVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_RESOLVE_INL_H_
#undef TESSERA_SHADING_RESOLVE_INL_H_
#else
#define TESSERA_SHADING_RESOLVE_INL_H_
#endif

#include "shading/tile_context-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Bit fields of a packed colour.
struct PackedFields {
  int count = 0;
  int shift[4];
  int bits[4];

  explicit PackedFields(const ColorLayout& layout) {
    const auto add = [this](int field_shift, int field_bits) {
      if (field_bits == 0) return;
      shift[count] = field_shift;
      bits[count++] = field_bits;
    };
    add(layout.bits, layout.alpha_bits);
    add(layout.r_shift(), layout.luminance ? 0 : layout.r_bits);
    add(layout.g_shift(), layout.luminance ? 0 : layout.g_bits);
    add(0, layout.luminance ? layout.bits : layout.b_bits);
  }
};

/// Resolves the samples' colours into the colours of the tile.
inline HWY_NOINLINE void resolve_samples(TileContext& context) {
  const PackedFields fields(context.frame.layout);
  const int shift = context.samples == 8 ? 3 : 2;
  for (int i = 0; i < context.tile_size * context.tile_size; i += kLanes) {
    const auto packed = [&](int s) HWY_ATTR {
      return hn::Load(kInt, reinterpret_cast<const std::int32_t*>(context.sample[s].color) + i);
    };
    Int mean = packed(0);
    Int differing = hn::Zero(kInt);
    for (int s = 1; s < context.samples; ++s) differing = hn::Or(differing, hn::Xor(packed(s), mean));
    if (!hn::AllTrue(kInt, hn::Eq(differing, hn::Zero(kInt)))) {
      mean = hn::Zero(kInt);
      for (int f = 0; f < fields.count; ++f) {
        const Int mask = splat((1 << fields.bits[f]) - 1);
        Int sum = splat(context.samples / 2);
        for (int s = 0; s < context.samples; ++s) {
          const auto shifted = hn::ShiftRightSame(hn::BitCast(kUint, packed(s)), fields.shift[f]);
          sum = hn::Add(sum, hn::And(hn::BitCast(kInt, shifted), mask));
        }
        mean = hn::Or(mean, hn::ShiftLeftSame(hn::ShiftRightSame(sum, shift), fields.shift[f]));
      }
    }
    hn::Store(mean, kInt, reinterpret_cast<std::int32_t*>(context.color) + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
