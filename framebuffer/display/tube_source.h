// Light of the beam of a tube: levels -> signal -> light.
#pragma once

#include <memory>

#include "framebuffer/display/light_source.h"
#include "framebuffer/tessera/display.hpp"
#include "framebuffer/tessera/screen.hpp"

namespace tessera::detail {

/// Samples of light along a row of pixels.
struct TubeSamples {
  int count;         ///< in a row
  double per_pixel;  ///< samples per pixel
  /// Distance by which the light lags behind the pixels, in pixels: the delay of the video amplifier at low
  /// frequencies. A monitor's centring takes it out.
  double delay_px;
};

/// @param sigma_px  standard deviation of the beam in pixels of the mode
TubeSamples tube_samples(const Display& display, const VideoMode& mode, double sigma_px);

/// Planes: red, green, blue, or luma alone for monochrome phosphors; with beam growth these, then the same
/// again, for the light of the narrowest and of the widest beam.
std::unique_ptr<LightSource> make_tube_source(const Display& display, const VideoMode& mode, double sigma_px,
                                              InstructionSet isa);

}  // namespace tessera::detail
