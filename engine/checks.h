// Checks of what callers hand over, and the words for what is wrong with it.
#pragma once

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>

#include "engine/frame_buffer_state.h"

namespace tessera {

inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

// Names are put together where something is wrong only: a frame has thousands of draws.
struct Name {
  const char* owner;
  const char* field = "";
  std::string text() const { return std::string(owner) + field; }
};
inline void require_finite(const Name& name, std::initializer_list<double> values) {
  for (const double v : values)
    if (!std::isfinite(v)) throw Error(name.text() + " holds " + text(v) + ", must be finite");
}
inline void require_finite(const Name& name, const Color& c) { require_finite(name, {c.r, c.g, c.b, c.a}); }
inline void require_finite(const Name& name, const Matrix& matrix) {
  for (const double v : matrix.m) require_finite(name, {v});
}
inline void require_range(const Name& name, double value, double low, double high) {
  if (!(value >= low && value <= high)) throw Error(name.text() + " is " + text(value) + ", must be " + text(low) + " to " + text(high));
}
inline void check_rect(const Name& name, const Rect& rect) {
  if (rect.width < 0 || rect.height < 0)
    throw Error(name.text() + " is " + std::to_string(rect.width) + " x " + std::to_string(rect.height) + " pixels, must not be negative");
}

/// What the fragments of a draw go through, in a buffer that can have it. @param function  whose it is, for messages
void check_fragment_state(const char* function, const DrawState& state, const FrameBufferState& target);

}  // namespace tessera
