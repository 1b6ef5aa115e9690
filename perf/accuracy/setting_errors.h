// Errors of a setting's picture against the references of its scene.
#pragma once

#include "engine/program/imageio/picture.h"
#include "perf/accuracy/reference_pictures.h"

namespace tessera::accuracy {

/// Levels are those of 8 bits.
struct SettingErrors {
  // Against the unrounded colours. Rounding alone is 1 / sqrt(12) = 0.289 levels RMS.
  double unrounded_rms = 0;
  double unrounded_largest = 0;
  // Against the stored picture.
  int largest = 0;
  double rms = 0;
  double psnr_db = 0;                         ///< infinite for equal pictures
  double share_over_1 = 0, share_over_2 = 0;  ///< pixels with a component more than 1, 2 levels off
  double flip_mean = 0, flip_percentile_99 = 0;
};

/// Errors of one picture against both references.
struct BothErrors {
  SettingErrors point, area;
};

SettingErrors setting_errors(const program::Picture& picture, const ReferencePicture& reference);

}  // namespace tessera::accuracy
