// Checks stored levels. A colour c of 8 bits is stored as the level nearest to 255 c, a depth z of b bits as
// the level nearest to (2^b - 1) z, a float depth unchanged. Ties may round either way, and the rounding of
// 255 c + 1/2 to float or of the depth to double is tolerated.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

#include "engine/program/cli/selftest_checks.h"
#include "engine/program/scene/fingerprint.h"

namespace tessera::program::cli {
namespace {

constexpr int kSide = 64;  // frame size; one point per pixel
constexpr int kPoints = kSide * kSide;
constexpr long double kColorRounding = 0x1p-17L;  // one rounding of a float below 256
constexpr long double kDepthRounding = 0x1p-20L;  // two roundings of a double below 2^33

struct Format {
  DepthFormat depth;
  int bits;  // 0: float
  const char* name;
};
constexpr Format kFormats[] = {{DepthFormat::unorm16, 16, "16-bit depth"},
                               {DepthFormat::unorm24, 24, "24-bit depth"},
                               {DepthFormat::unorm32, 32, "32-bit depth"},
                               {DepthFormat::float32, 0, "float depth"}};

/// Colours and depths in 0 .. 1, rows from the top: random values, levels of 8 bits, and values half way
/// between two levels.
struct Points {
  std::vector<float> positions;
  std::vector<float> colors;
  std::vector<float> depths;

  Points() {
    std::mt19937 random(2);
    const auto value = [&] {
      const std::uint32_t bits = random();
      const std::uint32_t kind = bits >> 30;
      const float half_level = static_cast<float>(bits % 511) / 510;
      if (kind == 0) return half_level;
      if (kind == 1) return std::nextafter(half_level, 1.0f);
      return static_cast<float>(bits & 0xffffff) / 0xffffff;
    };
    for (int i = 0; i < kPoints; ++i) {
      depths.push_back(value());
      positions.insert(positions.end(),
                       {(static_cast<float>(i % kSide) + 0.5f) / (kSide / 2) - 1,
                        1 - (static_cast<float>(i / kSide) + 0.5f) / (kSide / 2), depths.back()});
      colors.insert(colors.end(), {value(), value(), value(), 1});
    }
  }

  void draw(FrameBuffer& buffer, Renderer& renderer) const {
    Frame frame(buffer);
    frame.set_camera({.reversed = true});  // the depth is the position's z
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state{.lighting = false};
    state.depth.test = Compare::always;
    frame.draw({.primitive = Primitive::points, .positions = positions, .colors = colors}, state);
    renderer.finish(frame);
  }
};

}  // namespace

CheckReport check_levels(const Configurations& configurations) {
  const Points points;
  CheckReport report{.name = "stored levels, exact products", .measured = {}, .first_failure = {}};
  long double largest = 0;
  std::size_t count = 0;
  for (const RendererOptions& configuration : configurations) {
    Renderer renderer(configuration);
    std::string wrong;
    const auto note = [&](const char* level) { wrong += (wrong.empty() ? "" : ", ") + std::string(level); };
    for (const Format& format : kFormats) {
      FrameBuffer buffer({.width = kSide, .height = kSide, .depth = format.depth, .stencil_bits = 0});
      points.draw(buffer, renderer);
      const std::vector<std::uint32_t> colors = packed_colors(buffer);
      const std::vector<std::uint32_t> depths = stored_depths(buffer);
      long double color_error = 0;
      long double depth_error = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
          color_error = std::max(
              color_error, std::abs((colors[i] >> (16 - 8 * c) & 255) - 255.0L * points.colors[4 * i + c]));
        if (format.bits == 0)
          depth_error =
              std::max(depth_error, std::bit_cast<float>(depths[i]) == points.depths[i] ? 0.0L : 1.0L);
        else
          depth_error = std::max(
              depth_error, std::abs(depths[i] - (std::ldexp(1.0L, format.bits) - 1) * points.depths[i]));
      }
      if (color_error > 0.5L + kColorRounding && wrong.find("colour") == std::string::npos) note("colour");
      if (depth_error > 0.5L + kDepthRounding) note(format.name);
      largest = std::max({largest, color_error, depth_error});
      count += std::size_t{4} * kPoints;
    }
    if (!wrong.empty()) report.add("not the nearest level: " + wrong, configuration);
  }
  char error[32];
  std::snprintf(error, sizeof error, "%.4Lf", largest);
  report.measured = std::to_string(count) + " levels, error at most " + error;
  return report;
}

}  // namespace tessera::program::cli
