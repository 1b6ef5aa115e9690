// Looks up one element per lane in an array with one element per triangle of a group.
#if defined(TESSERA_SHADING_PICK_BY_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_SHADING_PICK_BY_TRIANGLE_INL_H_
#undef TESSERA_SHADING_PICK_BY_TRIANGLE_INL_H_
#else
#define TESSERA_SHADING_PICK_BY_TRIANGLE_INL_H_
#endif

#include "raster/lanes-inl.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace tessera::detail {
namespace HWY_NAMESPACE {

/// Holds the triangles of the lanes; calls return array[triangle] of each.
struct PickByTriangle {
#if HWY_TARGET == HWY_SCALAR
  Int triangle;
  HWY_INLINE explicit PickByTriangle(Int of) : triangle(of) {}
  HWY_INLINE Int operator()(const std::int32_t* array) const { return Int(array[triangle.raw]); }
  HWY_INLINE Float operator()(const float* array) const { return Float(array[triangle.raw]); }
#else
  using Indices = decltype(hn::IndicesFromVec(kInt, Int()));
  Indices place;
  hn::Mask<IntTag> is_second;  // 8 lanes: the triangle lies in the array's second vector
  HWY_INLINE explicit PickByTriangle(Int triangle)
      : place(hn::IndicesFromVec(kInt, hn::And(triangle, splat(kLanes - 1)))),
        is_second(hn::Gt(triangle, splat(kLanes - 1))) {}
  HWY_INLINE Int operator()(const std::int32_t* array) const {
    const Int first = hn::TableLookupLanes(hn::Load(kInt, array), place);
    return kLanes == kGroupSize
               ? first
               : hn::IfThenElse(is_second,
                                hn::TableLookupLanes(hn::Load(kInt, array + kGroupSize - kLanes), place),
                                first);
  }
  HWY_INLINE Float operator()(const float* array) const {
    return hn::BitCast(kFloat, (*this)(reinterpret_cast<const std::int32_t*>(array)));
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera::detail
HWY_AFTER_NAMESPACE();

#endif
