// Points and lines through the public interface: covered pixels and samples by independent rules in exact
// integers, clipping, and the source of their colours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "tests/engine/frame/api_support.h"
#include "tests/raster/diamond_exit_rule.h"

namespace tessera::points_lines_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;

// Powers of two: every multiple of 1/256 pixel is exact in a float's window coordinate.
constexpr int kWidth = 256;
constexpr int kHeight = 128;

FrameBufferFormat format_of(int samples) { return {.width = kWidth, .height = kHeight, .samples = samples}; }

// In 1/256 pixel, y down from the top row; up to `beyond` pixels outside the window.
LinePoint random_point(Random& random, int beyond) {
  return {static_cast<std::int32_t>(below(random, (kWidth + 2 * beyond) * 256) - beyond * 256),
          static_cast<std::int32_t>(below(random, (kHeight + 2 * beyond) * 256) - beyond * 256)};
}
LinePoint near(Random& random, LinePoint p, int reach) {
  return {p.x + static_cast<std::int32_t>(below(random, 2 * reach + 1)) - reach,
          p.y + static_cast<std::int32_t>(below(random, 2 * reach + 1)) - reach};
}

void add(MeshData& mesh, const LinePoint& p, float z = 0) {
  mesh.positions.push_back(static_cast<float>(p.x) / (128 * kWidth) - 1);
  mesh.positions.push_back(1 - static_cast<float>(p.y) / (128 * kHeight));
  mesh.positions.push_back(z);
}
MeshData mesh_of(Primitive primitive, const std::vector<LinePoint>& points) {
  MeshData mesh;
  mesh.primitive = primitive;
  for (const LinePoint& p : points) add(mesh, p);
  return mesh;
}

// Adds 1 to each pixel per fragment.
DrawState counting() {
  DrawState state = unlit({1 / 255.0f, 1 / 255.0f, 1 / 255.0f, 1});
  state.depth.enabled = false;
  state.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one};
  return state;
}
std::vector<std::uint32_t> drawn(const MeshData& mesh, const DrawState& state, Renderer& renderer,
                                 int samples = 1) {
  FrameBuffer buffer(format_of(samples));
  Frame frame(buffer);
  frame.draw(mesh.view(), state);
  renderer.finish(frame);
  return packed_colors(buffer);
}

struct Renderers {
  Renderer of[3] = {Renderer({.threads = 1, .tile_size = 32}), Renderer({.threads = 1, .tile_size = 64}),
                    Renderer({.threads = 1, .tile_size = 128})};
};

using PixelSet = std::set<std::pair<int, int>>;
std::vector<std::uint32_t> words_of(const PixelSet& pixels, std::uint32_t word) {
  std::vector<std::uint32_t> words(std::size_t{kWidth} * kHeight);
  for (const auto& [x, y] : pixels)
    if (x >= 0 && x < kWidth && y >= 0 && y < kHeight) words[static_cast<std::size_t>(y * kWidth + x)] = word;
  return words;
}

// y up: centred on the pixel that holds the point, or on the nearest pixel corner [GL 2.1, 3.3].
PixelSet square_by_the_rule(const LinePoint& at, int size) {
  const double x = at.x / 256.0, y = kHeight - at.y / 256.0;
  const double center_x = size % 2 != 0 ? std::floor(x) + 0.5 : std::floor(x + 0.5);
  const double center_y = size % 2 != 0 ? std::floor(y) + 0.5 : std::floor(y + 0.5);
  PixelSet pixels;
  for (int j = 0; j < kHeight; ++j)
    for (int i = 0; i < kWidth; ++i)
      if (std::abs(i + 0.5 - center_x) < size / 2.0 && std::abs(j + 0.5 - center_y) < size / 2.0)
        pixels.insert({i, kHeight - 1 - j});
  return pixels;
}
PixelSet wide_by_the_rule(LinePoint a, LinePoint b, int width) {
  const bool x_major = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
  // y up: shifted by -(w - 1) / 2, then repeated w times [GL 2.1, 3.4.2].
  const int aside = 128 * (width - 1);
  (x_major ? a.y : a.x) += x_major ? aside : -aside;
  (x_major ? b.y : b.x) += x_major ? aside : -aside;
  PixelSet pixels;
  for (const auto& [x, y] : diamond_exit_pixels(a, b))
    for (int k = 0; k < width; ++k) pixels.insert({x_major ? x : x + k, x_major ? y - k : y});
  return pixels;
}

TEST(Points, CoverTheSquareOfTheirSize) {
  Renderers renderers;
  Random random(51);
  for (int turn = 0; turn < 200; ++turn) {
    LinePoint at = random_point(random, 0);
    if (turn % 4 == 0) at = {at.x & ~127, at.y & ~127};  // pixel centres, borders and corners
    float size = 1;
    if (turn % 3 == 1) size = static_cast<float>(1 + below(random, 40));
    if (turn % 3 == 2) size = random.between(0.01f, 9.4f);
    DrawState state = counting();
    state.point_size = size;
    const PixelSet expected = square_by_the_rule(at, std::max(1, static_cast<int>(std::floor(size + 0.5f))));
    for (Renderer& renderer : renderers.of)
      ASSERT_EQ(drawn(mesh_of(Primitive::points, {at}), state, renderer), words_of(expected, 0x010101))
          << at.x << " " << at.y << ", size " << size << ", tiles of " << renderer.options().tile_size;
  }
}

TEST(Points, AreDrawnIfTheirCentreIsInTheViewVolume) {
  Renderer renderer({.threads = 1});
  for (const int axis : {0, 1, 2})
    for (const float side : {-1.0f, 1.0f})
      for (const bool inside : {true, false}) {
        MeshData mesh;
        mesh.primitive = Primitive::points;
        mesh.positions = {0, 0, 0};
        mesh.positions[static_cast<std::size_t>(axis)] = inside ? side : std::nextafter(side, 2 * side);
        DrawState state = unlit({1, 1, 1, 1});
        state.point_size = 8;
        state.depth.enabled = false;
        const std::vector<std::uint32_t> words = drawn(mesh, state, renderer);
        const auto count = std::count(words.begin(), words.end(), 0xffffffu);
        // Only x and y at the border of the view volume cut the square in half.
        const int fragments = axis == 2 ? 64 : 32;
        EXPECT_EQ(count, inside ? fragments : 0) << "axis " << axis << ", " << side;
      }
}

TEST(Lines, CoverThePixelsWhoseDiamondTheyExit) {
  Renderers renderers;
  Random random(52);
  for (int turn = 0; turn < 300; ++turn) {
    const LinePoint a = random_point(random, turn % 5 == 4 ? 300 : 0),
                    b = turn % 2 == 0 ? near(random, a, turn % 3 == 0 ? 300 : 2000)
                                      : random_point(random, turn % 5 == 4 ? 300 : 0);
    const int width = turn % 4 == 3 ? 1 + static_cast<int>(below(random, 12)) : 1;
    DrawState state = counting();
    state.line_width = static_cast<float>(width) + random.between(-0.49f, 0.49f);
    const std::vector<std::uint32_t> expected = words_of(wide_by_the_rule(a, b, width), 0x010101);
    for (Renderer& renderer : renderers.of)
      ASSERT_EQ(drawn(mesh_of(Primitive::lines, {a, b}), state, renderer), expected)
          << a.x << " " << a.y << " to " << b.x << " " << b.y << ", width " << state.line_width
          << ", tiles of " << renderer.options().tile_size;
  }
}

// Each pixel once, across many joints: the strip stays in one octant.
TEST(Lines, StripsHaveNoGapsAndNoRepeatedPixels) {
  Renderer renderer({.threads = 2, .tile_size = 32});
  Random random(53);
  for (int turn = 0; turn < 100; ++turn) {
    const int octant = turn % 8;
    LinePoint at{kWidth * 128, kHeight * 128};
    std::vector<LinePoint> strip{at};
    for (int segment = 0; segment < 12; ++segment) {
      const int along = 1 + static_cast<int>(below(random, 1400));
      const int across = static_cast<int>(below(random, along));
      const int x = (octant & 1) != 0 ? along : across, y = (octant & 1) != 0 ? across : along;
      at = {at.x + ((octant & 2) != 0 ? x : -x), at.y + ((octant & 4) != 0 ? y : -y)};
      strip.push_back(at);
    }
    const std::vector<std::uint32_t> words =
        drawn(mesh_of(Primitive::line_strip, strip), counting(), renderer);
    ASSERT_TRUE(
        std::all_of(words.begin(), words.end(), [](std::uint32_t w) { return w == 0 || w == 0x010101; }))
        << "strip " << turn;
    int steps = 0;  // along the octant's major axis
    for (int i = 0; i < ((octant & 1) != 0 ? kWidth : kHeight); ++i)
      for (int j = 0; j < ((octant & 1) != 0 ? kHeight : kWidth); ++j)
        steps += words[static_cast<std::size_t>((octant & 1) != 0 ? j * kWidth + i : i * kWidth + j)] != 0;
    const std::int32_t from = (octant & 1) != 0 ? strip.front().x : strip.front().y;
    const std::int32_t to = (octant & 1) != 0 ? at.x : at.y;
    const std::int32_t most = 256 * ((octant & 1) != 0 ? kWidth : kHeight);
    ASSERT_NEAR(steps, std::abs(std::clamp(to, 0, most) - from) / 256.0, 1.01) << "strip " << turn;
  }
}

TEST(Lines, LoopsReturnToTheStart) {
  Renderer renderer({.threads = 1});
  const std::vector<LinePoint> square{{10 * 256 + 128, 10 * 256 + 128},
                                      {50 * 256 + 128, 10 * 256 + 128},
                                      {50 * 256 + 128, 40 * 256 + 128},
                                      {10 * 256 + 128, 40 * 256 + 128}};
  PixelSet expected;
  for (int i = 10; i < 50; ++i) expected.insert({i, 10}), expected.insert({i + 1, 40});
  for (int j = 10; j < 40; ++j) expected.insert({50, j}), expected.insert({10, j + 1});
  EXPECT_EQ(drawn(mesh_of(Primitive::line_loop, square), counting(), renderer), words_of(expected, 0x010101));
}

// Sample positions of Direct3D 11, in 1/16 pixel from the centre, y down.
const std::vector<LinePoint>& pattern(int samples) {
  static const std::vector<LinePoint> kFour{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
  static const std::vector<LinePoint> kEight{{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                             {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
  return samples == 4 ? kFour : kEight;
}
template <class Covers>
std::vector<std::uint32_t> means(int samples, const Covers& covers) {
  std::vector<std::uint32_t> words;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      int sum = 0;
      for (const LinePoint& offset : pattern(samples))
        sum += covers(LinePoint{256 * x + 128 + 16 * offset.x, 256 * y + 128 + 16 * offset.y}) ? 255 : 0;
      words.push_back(0x010101u *
                      static_cast<std::uint32_t>(std::floor(static_cast<double>(sum) / samples + 0.5)));
    }
  return words;
}

TEST(Points, AreDiscsWithSeveralSamples) {
  Renderers renderers;
  Random random(54);
  for (int turn = 0; turn < 60; ++turn) {
    const int samples = turn % 2 == 0 ? 4 : 8;
    const LinePoint at = random_point(random, 0);
    DrawState state = unlit({1, 1, 1, 1});
    const std::int64_t diameter = 1 + below(random, 30 * 256);
    state.point_size = static_cast<float>(diameter) / 256;
    const std::vector<std::uint32_t> expected = means(samples, [&](const LinePoint& p) {
      const std::int64_t x = p.x - at.x, y = p.y - at.y;
      return 4 * (x * x + y * y) <= diameter * diameter;
    });
    for (Renderer& renderer : renderers.of)
      ASSERT_EQ(drawn(mesh_of(Primitive::points, {at}), state, renderer, samples), expected)
          << at.x << " " << at.y << ", diameter " << diameter;
  }
}

TEST(Lines, AreRectanglesWithSeveralSamples) {
  Renderers renderers;
  Random random(55);
  for (int turn = 0; turn < 80; ++turn) {
    const int samples = turn % 2 == 0 ? 4 : 8;
    const LinePoint a = random_point(random, 0);
    LinePoint b = turn % 4 < 2 ? near(random, a, 1500) : random_point(random, 0);
    if (turn % 5 == 0) b.x = a.x;  // sides through sample positions
    if (turn % 5 == 1) b.y = a.y;
    DrawState state = unlit({1, 1, 1, 1});
    const std::int64_t width = turn % 5 < 2 ? 16 * (1 + below(random, 200)) : 1 + below(random, 12 * 256);
    state.line_width = static_cast<float>(width) / 256;
    const std::int64_t dx = b.x - a.x;
    const std::int64_t dy = b.y - a.y;
    const std::int64_t squared = dx * dx + dy * dy;
    // Whether a point lies inside a side of the rectangle, or on it if it is a left or top side.
    // `distance` is positive inside; (inward_x, inward_y) points inside.
    const auto within = [](Wide distance, std::int64_t inward_x, std::int64_t inward_y) {
      const bool is_left_or_top = inward_x > 0 || (inward_x == 0 && inward_y > 0);
      return distance > 0 || (distance == 0 && is_left_or_top);
    };
    const std::vector<std::uint32_t> expected = means(samples, [&](const LinePoint& p) {
      const std::int64_t along = dx * (p.x - a.x) + dy * (p.y - a.y);
      const std::int64_t across = dx * (p.y - a.y) - dy * (p.x - a.x);
      // |across| compared with width / 2 * length, as signed squares.
      const Wide half = Wide{width} * width * squared;
      const Wide aside = 4 * Wide{across} * across * (across < 0 ? -1 : 1);
      const bool is_between_ends = within(along, dx, dy) && within(squared - along, -dx, -dy);
      const bool is_between_sides = within(half - aside, dy, -dx) && within(half + aside, -dy, dx);
      return squared != 0 && is_between_ends && is_between_sides;
    });
    for (Renderer& renderer : renderers.of)
      ASSERT_EQ(drawn(mesh_of(Primitive::lines, {a, b}), state, renderer, samples), expected)
          << a.x << " " << a.y << " to " << b.x << " " << b.y << ", width " << width;
  }
}

// A known bug of Mesa's software driver: the provoking vertex may be the clipped one.
TEST(Lines, KeepTheirFlatColorIfClipped) {
  Renderer renderer({.threads = 1});
  for (const ProvokingVertex convention : {ProvokingVertex::last, ProvokingVertex::first})
    for (const bool turned : {false, true}) {
      MeshData mesh;
      mesh.primitive = Primitive::lines;
      // The second vertex is in front of the near plane.
      mesh.positions = {-0.8f, 0.3f, 0.5f, 0.8f, -0.2f, -3};
      mesh.colors = {1, 0, 0, 1, 0, 1, 0, 1};
      if (turned) mesh.indices = {1, 0};
      DrawState state;
      state.lighting = false;
      state.shading = Shading::flat;
      state.provoking_vertex = convention;
      const std::vector<std::uint32_t> words = drawn(mesh, state, renderer);
      const bool red = (convention == ProvokingVertex::first) != turned;
      EXPECT_GT(std::count(words.begin(), words.end(), red ? 0xff0000u : 0x00ff00u), 20) << red;
      EXPECT_EQ(std::count(words.begin(), words.end(), red ? 0x00ff00u : 0xff0000u), 0) << red;
    }
}

// A clipped line covers a subset of the pixels of the unclipped line, in the same colours.
TEST(Lines, ClippedAtTheNearPlaneCoverASubset) {
  Renderer renderer({.threads = 1});
  MeshData mesh;
  mesh.primitive = Primitive::lines;
  mesh.positions = {-0.75f, -0.5f, 0.5f, 0.75f, 0.5f, -1.5f};
  mesh.colors = {1, 0, 0, 1, 0, 1, 0, 1};
  DrawState state;
  state.lighting = false;
  const std::vector<std::uint32_t> cut = drawn(mesh, state, renderer);
  // The same end points in the window.
  mesh.positions[2] = 0.05f;
  mesh.positions[5] = -0.15f;
  const std::vector<std::uint32_t> whole = drawn(mesh, state, renderer);
  int both = 0;
  int differ = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    both += cut[i] != 0 && whole[i] != 0;
    differ += cut[i] != 0 && cut[i] != whole[i];
  }
  // The line is 0.75 * kWidth pixels long; three quarters of it lie behind the near plane, in view.
  EXPECT_NEAR(both, 0.75 * 0.75 * kWidth, 1);
  EXPECT_LE(differ, 2) << "rounding";
}

// A line this wide has pixels far beyond its ends. At one of them, (11, 28), the weights of the ends sum to
// 0: perspective is undefined there, but values that are equal at both ends must be kept.
TEST(Lines, KeepTheColorOfBothEndsIfTheirWeightsCancel) {
  const float positions[] = {-0.671875f, -0.359375f, 0, 1, -1.21875f, -0.65625f, 0, 2};
  const float colors[] = {1, 0, 0, 1, 1, 0, 0, 1};
  const std::uint8_t texels[] = {255, 255, 255, 255, 255, 255, 255, 255};
  const Texture texture({.pixels = texels, .width = 2, .height = 1},
                        {.mag = TextureFilter::nearest, .min = TextureFilter::nearest});
  DrawState plain = unlit({1, 1, 1, 1});
  plain.line_width = 20;
  DrawState blended = plain;
  DrawState textured = plain;
  blended.blend =
      BlendState{.src = BlendFactor::one, .dst = BlendFactor::one_minus_dst_alpha};  // destination alpha is 1
  textured.texture = &texture;
  for (const InstructionSet set : available_instruction_sets()) {
    Renderer renderer({.threads = 1, .instruction_set = set});
    for (const auto& [state, dither] :
         {std::pair{plain, Dither::none}, std::pair{plain, Dither::bayer4}, std::pair{blended, Dither::none},
          std::pair{textured, Dither::none}}) {
      FrameBuffer buffer({.width = 64, .height = 64, .dither = dither});
      Frame frame(buffer);
      frame.draw(
          {.primitive = Primitive::lines, .positions = positions, .position_components = 4, .colors = colors},
          state);
      renderer.finish(frame);
      const std::vector<std::uint32_t> words = packed_colors(buffer);
      EXPECT_EQ(std::count(words.begin(), words.end(), 0xff0000u), 40) << name(set);
      EXPECT_EQ(std::count(words.begin(), words.end(), 0u), 64 * 64 - 40) << name(set);
    }
  }
}

TEST(Lines, AreFrontFacingAndNeverCulled) {
  Renderer renderer({.threads = 1});
  for (const Primitive primitive : {Primitive::points, Primitive::lines})
    for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
      DrawState state = unlit({1, 1, 1, 1});
      state.cull = cull;
      const std::vector<std::uint32_t> words =
          drawn(mesh_of(primitive, {{1000, 1000}, {9000, 2000}}), state, renderer);
      EXPECT_GE(std::count(words.begin(), words.end(), 0xffffffu), 2);
    }
}

// A line's first pixel may lie before its start: its index leaves the range at one end and wraps to the
// other.
TEST(Lines, IndicesWrapAround) {
  for (const InstructionSet set : available_instruction_sets()) {
    FrameBuffer buffer({.width = 32, .height = 16, .color_mode = ColorMode::index, .color_bits = 4});
    Frame frame(buffer);
    MeshData mesh;
    mesh.primitive = Primitive::lines;
    mesh.positions = {2 * 10.703125f / 32 - 1, 1.0f / 16, 0,
                      2 * 14.703125f / 32 - 1, 1.0f / 16, 0};  // on the centre of a row
    mesh.color_indices = {0, 15};
    frame.draw(mesh.view(), unlit({1, 1, 1, 1}));
    Renderer({.threads = 1, .instruction_set = set}).finish(frame);
    const std::vector<std::uint32_t> words = packed_colors(buffer);
    // Pixel i has its centre at i + 0.5: the index there is 15 (i + 0.5 - 10.703125) / 4.
    for (std::size_t i = 10; i < 14; ++i)
      EXPECT_EQ(
          words[7 * 32 + i],
          static_cast<std::uint32_t>(std::floor(15 * (static_cast<double>(i) - 10.203125) / 4 + 0.5)) & 15u)
          << i;
  }
}

std::string refusal(const MeshData& mesh, const DrawState& state) {
  FrameBuffer buffer(format_of(1));
  Frame frame(buffer);
  try {
    frame.draw(mesh.view(), state);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PointsAndLines, InvalidSizesAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float size : {0.0f, -1.0f, nan, infinity}) {
    DrawState state;
    state.point_size = size;
    EXPECT_THAT(refusal(whole_window(), state), AllOf(HasSubstr("point_size is "), HasSubstr("above 0")));
    state = {};
    state.line_width = size;
    EXPECT_THAT(refusal(whole_window(), state), AllOf(HasSubstr("line_width is "), HasSubstr("above 0")));
  }
}

TEST(PointsAndLines, IncompletePrimitivesAreRefused) {
  EXPECT_THAT(refusal(mesh_of(Primitive::lines, {{}, {}, {}}), {}),
              AllOf(HasSubstr("3 vertices"), HasSubstr("lines need a multiple of 2")));
  EXPECT_THAT(refusal(mesh_of(Primitive::line_strip, {{}}), {}),
              AllOf(HasSubstr("1 vertices"), HasSubstr("a line strip needs 2 or more")));
  EXPECT_THAT(refusal(mesh_of(Primitive::line_loop, {{}}), {}), HasSubstr("a line loop needs 2 or more"));
  EXPECT_EQ(refusal(mesh_of(Primitive::points, {{}}), {}), "accepted");
}

TEST(PointsAndLines, NonFiniteOnesAreDropped) {
  Renderer renderer({.threads = 1});
  for (const Primitive primitive : {Primitive::points, Primitive::lines}) {
    MeshData mesh = mesh_of(primitive, {{1000, 1000}, {9000, 2000}, {1000, 5000}, {9000, 7000}});
    mesh.positions[0] = std::numeric_limits<float>::quiet_NaN();
    FrameBuffer buffer(format_of(1));
    Frame frame(buffer);
    frame.draw(mesh.view(), unlit({1, 1, 1, 1}));
    const FrameStats stats = renderer.finish(frame);
    EXPECT_EQ(stats.dropped_non_finite, 1u);
    EXPECT_EQ(stats.binned, primitive == Primitive::points ? 3u : 1u);
  }
}

}  // namespace
}  // namespace tessera::points_lines_test
