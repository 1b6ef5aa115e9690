#include "engine/plan/pixel_plan.h"

#include <cstdio>

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

void plan_pixel_colors(DrawPlan& plan, const RecordedPixels& pixels, std::string* reasons) {
  const PixelRectangle& texels = pixels.rectangle;
  const bool is_bitmap = texels.channels == 0;
  plan.source = plan.write_mask == 0 ? ColorSource::none
                : is_bitmap          ? ColorSource::constant
                                     : ColorSource::texels;
  plan.constant_color = {clamp_unit(pixels.color.r), clamp_unit(pixels.color.g), clamp_unit(pixels.color.b)};
  plan.alpha[0] = plan.alpha[1] = clamp_unit(pixels.color.a);
  if (!reasons) return;
  const char* const colors = plan.source == ColorSource::none ? "no colour plane changes"
                             : is_bitmap                      ? "one colour"
                                                              : "each pixel has the colour of its texel";
  char line[128];
  if (is_bitmap)
    std::snprintf(line, sizeof line, "  a bitmap of %d x %d: %s\n", texels.width, texels.height, colors);
  else
    std::snprintf(line, sizeof line, "  an image of %d x %d, %d channel%s: %s\n", texels.width, texels.height,
                  texels.channels, texels.channels == 1 ? "" : "s", colors);
  *reasons += line;
}

}  // namespace tessera::detail
