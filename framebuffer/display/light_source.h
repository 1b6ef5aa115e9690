// Light that a display emits for a picture, before its geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "framebuffer/display/signal_to_light.h"

namespace tessera::detail {

/// A picture and when it is shown.
struct ShownPicture {
  const std::uint8_t* levels;  ///< red, green, blue; rows without gaps
  std::int64_t frame;          ///< number of the frame of the mode
  double phase_ms;             ///< time since the beginning of the frame
  double since_last_ms;        ///< time since the call before
  bool is_first;               ///< no picture came before: this one counts as shown long before
};

/// Emits the rows of pictures. A plane is light of one colour that spreads in one way.
class LightSource {
 public:
  virtual ~LightSource() = default;

  /// Called before the rows of a picture are emitted.
  virtual void begin(const ShownPicture& picture) = 0;
  /// Light of the rows [16 block, 16 block + 16): [plane][sample][row]. White is 1. Rows beyond the picture
  /// are undefined. Calls for different blocks may run at the same time.
  virtual void emit(int block, float* light) = 0;

  int planes() const { return planes_; }
  int samples() const { return samples_; }

 protected:
  LightSource(int planes, int samples) : planes_(planes), samples_(samples) {}

 private:
  int planes_, samples_;
};

}  // namespace tessera::detail
