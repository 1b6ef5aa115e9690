// How far from the eye's plane what is stored in a depth buffer is.
#pragma once

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

/// By a projection for which each depth has one z.
class ViewDepth {
 public:
  /// @param function  whose argument the camera is, for its errors
  /// @throws Error where x or y have a say in depth, or all depths are the same
  ViewDepth(const Camera& camera, float background, const char* function);

  /// Distance from the eye's plane, positive before it, of what has the depth `stored`; the background where
  /// that is the far end.
  float at(double stored) const noexcept;

 private:
  double a_, b_, c_, e_;  // depth is (a z + b) / (c z + e) of eye space's z, or half of one more than that
  bool reversed_;
  float background_;
};

}  // namespace tessera::detail
