#include "fragment_functions.h"

#include "buffers.h"

namespace tessera::mesa {
namespace {

using reference::BlendEquation;
using reference::BlendFactor;
using reference::LogicOp;
using reference::StencilOp;

GLenum stencil_operation(StencilOp op) {
  switch (op) {
    case StencilOp::kKeep: return GL_KEEP;
    case StencilOp::kZero: return GL_ZERO;
    case StencilOp::kReplace: return GL_REPLACE;
    case StencilOp::kIncr: return GL_INCR;
    case StencilOp::kDecr: return GL_DECR;
    case StencilOp::kInvert: return GL_INVERT;
    case StencilOp::kIncrWrap: return GL_INCR_WRAP;
    case StencilOp::kDecrWrap: return GL_DECR_WRAP;
  }
  return GL_KEEP;
}

GLenum blend_factor(BlendFactor factor) {
  switch (factor) {
    case BlendFactor::kZero: return GL_ZERO;
    case BlendFactor::kOne: return GL_ONE;
    case BlendFactor::kSrcColor: return GL_SRC_COLOR;
    case BlendFactor::kOneMinusSrcColor: return GL_ONE_MINUS_SRC_COLOR;
    case BlendFactor::kDstColor: return GL_DST_COLOR;
    case BlendFactor::kOneMinusDstColor: return GL_ONE_MINUS_DST_COLOR;
    case BlendFactor::kSrcAlpha: return GL_SRC_ALPHA;
    case BlendFactor::kOneMinusSrcAlpha: return GL_ONE_MINUS_SRC_ALPHA;
    case BlendFactor::kDstAlpha: return GL_DST_ALPHA;
    case BlendFactor::kOneMinusDstAlpha: return GL_ONE_MINUS_DST_ALPHA;
    case BlendFactor::kConstantColor: return GL_CONSTANT_COLOR;
    case BlendFactor::kOneMinusConstantColor: return GL_ONE_MINUS_CONSTANT_COLOR;
    case BlendFactor::kConstantAlpha: return GL_CONSTANT_ALPHA;
    case BlendFactor::kOneMinusConstantAlpha: return GL_ONE_MINUS_CONSTANT_ALPHA;
    case BlendFactor::kSrcAlphaSaturate: return GL_SRC_ALPHA_SATURATE;
  }
  return GL_ONE;
}

GLenum blend_equation(BlendEquation equation) {
  switch (equation) {
    case BlendEquation::kAdd: return GL_FUNC_ADD;
    case BlendEquation::kSubtract: return GL_FUNC_SUBTRACT;
    case BlendEquation::kReverseSubtract: return GL_FUNC_REVERSE_SUBTRACT;
    case BlendEquation::kMin: return GL_MIN;
    case BlendEquation::kMax: return GL_MAX;
  }
  return GL_FUNC_ADD;
}

GLenum logic_operation(LogicOp op) {
  switch (op) {
    case LogicOp::kClear: return GL_CLEAR;
    case LogicOp::kAnd: return GL_AND;
    case LogicOp::kAndReverse: return GL_AND_REVERSE;
    case LogicOp::kCopy: return GL_COPY;
    case LogicOp::kAndInverted: return GL_AND_INVERTED;
    case LogicOp::kNoop: return GL_NOOP;
    case LogicOp::kXor: return GL_XOR;
    case LogicOp::kOr: return GL_OR;
    case LogicOp::kNor: return GL_NOR;
    case LogicOp::kEquiv: return GL_EQUIV;
    case LogicOp::kInvert: return GL_INVERT;
    case LogicOp::kOrReverse: return GL_OR_REVERSE;
    case LogicOp::kCopyInverted: return GL_COPY_INVERTED;
    case LogicOp::kOrInverted: return GL_OR_INVERTED;
    case LogicOp::kNand: return GL_NAND;
    case LogicOp::kSet: return GL_SET;
  }
  return GL_COPY;
}

void set_stencil_face(const Functions& gl, GLenum side, const reference::StencilFace& face) {
  gl.stencil_func_separate(side, compare_function(face.func), static_cast<GLint>(face.ref), face.mask);
  gl.stencil_op_separate(side, stencil_operation(face.fail), stencil_operation(face.zfail),
                         stencil_operation(face.zpass));
  gl.stencil_mask_separate(side, face.write_mask);
}

void set_blend(const Functions& gl, const reference::Blend& blend) {
  const reference::Vec4 c = blend.color;
  gl.blend_func_separate(blend_factor(blend.src), blend_factor(blend.dst), blend_factor(blend.src_alpha),
                         blend_factor(blend.dst_alpha));
  gl.blend_equation(blend_equation(blend.equation));
  gl.blend_color(static_cast<GLfloat>(c.x), static_cast<GLfloat>(c.y), static_cast<GLfloat>(c.z),
                 static_cast<GLfloat>(c.w));
}

}  // namespace

GLenum compare_function(reference::Compare test) {
  switch (test) {
    case reference::Compare::kNever: return GL_NEVER;
    case reference::Compare::kLess: return GL_LESS;
    case reference::Compare::kEqual: return GL_EQUAL;
    case reference::Compare::kLequal: return GL_LEQUAL;
    case reference::Compare::kGreater: return GL_GREATER;
    case reference::Compare::kNotequal: return GL_NOTEQUAL;
    case reference::Compare::kGequal: return GL_GEQUAL;
    case reference::Compare::kAlways: return GL_ALWAYS;
  }
  return GL_ALWAYS;
}

void set_enabled(GLenum capability, bool on) { (on ? glEnable : glDisable)(capability); }

void set_scissor(const std::optional<reference::Rect>& scissor) {
  set_enabled(GL_SCISSOR_TEST, scissor.has_value());
  if (scissor) glScissor(scissor->x, scissor->y, scissor->width, scissor->height);
}

void set_color_mask(const std::array<bool, 4>& mask) { glColorMask(mask[0], mask[1], mask[2], mask[3]); }

void set_fragment_functions(const Functions& gl, const reference::FragmentState& state,
                            const reference::FrameBufferFormat& format) {
  set_scissor(state.scissor);
  set_enabled(GL_ALPHA_TEST, state.alpha_test.has_value());
  if (state.alpha_test)
    glAlphaFunc(compare_function(state.alpha_test->func), static_cast<GLclampf>(state.alpha_test->ref));
  set_enabled(GL_STENCIL_TEST, state.stencil.has_value());
  if (state.stencil) {
    set_stencil_face(gl, GL_FRONT, state.stencil->front);
    set_stencil_face(gl, GL_BACK, state.stencil->back);
  }
  set_enabled(GL_DEPTH_TEST, state.depth.has_value());
  if (state.depth) {
    glDepthFunc(compare_function(state.depth->test));
    glDepthMask(state.depth->write ? GL_TRUE : GL_FALSE);
  }
  set_enabled(GL_BLEND, state.blend.has_value());
  if (state.blend) set_blend(gl, *state.blend);
  set_enabled(GL_COLOR_LOGIC_OP, state.logic_op != LogicOp::kCopy);
  glLogicOp(logic_operation(state.logic_op));
  set_color_mask(component_mask(state.color_mask, state.plane_mask, format).value());
}

// One unit of Mesa's llvmpipe is two levels of a unorm format (measured; OpenGL permits it) and one step of
// float.
void set_window_depths(const reference::Draw& draw, reference::DepthFormat depth) {
  const reference::PolygonOffset offset = draw.polygon_offset;
  glDepthRange(draw.depth_range[0], draw.depth_range[1]);
  for (const GLenum mode : {GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT})
    set_enabled(mode, offset.factor != 0 || offset.units != 0);
  const double units = depth == reference::DepthFormat::kFloat32 ? offset.units : offset.units / 2;
  glPolygonOffset(static_cast<GLfloat>(offset.factor), static_cast<GLfloat>(units));
}

}  // namespace tessera::mesa
