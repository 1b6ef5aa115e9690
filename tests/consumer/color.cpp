// Converts a colour with the display library alone, without the core.
#include <tessera/color.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const tessera::ColorValues hsv = tessera::hsv_from_rgb({0.5, 1, 1});
  std::printf("%g %g %g\n", hsv[0], hsv[1], hsv[2]);
  return std::abs(hsv[0] - 180) < 1e-9 && hsv[1] == 0.5 && hsv[2] == 1 ? 0 : 5;
}
