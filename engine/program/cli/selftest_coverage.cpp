// Checks coverage exactly: triangles that each add one level to the pixels they cover, and opaque triangles
// that are each nearer than all earlier ones, so that the last one is visible.
#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

#include "engine/program/cli/selftest_checks.h"
#include "engine/program/scene/fingerprint.h"

namespace tessera::program::cli {
namespace {

constexpr int kSide = 128;       // frame size; a power of two, so that clip space is exact in 1/256 pixel
constexpr int kTriangles = 255;  // per frame: the largest count of 8 bits
constexpr int kRounds = 20;

using Corner = std::array<std::int32_t, 2>;  // raster space, 1/256 pixel
using Triangles = std::vector<std::array<Corner, 3>>;
using Counts = std::vector<std::uint32_t>;  // per pixel, rows from the top

struct Rng {
  std::mt19937 random;
  int between(int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  }
};

std::int64_t doubled_area(const Corner& a, const Corner& b, const Corner& c) {
  return std::int64_t{b[0] - a[0]} * (c[1] - a[1]) - std::int64_t{c[0] - a[0]} * (b[1] - a[1]);
}

/// Triangles of all sizes up to the guard band. Corners lie anywhere, on pixel centres, or on pixel borders,
/// some of which are tile borders.
Triangles random_triangles(Rng& rng) {
  constexpr int kMaxCoordinate = 16000 * 256;
  Triangles triangles;
  for (int i = 0; i < kTriangles; ++i) {
    const int reach = 1 << rng.between(3, 22);
    const int snap = std::array{1, 128, 256}[static_cast<std::size_t>(rng.between(0, 2))];
    const Corner middle{rng.between(0, kSide * 256), rng.between(0, kSide * 256)};
    auto& triangle = triangles.emplace_back();
    for (Corner& corner : triangle)
      for (std::size_t axis = 0; axis < 2; ++axis)
        corner[axis] =
            std::clamp(middle[axis] + rng.between(-reach, reach), -kMaxCoordinate, kMaxCoordinate) / snap *
            snap;
  }
  return triangles;
}

/// Starts with two triangles that contain the frame and repeatedly splits one at an inner point, so that
/// every edge inside the frame is shared.
Triangles shared_edges(Rng& rng) {
  constexpr int kLow = -1000;
  constexpr int kHigh = kSide * 256 + 1000;
  const Corner upper_left{kLow, kLow};
  const Corner lower_right{kHigh, kHigh};
  Triangles triangles{{upper_left, {kHigh, kLow}, lower_right}, {upper_left, lower_right, {kLow, kHigh}}};
  for (int tries = 0; tries < 2 * kTriangles && triangles.size() + 2 <= kTriangles; ++tries) {
    auto& split = triangles[rng.random() % triangles.size()];
    const auto [a, b, c] = split;
    const int along = rng.between(1, 255);
    const int across = rng.between(1, 256 - along);
    Corner inside;
    for (std::size_t axis = 0; axis < 2; ++axis)
      inside[axis] = a[axis] + ((b[axis] - a[axis]) * along + (c[axis] - a[axis]) * across) / 256;
    if (rng.between(0, 3) == 0) inside = {inside[0] / 128 * 128, inside[1] / 128 * 128};
    if (doubled_area(a, b, inside) <= 0 || doubled_area(b, c, inside) <= 0 || doubled_area(c, a, inside) <= 0)
      continue;
    split = {a, b, inside};
    triangles.push_back({b, c, inside});
    triangles.push_back({c, a, inside});
  }
  return triangles;
}

struct Expected {
  Counts counts = Counts(static_cast<std::size_t>(kSide) * kSide);  ///< number of covering triangles
  Counts last = counts;  ///< number of the last covering triangle, counted from 1; 0: none
};

/// Exact edge function, at least 0 inside: base + step_x * x + step_y * y at the centre of pixel (x, y).
/// Corners are below 2^22, so every product stays below 2^47.
struct EdgeFunction {
  std::int64_t base, step_x, step_y;
  EdgeFunction(const Corner& from, const Corner& to) {
    const std::int64_t along_x = to[0] - from[0];
    const std::int64_t along_y = to[1] - from[1];
    base = along_x * (128 - from[1]) - along_y * (128 - from[0]);
    step_x = -along_y * 256;
    step_y = along_x * 256;
    // Top-left rule, y down: a centre on an edge belongs to the triangle on the right of it, or below it.
    const bool is_top_left = step_x > 0 || (step_x == 0 && step_y > 0);
    if (!is_top_left) --base;
  }
  std::int64_t at(int x, int y) const { return base + step_x * x + step_y * y; }
};

Expected reference_coverage(const Triangles& triangles) {
  Expected expected;
  std::uint32_t number = 0;
  for (const auto& [a, b, c] : triangles) {
    ++number;
    const std::int64_t area = doubled_area(a, b, c);
    if (area == 0) continue;
    const Corner& second = area > 0 ? b : c;
    const Corner& third = area > 0 ? c : b;
    const EdgeFunction edges[3] = {{a, second}, {second, third}, {third, a}};
    const auto [left, right] = std::minmax({a[0], b[0], c[0]});
    const auto [top, bottom] = std::minmax({a[1], b[1], c[1]});
    // Pixels whose centres lie within the bounds.
    const int x0 = std::max((left + 127) >> 8, 0);
    const int x1 = std::min((right - 128) >> 8, kSide - 1);
    const int y0 = std::max((top + 127) >> 8, 0);
    const int y1 = std::min((bottom - 128) >> 8, kSide - 1);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        if (edges[0].at(x, y) < 0 || edges[1].at(x, y) < 0 || edges[2].at(x, y) < 0) continue;
        const auto pixel = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
        ++expected.counts[pixel];
        expected.last[pixel] = number;
      }
  }
  return expected;
}

/// Returns positions in clip space. Triangles have random winding; each is nearer than the one before.
std::vector<float> clip_positions(const Triangles& triangles, Rng& rng) {
  std::vector<float> positions;
  float depth = 1;
  for (const auto& triangle : triangles) {
    depth -= 1.0f / (kTriangles + 1);
    const bool flips_winding = rng.between(0, 1) != 0;
    for (const std::size_t k : {0, flips_winding ? 2 : 1, flips_winding ? 1 : 2}) {
      const Corner& corner = triangle[k];
      positions.insert(positions.end(), {static_cast<float>(corner[0]) / (128 * kSide) - 1,
                                         1 - static_cast<float>(corner[1]) / (128 * kSide), depth});
    }
  }
  return positions;
}

Counts drawn_counts(const std::vector<float>& positions, Renderer& renderer) {
  DrawState state{.lighting = false};
  state.material.diffuse = {0, 0, 1 / 255.0f, 1};  // one level of blue, the lowest bits of the packed color
  state.depth.enabled = false;
  state.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one};
  FrameBuffer buffer({.width = kSide, .height = kSide});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}});
  frame.draw({.positions = positions}, state);
  renderer.finish(frame);
  return packed_colors(buffer);
}

/// Draws each triangle in the colour of its number; returns the number visible at each pixel.
Counts drawn_numbers(const std::vector<float>& positions, Shading shading, Renderer& renderer) {
  std::vector<float> colors;
  for (std::size_t corner = 0; corner < positions.size() / 3; ++corner)
    colors.insert(colors.end(), {0, 0, static_cast<float>(corner / 3 + 1) / 255, 1});
  FrameBuffer buffer({.width = kSide, .height = kSide});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw({.positions = positions, .colors = colors}, {.shading = shading, .lighting = false});
  renderer.finish(frame);
  return packed_colors(buffer);
}

struct Case {
  std::vector<float> positions;
  Expected exact;
  Shading shading;
};

std::vector<Case> random_cases() {
  Rng rng{std::mt19937(1)};
  std::vector<Case> cases;
  for (int round = 0; round < kRounds; ++round)
    for (const bool shared : {false, true}) {
      const Triangles triangles = shared ? shared_edges(rng) : random_triangles(rng);
      cases.push_back({clip_positions(triangles, rng), reference_coverage(triangles),
                       round % 2 == 0 ? Shading::gouraud : Shading::flat});
      // Triangles with shared edges cover each pixel exactly once.
      if (shared) cases.back().exact.counts.assign(cases.back().exact.counts.size(), 1);
    }
  return cases;
}

/// Counts pixels that differ from the expected ones, and describes the first.
class PixelComparison {
 public:
  /// @param before, after  text around the number found at a pixel
  void compare(const Counts& drawn, const Counts& exact, const char* before, const char* after) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn[i] == exact[i]) continue;
      if (wrong_pixels_++ == 0)
        first_wrong_ = "pixel (" + std::to_string(i % kSide) + ", " + std::to_string(i / kSide) + ") " +
                       before + std::to_string(drawn[i]) + after + ", expected " + std::to_string(exact[i]);
    }
  }
  std::size_t wrong_pixels() const { return wrong_pixels_; }
  const std::string& first_wrong() const { return first_wrong_; }

 private:
  std::size_t wrong_pixels_ = 0;
  std::string first_wrong_;
};

}  // namespace

CheckReport check_coverage(const Configurations& configurations) {
  const std::vector<Case> cases = random_cases();
  std::size_t triangle_count = 0;
  for (const Case& c : cases) triangle_count += c.positions.size() / 9;  // 3 corners of 3 components
  CheckReport report{.name = "coverage, exact integers", .measured = {}, .first_failure = {}};
  std::size_t wrong_pixels = 0;
  for (const RendererOptions& configuration : configurations) {
    Renderer renderer(configuration);
    PixelComparison pixels;
    for (const Case& c : cases) {
      pixels.compare(drawn_counts(c.positions, renderer), c.exact.counts, "is covered ", " times");
      pixels.compare(drawn_numbers(c.positions, c.shading, renderer), c.exact.last, "shows triangle ", "");
    }
    wrong_pixels += pixels.wrong_pixels();
    if (pixels.wrong_pixels() != 0) report.add(pixels.first_wrong(), configuration);
  }
  report.measured = std::to_string(triangle_count * configurations.size()) + " triangles, " +
                    std::to_string(wrong_pixels) + " pixels wrong";
  return report;
}

}  // namespace tessera::program::cli
