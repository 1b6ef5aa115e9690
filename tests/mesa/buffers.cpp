#include "buffers.h"

#include <bit>

namespace tessera::mesa {
namespace {

using reference::ColorMode;
using reference::FragmentState;
using reference::FrameBufferFormat;

bool has_components(const FrameBufferFormat& format) {
  return format.color_mode == ColorMode::kRgb && format.color_bits >= 3;
}

}  // namespace

const FragmentState* fragment_state(const reference::Command& command) {
  if (const auto* draw = std::get_if<reference::Draw>(&command)) return draw;
  if (const auto* bitmap = std::get_if<reference::Bitmap>(&command)) return bitmap;
  return std::get_if<reference::ImageDrawing>(&command);
}

bool reads_colors(const FragmentState& state) {
  return state.blend || state.logic_op != reference::LogicOp::kCopy;
}

Buffers buffers_for(const reference::Scene& scene) {
  bool reads = false;
  bool accumulates = false;
  Buffers buffers;
  buffers.depth = scene.framebuffer.depth;
  for (const reference::Command& command : scene.frame) {
    if (std::holds_alternative<reference::Accum>(command)) accumulates = true;
    if (const FragmentState* state = fragment_state(command)) {
      reads = reads || reads_colors(*state);
      buffers.stencil = buffers.stencil || state->stencil;
    }
  }
  if (accumulates) buffers.color = ColorStore::kWindow;
  else if (reads)
    buffers.color = scene.framebuffer.alpha_bits > 0 ? ColorStore::kBytesAndAlpha : ColorStore::kBytes;
  return buffers;
}

std::optional<std::array<bool, 4>> component_mask(const std::array<bool, 4>& color_mask,
                                                  std::uint32_t plane_mask, const FrameBufferFormat& format) {
  bool splits = false;
  const auto is_on = [&](int lowest, int bits) {
    const std::uint32_t planes = bits == 0 ? 0 : plane_mask >> lowest & ((1u << bits) - 1);
    if (planes != 0 && std::popcount(planes) != bits) splits = true;
    return planes != 0;
  };
  const bool alpha = color_mask[3] && is_on(format.color_bits, format.alpha_bits);
  std::array<bool, 4> mask{false, false, false, alpha};
  if (has_components(format)) {
    const int blue = format.color_bits / 3;
    const int green = (format.color_bits + 2) / 3;
    const int red = format.color_bits - green - blue;
    const bool r = is_on(green + blue, red);
    const bool g = is_on(blue, green);
    const bool b = is_on(0, blue);
    mask = {color_mask[0] && r, color_mask[1] && g, color_mask[2] && b, alpha};
  } else {
    mask[0] = mask[1] = mask[2] = is_on(0, format.color_bits) && color_mask[0];
  }
  if (splits) return std::nullopt;
  return mask;
}

}  // namespace tessera::mesa
