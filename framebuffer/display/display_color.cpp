#include "framebuffer/display/display_color.h"

namespace tessera::detail {
namespace {

// Chromaticities of monochrome phosphors [EIA TEP116]; screens of one type vary by about .01.
Chromaticity chromaticity_of(Phosphor phosphor) {
  switch (phosphor) {
    case Phosphor::p1: return {.218, .712};
    case Phosphor::p4: return {.270, .300};
    case Phosphor::p11: return {.139, .148};
    case Phosphor::p31: return {.226, .528};
    case Phosphor::p39: return {.223, .698};
    case Phosphor::p22: break;
  }
  return kWhiteD65;
}

}  // namespace

RgbPrimaries primaries_of(DisplayPrimaries primaries, DisplayWhite white) {
  constexpr RgbPrimaries kSets[] = {kBt709Primaries,    kSmpteCPrimaries,    kEbuPrimaries,
                                    kNtsc1953Primaries, kTrinitronPrimaries, kHitachiPrimaries};
  constexpr Chromaticity kWhites[] = {kWhiteD65, kWhite9300K, kWhiteC};
  RgbPrimaries set = kSets[static_cast<int>(primaries)];
  set.white = kWhites[static_cast<int>(white)];
  return set;
}

ColorMatrix srgb_from_display(DisplayPrimaries primaries, DisplayWhite white) {
  return inverse(xyz_from_rgb_light(kBt709Primaries)) * xyz_from_rgb_light(primaries_of(primaries, white));
}

ColorValues srgb_from_phosphor(Phosphor phosphor) {
  return inverse(xyz_from_rgb_light(kBt709Primaries)) * xyz_of(chromaticity_of(phosphor));
}

bool is_monochrome(Phosphor phosphor) { return phosphor != Phosphor::p22; }

}  // namespace tessera::detail
