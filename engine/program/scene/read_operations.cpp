// Reads the per-fragment operations of a draw.
#include "engine/program/scene/read_scene.h"
#include "engine/program/scene/state_names.h"

namespace tessera::program {
namespace {

using json::Object;
using json::Value;

StencilOp read_stencil_op(const Value& value) {
  return value.choice<StencilOp>({{"keep", StencilOp::keep},
                                  {"zero", StencilOp::zero},
                                  {"replace", StencilOp::replace},
                                  {"incr", StencilOp::incr},
                                  {"decr", StencilOp::decr},
                                  {"invert", StencilOp::invert},
                                  {"incr_wrap", StencilOp::incr_wrap},
                                  {"decr_wrap", StencilOp::decr_wrap}});
}

StencilFace read_face(const Object& object) {
  StencilFace face;
  if (const auto func = object.find("func")) face.func = func->choice(kCompares);
  if (const auto ref = object.find("ref")) face.ref = static_cast<std::uint32_t>(ref->integer(0, 255));
  if (const auto mask = object.find("mask")) face.mask = static_cast<std::uint32_t>(mask->integer(0, 255));
  if (const auto op = object.find("fail")) face.fail = read_stencil_op(*op);
  if (const auto op = object.find("zfail")) face.zfail = read_stencil_op(*op);
  if (const auto op = object.find("zpass")) face.zpass = read_stencil_op(*op);
  if (const auto mask = object.find("write_mask"))
    face.write_mask = static_cast<std::uint32_t>(mask->integer(0, 255));
  return face;
}

StencilState read_stencil(const Value& value) {
  const Object object(value, {"func", "ref", "mask", "fail", "zfail", "zpass", "write_mask", "back"});
  StencilState state{.front = read_face(object)};
  if (const auto back = object.find("back"); back && !back->json().is_null())
    state.back = read_face(Object(*back, {"func", "ref", "mask", "fail", "zfail", "zpass", "write_mask"}));
  return state;
}

BlendState read_blend(const Value& value) {
  const Object object(value, {"src", "dst", "src_alpha", "dst_alpha", "equation", "color"});
  BlendState blend;
  if (const auto factor = object.find("src")) blend.src = factor->choice(kBlendFactors);
  if (const auto factor = object.find("dst")) blend.dst = factor->choice(kBlendFactors);
  if (const auto factor = object.find("src_alpha"); factor && !factor->json().is_null())
    blend.src_alpha = factor->choice(kBlendFactors);
  if (const auto factor = object.find("dst_alpha"); factor && !factor->json().is_null())
    blend.dst_alpha = factor->choice(kBlendFactors);
  if (const auto equation = object.find("equation"))
    blend.equation = equation->choice<BlendEquation>({{"add", BlendEquation::add},
                                                      {"subtract", BlendEquation::subtract},
                                                      {"reverse_subtract", BlendEquation::reverse_subtract},
                                                      {"min", BlendEquation::min},
                                                      {"max", BlendEquation::max}});
  if (const auto color = object.find("color")) blend.color = color->color(0, 1);
  return blend;
}

LogicOp read_logic(const Value& value) {
  using enum LogicOp;
  return value.choice<LogicOp>({{"clear", clear},
                                {"and", bit_and},
                                {"and_reverse", and_reverse},
                                {"copy", copy},
                                {"and_inverted", and_inverted},
                                {"noop", noop},
                                {"xor", bit_xor},
                                {"or", bit_or},
                                {"nor", nor},
                                {"equiv", equiv},
                                {"invert", invert},
                                {"or_reverse", or_reverse},
                                {"copy_inverted", copy_inverted},
                                {"or_inverted", or_inverted},
                                {"nand", nand},
                                {"set", set}});
}

}  // namespace

void read_operations(const Object& object, const FrameBufferFormat& format, DrawState& state) {
  if (const auto offset = object.find("polygon_offset")) {
    if (!offset->json().is_array() || offset->size() != 2) offset->fail("[factor, units]");
    if (format.depth == DepthFormat::none && offset->json() != json::Json{0, 0})
      offset->refuse("needs a depth buffer, and the frame buffer's \"depth\" is \"none\"");
    state.polygon_offset = {offset->element(0).real(), offset->element(1).real()};
  }
  const bool is_index = format.color_mode == ColorMode::index;
  if (const auto test = object.find("alpha_test")) {
    if (is_index) test->refuse("an index buffer has no alpha to test");
    const Object members(*test, {"func", "ref"});
    state.alpha_test.emplace();
    if (const auto func = members.find("func")) state.alpha_test->func = func->choice(kCompares);
    if (const auto ref = members.find("ref")) state.alpha_test->ref = ref->real(0, 1);
  }
  if (const auto stencil = object.find("stencil")) {
    if (format.stencil_bits == 0)
      stencil->refuse("needs a stencil buffer, and the frame buffer's \"stencil\" is 0");
    state.stencil = read_stencil(*stencil);
  }
  if (const auto logic = object.find("logic_op")) state.logic_op = read_logic(*logic);
  if (const auto blend = object.find("blend")) {
    if (is_index) blend->refuse("an index buffer does not blend");
    if (state.logic_op != LogicOp::copy) blend->refuse("a draw blends or has a logic operation, not both");
    state.blend = read_blend(*blend);
  }
}

}  // namespace tessera::program
