// Argument checks, and the texts of their errors.
#pragma once

#include <initializer_list>
#include <string>

#include "engine/buffers/frame_buffer_state.h"

namespace tessera::detail {

std::string format_number(double value);

/// Name of an argument, for error texts. Its parts are concatenated only if there is an error: frames have
/// thousands of draws.
struct FieldName {
  const char* owner;
  const char* field = "";
  std::string text() const { return std::string(owner) + field; }
};

// These functions throw Error with ErrorCode::invalid_argument for a value that does not meet the condition.

void require_finite(const FieldName& name, std::initializer_list<double> values);
void require_finite(const FieldName& name, const Color& c);
void require_finite(const FieldName& name, const Matrix& matrix);
void require_range(const FieldName& name, double value, double low, double high);
/// Width and height must not be negative.
void check_rect(const FieldName& name, const Rect& rect);
[[noreturn]] void throw_invalid_enum(const FieldName& name, unsigned value, unsigned last);
/// `value` must be an enumerator, 0 to `last`. Casts and foreign languages may pass other values.
template <class Enum>
void require_enum(const FieldName& name, Enum value, Enum last) {
  if (static_cast<unsigned>(value) > static_cast<unsigned>(last))
    throw_invalid_enum(name, static_cast<unsigned>(value), static_cast<unsigned>(last));
}

/// Checks the fragment operations of a draw against the format of the frame buffer.
/// @param function  named in errors
void check_fragment_state(const char* function, const DrawState& state, const FrameBufferState& target);
/// Checks that a mask does not separate components that the frame buffer stores together.
void check_color_mask(const char* function, const std::array<bool, 4>& mask, const FrameBufferState& target);

}  // namespace tessera::detail
