// Checks stored levels against exact products:
// - a colour component c with 8 bits is stored as the level nearest to 255 c;
// - a depth z with b bits is stored as the level nearest to (2^b - 1) z;
// - a float depth is stored unchanged.
// The error may reach half a level, because ties round either way, plus the rounding of 255 c + 1/2 to float
// or of the depth to double.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <utility>

#include "engine/program/cli/selftest_checks.h"
#include "engine/program/scene/fingerprint.h"

namespace tessera::program::cli {
namespace {

constexpr long double kColorRounding = 0x1p-17L;  // one rounding of a float below 256
constexpr long double kDepthRounding = 0x1p-20L;  // two roundings of a double below 2^33

struct TestedFormat {
  DepthFormat depth;
  int bits;  // 0: float
  const char* name;
};
constexpr TestedFormat kFormats[] = {{DepthFormat::unorm16, 16, "16-bit depth"},
                                     {DepthFormat::unorm24, 24, "24-bit depth"},
                                     {DepthFormat::unorm32, 32, "32-bit depth"},
                                     {DepthFormat::float32, 0, "float depth"}};

/// One point per pixel, rows from the top. Colours and depths are in 0 .. 1: random values, levels of 8 bits,
/// values halfway between two levels, and the float above each of these.
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
    for (int i = 0; i < kFramePoints; ++i) {
      depths.push_back(value());
      positions.insert(positions.end(),
                       {(static_cast<float>(i % kFrameSide) + 0.5f) / (kFrameSide / 2) - 1,
                        1 - (static_cast<float>(i / kFrameSide) + 0.5f) / (kFrameSide / 2), depths.back()});
      colors.insert(colors.end(), {value(), value(), value(), 1});
    }
  }

  void draw(FrameBuffer& buffer, Renderer& renderer) const {
    Frame frame(buffer);
    frame.set_camera({.reversed = true});  // depth is the position's z, without a mapping from -1 .. 1
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state{.lighting = false};
    state.depth.test = Compare::always;
    frame.draw({.primitive = Primitive::points, .positions = positions, .colors = colors}, state);
    renderer.finish(frame);
  }
};

/// Distance in levels from a stored depth to the exact one. A wrong float depth counts as one level.
long double depth_error(std::uint32_t stored, float depth, const TestedFormat& format) {
  if (format.bits == 0) return std::bit_cast<float>(stored) == depth ? 0 : 1;
  return std::abs(stored - (std::ldexp(1.0L, format.bits) - 1) * depth);
}

/// In levels.
struct LargestErrors {
  long double color = 0;
  long double depth = 0;
};

LargestErrors largest_errors(const Points& points, const TestedFormat& format, Renderer& renderer) {
  FrameBuffer buffer({.width = kFrameSide, .height = kFrameSide, .depth = format.depth, .stencil_bits = 0});
  points.draw(buffer, renderer);
  const std::vector<std::uint32_t> colors = packed_colors(buffer);
  const std::vector<std::uint32_t> depths = stored_depths(buffer);
  LargestErrors largest;
  for (std::size_t i = 0; i < kFramePoints; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t level = colors[i] >> (16 - 8 * c) & 255;
      largest.color = std::max(largest.color, std::abs(level - 255.0L * points.colors[4 * i + c]));
    }
    largest.depth = std::max(largest.depth, depth_error(depths[i], points.depths[i], format));
  }
  return largest;
}

}  // namespace

CheckReport check_levels(const Configurations& configurations) {
  const Points points;
  CheckReport report{.name = "stored levels, exact products", .measured = {}, .first_failure = {}};
  long double largest = 0;
  std::size_t level_count = 0;
  for (const RendererOptions& configuration : configurations) {
    Renderer renderer(configuration);
    std::string failed;  // colour at most once, depth formats
    const auto add_failed = [&failed](const std::string& level) {
      failed += (failed.empty() ? "" : ", ") + level;
    };
    bool has_wrong_color = false;
    for (const TestedFormat& format : kFormats) {
      const LargestErrors errors = largest_errors(points, format, renderer);
      if (errors.color > 0.5L + kColorRounding && !std::exchange(has_wrong_color, true)) add_failed("colour");
      if (errors.depth > 0.5L + kDepthRounding) add_failed(format.name);
      largest = std::max({largest, errors.color, errors.depth});
      level_count += std::size_t{4} * kFramePoints;
    }
    if (!failed.empty()) report.add("not the nearest level: " + failed, configuration);
  }
  char error[32];
  std::snprintf(error, sizeof error, "%.4Lf", largest);
  report.measured = std::to_string(level_count) + " levels, error at most " + error;
  return report;
}

}  // namespace tessera::program::cli
