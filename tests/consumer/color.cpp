// Converts a colour and catches an error of a display, with the display library alone, without the core.
#include <tessera/color.hpp>
#include <tessera/display.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const tessera::ColorValues hsv = tessera::hsv_from_rgb({0.5, 1, 1});
  std::printf("%g %g %g\n", hsv[0], hsv[1], hsv[2]);
  if (std::abs(hsv[0] - 180) > 1e-9 || hsv[1] != 0.5 || hsv[2] != 1) return 5;
  try {
    tessera::find_display("crt:pitch=9");
  } catch (const tessera::DisplayError& error) {
    return std::printf("%s\n", error.what()) > 0 ? 0 : 6;
  }
  return 7;
}
