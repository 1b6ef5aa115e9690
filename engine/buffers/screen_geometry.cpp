#include "engine/tessera/screen_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/record/checks.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/tessera/display_mode.hpp"

namespace tessera {
using namespace detail;

namespace {

// Sides of a 4:3 screen relative to its diagonal.
constexpr double kScreenWidth = 0.8, kScreenHeight = 0.6;
constexpr double kMmPerInch = 25.4;

struct StandardSize {
  int width, height;
};
constexpr StandardSize kStandardSizes[] = {{640, 480},   {800, 600},   {1024, 768},
                                           {1280, 1024}, {1600, 1200}, {1920, 1440}};

void require_length(const char* function, const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(ErrorCode::invalid_argument, std::string(function) + ": the " + what + " is " +
                                                 format_number(value) + ", must be finite and above 0");
}

/// max(a / b, b / a), which orders as |log(a / b)| does.
double ratio_above_1(double a, double b) { return std::max(a / b, b / a); }

}  // namespace

ScreenResolution screen_resolution(double diagonal_in, double pitch_mm) {
  constexpr const char* kFunction = "screen_resolution";
  return translate_bad_alloc(kFunction, [&] {
    require_length(kFunction, "diagonal", diagonal_in);
    require_length(kFunction, "pitch", pitch_mm);
    ScreenResolution screen{.width_in = kScreenWidth * diagonal_in, .height_in = kScreenHeight * diagonal_in};
    screen.columns = kMmPerInch * screen.width_in / pitch_mm;
    screen.rows = kMmPerInch * screen.height_in / pitch_mm;
    require_length(kFunction, "theoretical number of columns", screen.columns);
    double best = std::numeric_limits<double>::infinity();
    for (const StandardSize& size : kStandardSizes)
      if (const double ratio = ratio_above_1(size.width, screen.columns); ratio < best) {
        best = ratio;
        screen.mode_width = size.width;
        screen.mode_height = size.height;
      }
    return screen;
  });
}

double sharp_diagonal_in(const DisplayMode& mode, double pitch_mm) {
  constexpr const char* kFunction = "sharp_diagonal_in";
  return translate_bad_alloc(kFunction, [&] {
    require_length(kFunction, "pitch", pitch_mm);
    require_length(kFunction, "mode's width", mode.width);
    require_length(kFunction, "mode's height", mode.height);
    return std::max(mode.width * pitch_mm / (kMmPerInch * kScreenWidth),
                    mode.height * pitch_mm / (kMmPerInch * kScreenHeight));
  });
}

}  // namespace tessera
