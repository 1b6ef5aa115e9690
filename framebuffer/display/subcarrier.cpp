#include "framebuffer/display/subcarrier.h"

#include <cstddef>

#include "framebuffer/trigonometry.h"

namespace tessera::detail {

Subcarrier make_subcarrier(double degrees, int v_sign, double gain) {
  Subcarrier carrier{};
  for (std::size_t k = 0; k < carrier.u.size(); ++k) {
    const auto [sine, cosine] = sine_cosine(degrees + 90 * static_cast<double>(k % 4));
    carrier.u[k] = static_cast<float>(gain * sine);
    carrier.v[k] = static_cast<float>(gain * v_sign * cosine);
  }
  return carrier;
}

}  // namespace tessera::detail
