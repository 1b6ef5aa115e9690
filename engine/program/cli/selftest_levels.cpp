// A colour c of 8 bits is stored as the level nearest to 255 c, a depth z of b bits as the one nearest to
// (2^b - 1) z, a depth of floats as it is. Ties, and the rounding of 255 c + 1/2 to a float or of the depth
// to a double, may go either way.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

#include "engine/program/cli/selftest_oracles.h"
#include "engine/program/scene/fingerprint.h"

namespace tessera::program::cli {
namespace {

constexpr int kSide = 64;  // of the frame: a point in each pixel
constexpr int kPoints = kSide * kSide;
// One rounding of a float below 256, and two of a double below 2^33.
constexpr long double kColorRounding = 0x1p-17L, kDepthRounding = 0x1p-20L;

struct Format {
  DepthFormat depth;
  int bits;  // 0: floats
  const char* name;
};
constexpr Format kFormats[] = {{DepthFormat::unorm16, 16, "16-bit depth"},
                               {DepthFormat::unorm24, 24, "24-bit depth"},
                               {DepthFormat::unorm32, 32, "32-bit depth"},
                               {DepthFormat::float32, 0, "float depth"}};

/// Colours and depths in 0 .. 1, rows from the top: random ones, levels of 8 bits, and what lies half way
/// between two.
struct Points {
  std::vector<float> positions, colors, depths;

  Points() {
    std::mt19937 random(2);
    const auto value = [&] {
      const std::uint32_t bits = random(), kind = bits >> 30;
      const float level = static_cast<float>(bits % 511) / 510;
      return kind == 0   ? level
             : kind == 1 ? std::nextafter(level, 1.0f)
                         : static_cast<float>(bits & 0xffffff) / 0xffffff;
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
    frame.set_camera({.reversed = true});  // depths are positions' own z
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state{.lighting = false};
    state.depth.test = Compare::always;
    frame.draw({.primitive = Primitive::points, .positions = positions, .colors = colors}, state);
    renderer.finish(frame);
  }
};

}  // namespace

OracleReport check_levels(const Configurations& configurations) {
  const Points points;
  OracleReport report{.oracle = "stored levels, exact products", .measured = {}, .first_failure = {}};
  long double largest = 0;
  std::size_t count = 0;
  for (const RendererOptions& configuration : configurations) {
    Renderer renderer(configuration);
    std::string off;
    const auto note = [&](const char* what) { off += (off.empty() ? "" : ", ") + std::string(what); };
    for (const Format& format : kFormats) {
      FrameBuffer buffer({.width = kSide, .height = kSide, .depth = format.depth, .stencil_bits = 0});
      points.draw(buffer, renderer);
      const std::vector<std::uint32_t> words = packed_colors(buffer), depths = stored_depths(buffer);
      long double color_error = 0, depth_error = 0;
      for (std::size_t i = 0; i < kPoints; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
          color_error = std::max(
              color_error, std::abs((words[i] >> (16 - 8 * c) & 255) - 255.0L * points.colors[4 * i + c]));
        if (format.bits == 0)
          depth_error =
              std::max(depth_error, std::bit_cast<float>(depths[i]) == points.depths[i] ? 0.0L : 1.0L);
        else
          depth_error = std::max(
              depth_error, std::abs(depths[i] - (std::ldexp(1.0L, format.bits) - 1) * points.depths[i]));
      }
      if (color_error > 0.5L + kColorRounding && off.find("colour") == std::string::npos) note("colour");
      if (depth_error > 0.5L + kDepthRounding) note(format.name);
      largest = std::max({largest, color_error, depth_error});
      count += std::size_t{4} * kPoints;
    }
    if (!off.empty()) report.add("not the nearest level: " + off, configuration);
  }
  char error[32];
  std::snprintf(error, sizeof error, "%.4Lf", largest);
  report.measured = std::to_string(count) + " levels, at most " + error + " off";
  return report;
}

}  // namespace tessera::program::cli
