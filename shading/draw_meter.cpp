#include "shading/draw_meter.h"

namespace tessera::detail {

void DrawMeter::begin_frame(std::size_t draws) {
  costs_.assign(draws, {});
  current_ = kNoDraw;
}

void DrawMeter::begin_tile(MeterPass pass) {
  pass_ = pass;
  current_ = last_begun_ = kNoDraw;
  shaded_pixels_ = 0;
  since_ = Clock::now();
}

void DrawMeter::begin_draw(std::uint32_t draw, std::uint64_t shaded_pixels) {
  switch_to(draw, shaded_pixels);
  // The modes of a draw's polygons take turns in the bins.
  if (pass_ == MeterPass::costs && draw != last_begun_) ++costs_[draw].tiles;
  last_begun_ = draw;
}

void DrawMeter::switch_to(std::uint32_t draw, std::uint64_t shaded_pixels) {
  if (draw == current_) return;
  const Clock::time_point now = Clock::now();
  if (current_ != kNoDraw) {
    DrawCost& cost = costs_[current_];
    const std::uint64_t pixels = shaded_pixels - shaded_pixels_;
    if (pass_ == MeterPass::fragments) {
      cost.fragments += pixels;
    } else {
      cost.seconds += std::chrono::duration<double>(now - since_).count();
      cost.shaded_pixels += pixels;
    }
  }
  current_ = draw;
  shaded_pixels_ = shaded_pixels;
  since_ = now;
}

}  // namespace tessera::detail
