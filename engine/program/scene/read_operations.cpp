// Reads the per-fragment operations of draws, bitmaps and images.
#include "engine/program/scene/read_scene.h"
#include "engine/program/scene/state_names.h"

namespace tessera::program {
namespace {

using json::Json;
using json::Object;
using json::Value;

DepthState read_depth(const Value& value, const Scene& scene) {
  if (value.json() == Json(false)) return {.enabled = false};
  if (scene.framebuffer.depth == DepthFormat::none)
    value.refuse("needs a depth buffer, and the frame buffer's \"depth\" is \"none\"");
  if (value.json().is_boolean()) value.fail("false or an object");
  const Object object(value, {"test", "write"});
  DepthState depth;
  if (const auto test = object.find("test")) depth.test = test->choice(kCompares);
  if (const auto write = object.find("write")) depth.write = write->boolean();
  return depth;
}

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

std::array<bool, 4> read_color_mask(const Value& value, const FrameBufferFormat& format) {
  if (!value.json().is_array() || value.size() != 4) value.fail("four of true and false");
  std::array<bool, 4> mask;
  for (std::size_t i = 0; i < 4; ++i) mask[i] = value.element(i).boolean();
  const bool has_components = format.color_mode == ColorMode::rgb && format.color_bits > 2;
  if (!has_components && (mask[0] != mask[1] || mask[1] != mask[2]))
    value.refuse(
        "red, green and blue must be all true or all false on an index buffer or one of 1 or 2 bits");
  return mask;
}
void read_fragment_state(const Object& object, const Scene& scene, DrawState& state) {
  state.depth.enabled = scene.framebuffer.depth != DepthFormat::none;
  if (const auto depth = object.find("depth"); depth && !depth->json().is_number())
    state.depth = read_depth(*depth, scene);
  if (const auto mask = object.find("color_mask"))
    state.color_mask = read_color_mask(*mask, scene.framebuffer);
  if (const auto mask = object.find("plane_mask"))
    state.plane_mask = static_cast<std::uint32_t>(mask->integer(0, kMaxUint32));
  if (const auto scissor = object.find("scissor")) state.scissor = scissor->rect();
  read_operations(object, scene.framebuffer, state);
}
}  // namespace tessera::program
