// The per-fragment keys of draws, bitmaps and images, and the buffers they require.
#include <limits>

#include "scene_parts.h"

namespace tessera::reference {
namespace {

const std::vector<std::pair<const char*, Compare>> kCompares{
    {"never", Compare::kNever},   {"less", Compare::kLess},       {"equal", Compare::kEqual},
    {"lequal", Compare::kLequal}, {"greater", Compare::kGreater}, {"notequal", Compare::kNotequal},
    {"gequal", Compare::kGequal}, {"always", Compare::kAlways}};

const std::vector<std::pair<const char*, StencilOp>> kStencilOps{
    {"keep", StencilOp::kKeep},          {"zero", StencilOp::kZero},         {"replace", StencilOp::kReplace},
    {"incr", StencilOp::kIncr},          {"decr", StencilOp::kDecr},         {"invert", StencilOp::kInvert},
    {"incr_wrap", StencilOp::kIncrWrap}, {"decr_wrap", StencilOp::kDecrWrap}};

const std::vector<std::pair<const char*, BlendFactor>> kFactors{
    {"zero", BlendFactor::kZero},
    {"one", BlendFactor::kOne},
    {"src_color", BlendFactor::kSrcColor},
    {"one_minus_src_color", BlendFactor::kOneMinusSrcColor},
    {"dst_color", BlendFactor::kDstColor},
    {"one_minus_dst_color", BlendFactor::kOneMinusDstColor},
    {"src_alpha", BlendFactor::kSrcAlpha},
    {"one_minus_src_alpha", BlendFactor::kOneMinusSrcAlpha},
    {"dst_alpha", BlendFactor::kDstAlpha},
    {"one_minus_dst_alpha", BlendFactor::kOneMinusDstAlpha},
    {"constant_color", BlendFactor::kConstantColor},
    {"one_minus_constant_color", BlendFactor::kOneMinusConstantColor},
    {"constant_alpha", BlendFactor::kConstantAlpha},
    {"one_minus_constant_alpha", BlendFactor::kOneMinusConstantAlpha},
    {"src_alpha_saturate", BlendFactor::kSrcAlphaSaturate}};

const std::vector<std::pair<const char*, BlendEquation>> kEquations{
    {"add", BlendEquation::kAdd},
    {"subtract", BlendEquation::kSubtract},
    {"reverse_subtract", BlendEquation::kReverseSubtract},
    {"min", BlendEquation::kMin},
    {"max", BlendEquation::kMax}};

const std::vector<std::pair<const char*, LogicOp>> kLogicOps{{"clear", LogicOp::kClear},
                                                             {"and", LogicOp::kAnd},
                                                             {"and_reverse", LogicOp::kAndReverse},
                                                             {"copy", LogicOp::kCopy},
                                                             {"and_inverted", LogicOp::kAndInverted},
                                                             {"noop", LogicOp::kNoop},
                                                             {"xor", LogicOp::kXor},
                                                             {"or", LogicOp::kOr},
                                                             {"nor", LogicOp::kNor},
                                                             {"equiv", LogicOp::kEquiv},
                                                             {"invert", LogicOp::kInvert},
                                                             {"or_reverse", LogicOp::kOrReverse},
                                                             {"copy_inverted", LogicOp::kCopyInverted},
                                                             {"or_inverted", LogicOp::kOrInverted},
                                                             {"nand", LogicOp::kNand},
                                                             {"set", LogicOp::kSet}};

AlphaTest parse_alpha_test(const Value& v, const FrameBufferFormat& format) {
  if (format.color_mode == ColorMode::kIndex)
    fail(v.pointer, "an RGB buffer for an alpha test, not an index buffer");
  ObjectReader reader(v);
  AlphaTest test;
  if (const Value func = reader.find("func")) test.func = choice(func, kCompares);
  if (const Value ref = reader.find("ref")) test.ref = number(ref, 0, 1);
  reader.finish();
  return test;
}

StencilFace parse_stencil_face(ObjectReader& reader) {
  StencilFace face;
  const auto bits = [&](const char* key, std::uint32_t& target) {
    if (const Value value = reader.find(key)) target = static_cast<std::uint32_t>(integer(value, 0, 255));
  };
  const auto op = [&](const char* key, StencilOp& target) {
    if (const Value value = reader.find(key)) target = choice(value, kStencilOps);
  };
  if (const Value func = reader.find("func")) face.func = choice(func, kCompares);
  bits("ref", face.ref);
  bits("mask", face.mask);
  bits("write_mask", face.write_mask);
  op("fail", face.fail);
  op("zfail", face.zfail);
  op("zpass", face.zpass);
  return face;
}

StencilState parse_stencil(const Value& v, const FrameBufferFormat& format) {
  if (format.stencil_bits == 0) fail(v.pointer, "a stencil buffer to test");
  ObjectReader reader(v);
  StencilState state;
  state.front = state.back = parse_stencil_face(reader);
  if (const Value back = reader.find("back"); back && !back.json->is_null()) {
    ObjectReader back_reader(back);
    state.back = parse_stencil_face(back_reader);
    back_reader.finish();
  }
  reader.finish();
  return state;
}

std::optional<DepthState> parse_depth(const Value& v, const FrameBufferFormat& format) {
  if (v.json->is_boolean() && !v.json->get<bool>()) return std::nullopt;
  if (format.depth == DepthFormat::kNone) fail(v.pointer, "a depth buffer to test");
  ObjectReader reader(v);
  DepthState depth;
  if (const Value test = reader.find("test")) depth.test = choice(test, kCompares);
  if (const Value write = reader.find("write")) depth.write = boolean(write);
  reader.finish();
  return depth;
}

Blend parse_blend(const Value& v, const FrameBufferFormat& format) {
  if (format.color_mode == ColorMode::kIndex)
    fail(v.pointer, "an RGB buffer to blend in, not an index buffer");
  ObjectReader reader(v);
  Blend blend;
  if (const Value src = reader.find("src")) blend.src = choice(src, kFactors);
  if (const Value dst = reader.find("dst")) blend.dst = choice(dst, kFactors);
  blend.src_alpha = blend.src;
  blend.dst_alpha = blend.dst;
  if (const Value src = reader.find("src_alpha"); src && !src.json->is_null())
    blend.src_alpha = choice(src, kFactors);
  if (const Value dst = reader.find("dst_alpha"); dst && !dst.json->is_null())
    blend.dst_alpha = choice(dst, kFactors);
  if (const Value equation = reader.find("equation")) blend.equation = choice(equation, kEquations);
  if (const Value color = reader.find("color")) {
    for (std::size_t i = 0; i < array_size(color); ++i) number(color[i], 0, 1);
    blend.color = vec4(color);
  }
  reader.finish();
  return blend;
}

}  // namespace

void parse_window_depths(ObjectReader& reader, const FrameBufferFormat& format, Draw& draw) {
  if (const Value range = reader.find("depth_range")) {
    draw.depth_range = numbers<2>(range);
    for (std::size_t i = 0; i < 2; ++i) number(range[i], 0, 1);
  }
  if (const Value offset = reader.find("polygon_offset")) {
    const auto [factor, units] = numbers<2>(offset);
    if ((factor != 0 || units != 0) && format.depth == DepthFormat::kNone)
      fail(offset.pointer, "a depth buffer to offset depths in");
    draw.polygon_offset = {factor, units};
  }
}

std::array<bool, 4> parse_color_mask(const Value& v, const FrameBufferFormat& format) {
  if (array_size(v) != 4) fail(v.pointer, "four of true and false");
  std::array<bool, 4> mask;
  for (std::size_t i = 0; i < 4; ++i) mask[i] = boolean(v[i]);
  const bool one_value = format.color_mode == ColorMode::kIndex || format.color_bits < 3;
  if (one_value && (mask[0] != mask[1] || mask[1] != mask[2]))
    fail(v.pointer, "all or none for a luminance or index buffer");
  return mask;
}

void parse_fragment_state(ObjectReader& reader, const FrameBufferFormat& format, FragmentState& state) {
  if (const Value scissor = reader.find("scissor")) state.scissor = rect(scissor);
  if (const Value test = reader.find("alpha_test")) state.alpha_test = parse_alpha_test(test, format);
  if (const Value stencil = reader.find("stencil")) state.stencil = parse_stencil(stencil, format);
  if (format.depth == DepthFormat::kNone) state.depth = std::nullopt;
  if (const Value depth = reader.find("depth"); depth && !depth.json->is_number())
    state.depth = parse_depth(depth, format);
  if (const Value blend = reader.find("blend")) state.blend = parse_blend(blend, format);
  if (const Value op = reader.find("logic_op")) {
    state.logic_op = choice(op, kLogicOps);
    if (state.blend && state.logic_op != LogicOp::kCopy)
      fail(op.pointer, "\"copy\" together with \"blend\": blending and a logic operation exclude each other");
  }
  if (const Value mask = reader.find("color_mask")) state.color_mask = parse_color_mask(mask, format);
  if (const Value planes = reader.find("plane_mask"))
    state.plane_mask =
        static_cast<std::uint32_t>(integer(planes, 0, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace tessera::reference
