// Checks of what callers hand over, and the words for what is wrong with it.
#pragma once

#include <initializer_list>
#include <string>

#include "engine/buffers/frame_buffer_state.h"

namespace tessera::detail {

std::string format_number(double value);

// Names are put together where something is wrong only: a frame has thousands of draws.
struct FieldName {
  const char* owner;
  const char* field = "";
  std::string text() const { return std::string(owner) + field; }
};
void require_finite(const FieldName& name, std::initializer_list<double> values);
void require_finite(const FieldName& name, const Color& c);
void require_finite(const FieldName& name, const Matrix& matrix);
void require_range(const FieldName& name, double value, double low, double high);
void check_rect(const FieldName& name, const Rect& rect);
[[noreturn]] void throw_invalid_enum(const FieldName& name, unsigned value, unsigned last);
/// An enumerator, which count from 0 to `last`: whoever casts numbers, or calls from another language, may
/// have others.
template <class Enum>
void require_enum(const FieldName& name, Enum value, Enum last) {
  if (static_cast<unsigned>(value) > static_cast<unsigned>(last))
    throw_invalid_enum(name, static_cast<unsigned>(value), static_cast<unsigned>(last));
}

/// What the fragments of a draw go through, in a buffer that can have it. @param function  whose it is, for
/// messages
void check_fragment_state(const char* function, const DrawState& state, const FrameBufferState& target);
/// Components that a buffer cannot tell apart.
void check_color_mask(const char* function, const std::array<bool, 4>& mask, const FrameBufferState& target);

}  // namespace tessera::detail
