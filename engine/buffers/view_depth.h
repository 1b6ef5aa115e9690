// Conversion of stored depth to distance from the eye plane.
#pragma once

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

/// Inverse of a projection that maps each depth to one z.
class ViewDepth {
 public:
  /// @param function  named in errors
  /// @throws Error  if depth depends on x or y, or is constant
  ViewDepth(const Camera& camera, float background, const char* function);

  /// Distance from the eye plane at depth `stored`, positive in front of it; the background at the far end.
  float at(double stored) const noexcept;

 private:
  // For z in eye space, q = (a z + b) / (c z + e). Depth is q if reversed, else (q + 1) / 2.
  double a_, b_, c_, e_;
  bool reversed_;
  float background_;
};

}  // namespace tessera::detail
