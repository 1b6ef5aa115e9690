#include "perf/accuracy/setting_errors.h"

#include "engine/program/compare/flip.h"
#include "engine/program/compare/picture_errors.h"

namespace tessera::accuracy {

SettingErrors setting_errors(const program::Picture& picture, const ReferencePicture& reference) {
  const program::PixelView view = program::pixels_of(picture);
  const program::PixelView stored = program::pixels_of(reference.stored);
  const program::UnroundedErrors unrounded = program::unrounded_errors(view, reference.unrounded);
  const program::PictureErrors errors = program::picture_errors(view, stored);
  const program::FlipErrors flip = program::flip_errors(view, stored, {.threads = 1});
  return {.unrounded_rms = unrounded.rms,
          .unrounded_largest = unrounded.largest,
          .largest = errors.largest,
          .rms = errors.rms,
          .psnr_db = errors.psnr_db,
          .share_over_1 = errors.share_over(1),
          .share_over_2 = errors.share_over(2),
          .flip_mean = flip.mean,
          .flip_percentile_99 = flip.percentile_99};
}

}  // namespace tessera::accuracy
