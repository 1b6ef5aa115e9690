#include "engine/plan/pixel_plan.h"

#include "shading/fragment_scalar.h"

namespace tessera::detail {

void plan_pixel_places(DrawPlan& plan, const RecordedPixels& pixels, const FrameBufferState& target) {
  plan.pixel_rectangle = pixels.rectangle;
  plan.rect =
      covered_pixels(pixels.rectangle, target.format.width, target.format.height, target.format.samples);
  if (target.depth_format != DepthFormat::none)
    plan.depth_key =
        depth_key_from_stored(target.depth_format, quantize_depth(target.depth_format, pixels.depth));
}

void plan_pixel_colors(DrawPlan& plan, const RecordedPixels& pixels, const EffectNotes& notes) {
  const PixelRectangle& texels = pixels.rectangle;
  const bool is_bitmap = texels.channels == 0;
  plan.constant_color = {clamp_unit(pixels.color.r), clamp_unit(pixels.color.g), clamp_unit(pixels.color.b)};
  plan.alpha[0] = plan.alpha[1] = clamp_unit(pixels.color.a);
  plan.source = is_bitmap ? ColorSource::constant : ColorSource::texels;
  EffectReason reason = is_bitmap ? EffectReason::per_draw : EffectReason::per_texel;
  const bool stores_color = plan.write_mask != 0;
  if (!stores_color) {
    plan.source = ColorSource::none;
    reason = EffectReason::no_color_stored;
  }
  notes.add({.effect = is_bitmap ? Effect::bitmap : Effect::image,
             .active = stores_color,
             .reason = reason,
             .width = texels.width,
             .height = texels.height,
             .channels = texels.channels});
}

}  // namespace tessera::detail
