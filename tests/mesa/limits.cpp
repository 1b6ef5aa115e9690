#include "limits.h"

#include <algorithm>
#include <cmath>

#include "buffers.h"
#include "primitive_limits.h"
#include "program_lighting.h"
#include "shadow.h"
#include "texture_limits.h"

namespace tessera::mesa {
namespace {

using reference::Clear;
using reference::ColorMode;
using reference::DepthFormat;
using reference::Draw;
using reference::FrameBufferFormat;

using Reason = std::optional<std::string>;

constexpr int kLargestViewport = 8192;  // supported by every context

Reason format_limit(const FrameBufferFormat& format, const Buffers& buffers) {
  if (format.samples > 1) return "OSMesa has no multisampling";
  if (format.dither != reference::Dither::kNone) return "OpenGL leaves the dither pattern open";
  if (buffers.color != ColorStore::kFloat &&
      (format.color_mode != ColorMode::kRgb || format.color_bits != 24))
    return "what is read back would have to be stored in other than 24 bits";
  if (buffers.stencil && format.stencil_bits != 8) return "a stencil of fewer than 8 bits";
  if (buffers.stencil && (format.depth == DepthFormat::kUnorm16 || format.depth == DepthFormat::kUnorm32))
    return "a stencil with 16 or 32 bits of depth";
  if (buffers.color == ColorStore::kWindow && format.depth != DepthFormat::kNone &&
      format.depth != DepthFormat::kUnorm24)
    return "an accumulation buffer with other than 24 bits of depth";
  return std::nullopt;
}

Reason index_limit(const Draw& draw, const reference::Scene& scene) {
  if (scene.framebuffer.color_mode != ColorMode::kIndex || draw.shadow_on) return std::nullopt;
  const bool lights_back_faces = scene.light_model.two_sided && draw.back_material.color_indexes;
  const bool lit_by_index = draw.lighting && (draw.material.color_indexes || lights_back_faces);
  const bool drawn_by_index = !draw.lighting && !scene.meshes.at(draw.mesh).color_indices.empty();
  if (lit_by_index || drawn_by_index) return "OSMesa has no colour-index mode";
  return std::nullopt;
}

// State set by the frame's commands so far.
struct FrameState {
  reference::Camera camera;
  std::vector<reference::Light> lights;
  std::vector<double> cleared_depths;

  void take(const reference::CameraChange& change) { camera = change.camera; }
  void take(const reference::LightsChange& change) { lights = change.lights; }
  void take(const Clear& clear) {
    if (clear.depth) cleared_depths.push_back(*clear.depth);
  }
  void take(const auto&) {}  // other commands do not affect the limits
};

// Mesa carries depths in float and clears in double: a depth equal to a clear's depth may differ by one step.
bool meets_a_clear(double depth, const std::vector<double>& cleared) {
  return std::floor(depth) != depth && std::ranges::find(cleared, depth) != cleared.end();
}

Reason draw_limit(const Draw& draw, const reference::Scene& scene, const FrameState& frame) {
  const FrameBufferFormat& format = scene.framebuffer;
  if (!draw.stages.empty()) return "a user stage";
  if (draw.lighting && frame.lights.size() > kMaxProgramLights) return "more lights than the programs take";
  if (draw.viewport && (draw.viewport->width > kLargestViewport || draw.viewport->height > kLargestViewport))
    return "a viewport beyond Mesa's";
  if (format.depth == DepthFormat::kUnorm32 && draw.polygon_offset.units != 0)
    return "Mesa's float depth is too coarse for a unit of 32 bits";
  const auto [near, far] = draw.depth_range;
  if (draw.depth && near == far && meets_a_clear(near, frame.cleared_depths))
    return "a polygon at exactly a cleared depth: Mesa's float depth may lie a step away";
  if (const Reason reason = index_limit(draw, scene)) return reason;
  if (const Reason reason = texture_limit(draw, scene)) return reason;
  return primitive_limit(draw, scene, frame.camera);
}

// The limit of each command in turn.
struct CommandLimit {
  const reference::Scene& scene;
  const FrameState& frame;

  Reason operator()(const Clear& clear) const {
    if (clear.index && !cleared_entry(*clear.index, scene.framebuffer))
      return "a clear to a palette entry that is not set";
    return std::nullopt;
  }
  Reason operator()(const Draw& draw) const { return draw_limit(as_drawn(draw, frame.lights), scene, frame); }
  Reason operator()(const reference::Bitmap& bitmap) const {
    if (const Reason reason = bitmap_limit(bitmap)) return reason;
    return raster_limit(bitmap, bitmap.raster_depth);
  }
  Reason operator()(const reference::ImageDrawing& drawing) const {
    if (const Reason reason = image_limit(drawing)) return reason;
    return raster_limit(drawing, drawing.raster_depth);
  }
  Reason operator()(const auto&) const { return std::nullopt; }

  Reason raster_limit(const reference::FragmentState& state, double depth) const {
    if (state.depth && meets_a_clear(depth, frame.cleared_depths))
      return "pixels at exactly a cleared depth: Mesa's float depth may lie a step away";
    return std::nullopt;
  }
};

// Mesa's accumulation buffer wraps where Tessera's saturates. The bound ignores that scissors may separate
// commands.
class AccumulationBound {
 public:
  void take(const auto&) {}  // other commands do not change the accumulation buffer

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
      case reference::AccumOp::kMult:
        largest_ = accum.scissor ? std::max(largest_, largest_ * value) : largest_ * value;
        break;
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
  FrameState frame{scene.camera, scene.lights, {}};
  AccumulationBound accumulation;
  for (const reference::Command& command : scene.frame) {
    std::visit([&](const auto& c) { frame.take(c), accumulation.take(c); }, command);
    if (accumulation.may_wrap()) return "Mesa's accumulation buffer wraps where it ought to saturate";
    if (const reference::FragmentState* state = fragment_state(command);
        state && !component_mask(state->color_mask, state->plane_mask, scene.framebuffer))
      return "a plane mask splits a colour component";
    if (const Reason reason = std::visit(CommandLimit{scene, frame}, command)) return reason;
  }
  return std::nullopt;
}

}  // namespace tessera::mesa
