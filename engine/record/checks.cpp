#include "engine/record/checks.h"

#include <cmath>
#include <cstdio>

namespace tessera::detail {
namespace {

template <class Values>
void require_all_finite(const FieldName& name, const Values& values) {
  for (const double value : values)
    if (!std::isfinite(value))
      throw Error(ErrorCode::invalid_argument,
                  name.text() + " holds " + format_number(value) + ", must be finite");
}

}  // namespace

std::string format_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

void require_finite(const FieldName& name, std::initializer_list<double> values) {
  require_all_finite(name, values);
}
void require_finite(const FieldName& name, const Color& c) { require_finite(name, {c.r, c.g, c.b, c.a}); }
void require_finite(const FieldName& name, const Matrix& matrix) { require_all_finite(name, matrix.m); }

void require_range(const FieldName& name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw Error(ErrorCode::invalid_argument, name.text() + " is " + format_number(value) + ", must be " +
                                                 format_number(low) + " to " + format_number(high));
}

void check_rect(const FieldName& name, const Rect& rect) {
  if (rect.width < 0 || rect.height < 0)
    throw Error(ErrorCode::invalid_argument, name.text() + " is " + std::to_string(rect.width) + " x " +
                                                 std::to_string(rect.height) +
                                                 " pixels, must not be negative");
}

void throw_invalid_enum(const FieldName& name, unsigned value, unsigned last) {
  throw Error(ErrorCode::invalid_argument, name.text() + " is " + std::to_string(value) +
                                               ", not a valid enumerator; must be 0 to " +
                                               std::to_string(last));
}

namespace {

void check_stencil_face(const char* function, const StencilFace& face) {
  require_enum({function, ": stencil.func"}, face.func, Compare::always);
  for (const StencilOp op : {face.fail, face.zfail, face.zpass})
    require_enum({function, ": an operation of stencil"}, op, StencilOp::decr_wrap);
}

void check_blend(const char* function, const BlendState& blend) {
  for (const BlendFactor factor :
       {blend.src, blend.dst, blend.src_alpha.value_or(blend.src), blend.dst_alpha.value_or(blend.dst)})
    require_enum({function, ": a factor of blend"}, factor, BlendFactor::src_alpha_saturate);
  require_enum({function, ": blend.equation"}, blend.equation, BlendEquation::max);
  for (const float c : {blend.color.r, blend.color.g, blend.color.b, blend.color.a})
    require_range({function, ": a component of blend.color"}, c, 0, 1);
}

}  // namespace

void check_color_mask(const char* function, const std::array<bool, 4>& mask, const FrameBufferState& target) {
  if (mask[0] == mask[1] && mask[1] == mask[2]) return;
  const ColorLayout& layout = target.stored_layout;
  if (!layout.index && !layout.luminance) return;
  const char* const reason = layout.index ? "an index buffer stores one value per pixel"
                                          : "a buffer of 1 or 2 bits stores luminance alone";
  throw Error(ErrorCode::incompatible_format, std::string(function) +
                                                  ": color_mask differs between r, g and b, but " + reason +
                                                  "; set all or none of the three");
}

void check_fragment_state(const char* function, const DrawState& s, const FrameBufferState& target) {
  const auto refuse = [&](ErrorCode code, const std::string& reason) {
    throw Error(code, std::string(function) + ": " + reason);
  };
  if (s.scissor) check_rect({function, ": scissor"}, *s.scissor);
  check_color_mask(function, s.color_mask, target);
  require_enum({function, ": depth.test"}, s.depth.test, Compare::always);
  require_enum({function, ": logic_op"}, s.logic_op, LogicOp::set);
  if (is_error_diffusion(target.format.dither)) {
    constexpr const char* kUntilFinished = "keeps colours of 8 bits per component until it is finished";
    if (s.logic_op != LogicOp::copy)
      refuse(
          ErrorCode::incompatible_format,
          std::string("a logic operation is asked for, but a frame with error diffusion ") + kUntilFinished);
    const std::uint32_t planes = target.stored_layout.value_mask();
    if ((s.plane_mask & planes) != 0 && (s.plane_mask & planes) != planes)
      refuse(ErrorCode::incompatible_format,
             std::string("plane_mask selects some colour planes, but a frame with error diffusion ") +
                 kUntilFinished);
  }
  const bool is_index = target.stored_layout.index;
  if (s.alpha_test) {
    if (is_index)
      refuse(ErrorCode::incompatible_format,
             "an alpha test is asked for, but the frame buffer holds indices, which have no alpha");
    require_enum({function, ": alpha_test.func"}, s.alpha_test->func, Compare::always);
    require_range({function, ": alpha_test.ref"}, s.alpha_test->ref, 0, 1);
  }
  if (s.blend) {
    if (is_index)
      refuse(ErrorCode::incompatible_format,
             "blending is asked for, but the frame buffer holds indices, which do not blend");
    if (s.logic_op != LogicOp::copy)
      refuse(ErrorCode::invalid_argument,
             "blending and a logic operation are asked for; a draw has one of them");
    check_blend(function, *s.blend);
  }
  if (s.stencil) {
    if (target.format.stencil_bits == 0)
      refuse(ErrorCode::incompatible_format,
             "a stencil test is asked for, but the frame buffer has no stencil buffer");
    check_stencil_face(function, s.stencil->front);
    if (s.stencil->back) check_stencil_face(function, *s.stencil->back);
  }
}

}  // namespace tessera::detail
