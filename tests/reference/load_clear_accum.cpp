// The commands clear and accum, which work on rectangles of whole buffers.
#include <limits>

#include "scene_parts.h"

namespace tessera::reference {
namespace {

constexpr std::int64_t kMaxUint = std::numeric_limits<std::uint32_t>::max();

std::uint32_t low_bits(int bits) { return (std::uint32_t{1} << bits) - 1; }

Vec4 vec4_within(const Value& v, double least, double most) {
  for (std::size_t i = 0; i < array_size(v); ++i) number(v[i], least, most);
  return vec4(v);
}

}  // namespace

Clear parse_clear(const Value& v, const Scene& scene) {
  const FrameBufferFormat& format = scene.framebuffer;
  ObjectReader reader(v);
  Clear clear;
  if (const Value color = reader.find("color")) clear.color = vec4_within(color, 0, 1);
  if (const Value index = reader.find("index")) {
    if (format.color_mode != ColorMode::kIndex) fail(index.pointer, "an index buffer to clear to an index");
    clear.index = static_cast<std::uint32_t>(integer(index, 0, kMaxUint)) & low_bits(format.color_bits);
  }
  if (const Value depth = reader.find("depth")) {
    if (format.depth == DepthFormat::kNone) fail(depth.pointer, "a depth buffer to clear");
    clear.depth = number(depth, 0, 1);
  }
  if (const Value stencil = reader.find("stencil")) {
    if (format.stencil_bits == 0) fail(stencil.pointer, "a stencil buffer to clear");
    clear.stencil = static_cast<std::uint32_t>(integer(stencil, 0, 255)) & low_bits(format.stencil_bits);
  }
  if (const Value accumulation = reader.find("accumulation")) {
    if (format.accumulation_bits == 0) fail(accumulation.pointer, "an accumulation buffer to clear");
    clear.accumulation = vec4_within(accumulation, -1, 1);
  }
  if (const Value scissor = reader.find("scissor")) clear.scissor = rect(scissor);
  reader.finish();
  return clear;
}

Accum parse_accum(const Value& v, const Scene& scene) {
  if (scene.framebuffer.color_mode == ColorMode::kIndex)
    fail(v.pointer, "an RGB buffer for accumulation, not an index buffer");
  if (scene.framebuffer.accumulation_bits == 0) fail(v.pointer, "an accumulation buffer");
  ObjectReader reader(v);
  Accum accum;
  accum.op = choice<AccumOp>(reader.require("op"), {{"accum", AccumOp::kAccum},
                                                    {"load", AccumOp::kLoad},
                                                    {"add", AccumOp::kAdd},
                                                    {"mult", AccumOp::kMult},
                                                    {"return", AccumOp::kReturn}});
  accum.value = number(reader.require("value"));
  if (const Value scissor = reader.find("scissor")) accum.scissor = rect(scissor);
  if (const Value mask = reader.find("color_mask"))
    accum.color_mask = parse_color_mask(mask, scene.framebuffer);
  reader.finish();
  return accum;
}

}  // namespace tessera::reference
