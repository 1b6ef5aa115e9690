#include "limits.h"

#include <algorithm>
#include <cmath>

#include "buffers.h"
#include "lighting_programs.h"

namespace tessera::mesa {
namespace {

using reference::Clear;
using reference::ColorMode;
using reference::DepthFormat;
using reference::Draw;
using reference::FrameBufferFormat;

using Reason = std::optional<std::string>;

constexpr int kLargestViewport = 8192;  // what the context surely takes

Reason format_limit(const FrameBufferFormat& format, const Buffers& buffers) {
  if (format.samples > 1) return "OSMesa has no multisampling";
  if (format.dither != reference::Dither::kNone) return "OpenGL leaves the dither pattern open";
  if (buffers.color != ColorStore::kFloat && (format.color_mode != ColorMode::kRgb || format.color_bits != 24))
    return "what is read back would have to be stored in other than 24 bits";
  if (buffers.stencil && format.stencil_bits != 8) return "a stencil of fewer than 8 bits";
  if (buffers.stencil && (format.depth == DepthFormat::kUnorm16 || format.depth == DepthFormat::kUnorm32))
    return "a stencil beside 16 or 32 bits of depth";
  if (buffers.color == ColorStore::kWindow && format.depth != DepthFormat::kNone && format.depth != DepthFormat::kUnorm24)
    return "an accumulation buffer beside other than 24 bits of depth";
  return std::nullopt;
}

Reason index_limit(const Draw& draw, const reference::Scene& scene) {
  if (scene.framebuffer.color_mode != ColorMode::kIndex || draw.shadow_on) return std::nullopt;
  const bool lit_by_index = draw.lighting && (draw.material.color_indexes || (scene.light_model.two_sided && draw.back_material.color_indexes));
  const bool drawn_by_index = !draw.lighting && !scene.meshes.at(draw.mesh).color_indices.empty();
  if (lit_by_index || drawn_by_index) return "OSMesa has no colour-index mode";
  return std::nullopt;
}

Reason draw_limit(const Draw& draw, const reference::Scene& scene, std::size_t lights) {
  const FrameBufferFormat& format = scene.framebuffer;
  if (!component_mask(draw.color_mask, draw.plane_mask, format)) return "a plane mask splits a colour component";
  if (draw.lighting && lights > kMaxProgramLights) return "more lights than the programs take";
  if (draw.viewport && (draw.viewport->width > kLargestViewport || draw.viewport->height > kLargestViewport)) return "a viewport beyond Mesa's";
  if (format.depth == DepthFormat::kUnorm32 && draw.polygon_offset.units != 0) return "Mesa's float depth is too coarse for a unit of 32 bits";
  return index_limit(draw, scene);
}

// Mesa carries depths in float and clears in double: a polygon put at exactly the depth of a clear may lie a step beside it.
bool meets_a_clear(const Draw& draw, const std::vector<double>& cleared) {
  const auto [near, far] = draw.depth_range;
  const auto is_met = [&](double depth) { return depth == near && std::floor(depth) != depth; };
  return draw.depth && near == far && std::ranges::any_of(cleared, is_met);
}

// Mesa's accumulation buffer wraps where ours saturates. This bounds its values as if no scissor kept commands apart.
class AccumulationBound {
 public:
  void take(const Clear& clear) {
    if (!clear.accumulation) return;
    const reference::Vec4 a = *clear.accumulation;
    largest_ = std::max({largest_, std::abs(a.x), std::abs(a.y), std::abs(a.z), std::abs(a.w)});
  }

  void take(const reference::Accum& accum) {
    const double value = std::abs(accum.value);
    switch (accum.op) {
      case reference::AccumOp::kAccum:
      case reference::AccumOp::kAdd: largest_ += value; break;
      case reference::AccumOp::kLoad: largest_ = accum.scissor ? std::max(largest_, value) : value; break;
      case reference::AccumOp::kMult: largest_ = accum.scissor ? std::max(largest_, largest_ * value) : largest_ * value; break;
      case reference::AccumOp::kReturn: break;
    }
  }

  bool may_wrap() const { return largest_ > 1 + 1e-9; }

 private:
  double largest_ = 0;
};

}  // namespace

std::optional<reference::Rgb8> cleared_entry(std::uint32_t index, const FrameBufferFormat& format) {
  const reference::Rgb8 entry = index < format.palette.size() ? format.palette[index] : reference::Rgb8{};
  if (std::ranges::find(format.palette, entry) == format.palette.end()) return std::nullopt;
  return entry;
}

Reason first_limit(const reference::Scene& scene) {
  if (const Reason reason = format_limit(scene.framebuffer, buffers_for(scene))) return reason;
  std::size_t lights = scene.lights.size();
  std::vector<double> cleared_depths;
  AccumulationBound accumulation;
  for (const reference::Command& command : scene.frame) {
    if (const auto* change = std::get_if<reference::LightsChange>(&command)) lights = change->lights.size();
    if (const auto* clear = std::get_if<Clear>(&command)) {
      if (clear->index && !cleared_entry(*clear->index, scene.framebuffer)) return "a clear to a palette entry that is not set";
      accumulation.take(*clear);
      if (clear->depth) cleared_depths.push_back(*clear->depth);
    }
    if (const auto* accum = std::get_if<reference::Accum>(&command)) accumulation.take(*accum);
    if (accumulation.may_wrap()) return "Mesa's accumulation buffer wraps where it ought to saturate";
    if (const auto* draw = std::get_if<Draw>(&command)) {
      if (const Reason reason = draw_limit(*draw, scene, lights)) return reason;
      if (meets_a_clear(*draw, cleared_depths)) return "a polygon at exactly a cleared depth: Mesa's float depth may lie a step beside it";
    }
  }
  return std::nullopt;
}

}  // namespace tessera::mesa
