// Quality: draws under a cap equal draws that ask for less; affine interpolation and normals as they are
// equal a computation in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"
#include "tests/engine/frame/texture_support.h"

namespace tessera::quality_test {
namespace {

using namespace test;

/// Triangles of all sizes with normals and colours, under lights of three kinds.
struct CappedFrame {
  FrameBufferFormat format;
  MeshData mesh;
  std::vector<Light> lights{3};

  explicit CappedFrame(FrameBufferFormat f) : format(std::move(f)) {
    Random random(5);
    for (int i = 0; i < 120; ++i) {
      const float size = i % 4 == 0 ? 2.0f : 0.3f;
      const float center[3] = {random.between(-2, 2), random.between(-2, 2), random.between(-5, -1)};
      for (int k = 0; k < 3; ++k) {
        for (const float c : center) mesh.positions.push_back(c + random.between(-size, size));
        for (int c = 0; c < 3; ++c) mesh.normals.push_back(random.between(-1, 1));
        for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
      }
    }
    lights[1].position = {1, 2, 0, 1};
    lights[1].attenuation_linear = 0.2f;
    lights[2].position = {0, 0, 2, 1};
    lights[2].spot_cutoff = 60;
  }

  Fingerprint drawn(const Quality& quality, Shading shading, bool local_viewer,
                    bool has_operations = false) const {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.set_camera({.projection = perspective(70, 1.3, 0.5, 10)});
    frame.set_lights(lights);
    frame.set_light_model({.local_viewer = local_viewer, .two_sided = true});
    frame.set_quality(quality);
    DrawState state;
    state.material.specular = {0.8f, 0.7f, 0.6f, 1};
    state.material.shininess = 9;
    state.shading = shading;
    state.color_material = ColorMaterial::diffuse;
    if (has_operations) {
      state.blend = BlendState{};
      state.alpha_test = AlphaTest{.ref = 0.2f};
    }
    frame.draw(mesh.view(), state);
    Renderer({.threads = 1}).finish(frame);
    return fingerprint(buffer);
  }
};

std::vector<FrameBufferFormat> capped_formats() {
  std::vector<FrameBufferFormat> formats(3, {.width = 120, .height = 90});
  formats[1].samples = 4;
  formats[2].color_mode = ColorMode::index;
  formats[2].color_bits = 8;
  return formats;
}

TEST(Quality, CapsNothingByDefault) {
  for (const FrameBufferFormat& format : capped_formats()) {
    const CappedFrame scene(format);
    FrameBuffer buffer(format);
    Frame frame(buffer);
    frame.draw(scene.mesh.view(), {.shading = Shading::phong});
    const std::vector<EffectNote> plain = frame.effects(0);
    frame.set_quality({});
    frame.draw(scene.mesh.view(), {.shading = Shading::phong});
    EXPECT_EQ(frame.effects(1), plain);
  }
}

TEST(Quality, ShadingUnderACapEqualsShadingThatAsksForLess) {
  constexpr Shading kAll[] = {Shading::flat, Shading::gouraud, Shading::phong};
  for (const FrameBufferFormat& format : capped_formats()) {
    const CappedFrame scene(format);
    const bool has_operations[] = {false, format.color_mode == ColorMode::rgb};
    for (const bool operations : has_operations)
      for (const Shading asked : kAll)
        for (const auto& [cap, highest] :
             {std::pair(ShadingCap::gouraud, Shading::gouraud), std::pair(ShadingCap::flat, Shading::flat)}) {
          EXPECT_EQ(scene.drawn({.shading = cap}, asked, true, operations),
                    scene.drawn({}, std::min(asked, highest), true, operations))
              << static_cast<int>(asked) << " under " << static_cast<int>(cap);
        }
    EXPECT_NE(scene.drawn({.shading = ShadingCap::gouraud}, Shading::phong, true),
              scene.drawn({}, Shading::phong, true));
  }
}

TEST(Quality, AnInfiniteViewerEqualsALightModelWithoutLocalViewer) {
  for (const FrameBufferFormat& format : capped_formats()) {
    const CappedFrame scene(format);
    for (const Shading shading : {Shading::gouraud, Shading::phong}) {
      const Fingerprint capped = scene.drawn({.viewer = ViewerCap::infinite}, shading, true);
      EXPECT_EQ(capped, scene.drawn({}, shading, false));
      EXPECT_NE(capped, scene.drawn({}, shading, true));
    }
  }
}

TEST(Quality, CapsHoldForTheDrawsThatFollow) {
  FrameBuffer buffer({.width = 16, .height = 16});
  Frame frame(buffer);
  const MeshData mesh = whole_window();
  const auto reason_of_shading = [&](std::size_t draw) {
    for (const EffectNote& note : frame.effects(draw))
      if (note.effect == Effect::shading) return note.reason;
    return EffectReason::requested;
  };
  DrawState state{.shading = Shading::phong};
  state.color_material = ColorMaterial::none;
  frame.set_lights({Light{.position = {0, 0, 1, 1}}});
  frame.draw(mesh.view(), state);
  frame.set_quality({.shading = ShadingCap::gouraud});
  frame.draw(mesh.view(), state);
  frame.set_quality({});
  frame.draw(mesh.view(), state);
  EXPECT_EQ(reason_of_shading(0), EffectReason::per_pixel);
  EXPECT_EQ(reason_of_shading(1), EffectReason::interpolated);
  EXPECT_EQ(reason_of_shading(2), EffectReason::per_pixel);
}

TEST(Quality, TexturesUnderACapEqualTexturesThatAskForLess) {
  const Pixels pixels(37, 21, 4);
  const auto shown = [&](const TextureSampler& sampler, const Quality& quality, bool has_texcoords) {
    const Texture texture(pixels.image(), sampler);
    MeshData mesh = textured_window(3.3f, 4.7f);
    if (!has_texcoords) mesh.texcoords.clear();
    FrameBuffer buffer({.width = 90, .height = 70});
    Frame frame(buffer);
    frame.clear({.color = Color{0.2f, 0.4f, 0.6f, 1}, .depth = 1.0});
    frame.set_camera({.view = rotate(50, 1, 0, 0), .projection = perspective(90, 1, 0.1, 10)});
    frame.set_quality(quality);
    DrawState state = replacing(texture);
    state.transform = translate(0, 0, -1.2);
    frame.draw(mesh.view(), state);
    Renderer({.threads = 1}).finish(frame);
    return packed_colors(buffer);
  };
  using enum TextureFilter;
  for (const TextureFilter mag : {nearest, linear})
    for (const TextureFilter min : {nearest, linear, nearest_mipmap_nearest, linear_mipmap_nearest,
                                    nearest_mipmap_linear, linear_mipmap_linear})
      for (const bool has_texcoords : {true, false}) {
        const bool is_nearest =
            min == nearest || min == nearest_mipmap_nearest || min == nearest_mipmap_linear;
        const TextureSampler asked{.mag = mag, .min = min, .wrap_t = TextureWrap::mirrored_repeat};
        TextureSampler bilinear = asked, closest = asked;
        bilinear.min = is_nearest ? nearest : linear;
        closest.mag = closest.min = nearest;
        EXPECT_EQ(shown(asked, {.texture = TextureCap::bilinear}, has_texcoords),
                  shown(bilinear, {}, has_texcoords));
        EXPECT_EQ(shown(asked, {.texture = TextureCap::nearest}, has_texcoords),
                  shown(closest, {}, has_texcoords));
      }
}

// ---- affine interpolation and normals as they are, against double ----

constexpr int kSide = 64;

/// Stored r g b of a draw that is unlit or lit, one triangle in clip coordinates x y z w.
std::vector<std::array<int, 3>> drawn_levels(const MeshData& mesh, const DrawState& state,
                                             const Quality& quality, const std::vector<Light>& lights = {},
                                             std::vector<std::uint32_t>* depths = nullptr) {
  FrameBuffer buffer({.width = kSide, .height = kSide});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.set_lights(lights);
  frame.set_light_model({.ambient = {0, 0, 0, 1}});
  frame.set_quality(quality);
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1}).finish(frame);
  if (depths != nullptr) *depths = stored_depths(buffer);
  std::vector<std::array<int, 3>> levels;
  for (const std::uint32_t word : packed_colors(buffer))
    levels.push_back({static_cast<int>(word >> 16 & 255), static_cast<int>(word >> 8 & 255),
                      static_cast<int>(word & 255)});
  return levels;
}

/// A triangle whose corners have window coordinates in eighths of a pixel, which are snapped exactly.
struct WindowCorners {
  double x[3], y[3];

  /// Barycentric coordinates of the centre of the pixel in raster row `row`. Negative outside.
  std::array<double, 3> at(int column, int row) const { return at_point(column + 0.5, kSide - row - 0.5); }
  std::array<double, 3> at_point(double px, double py) const {
    const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    const double area = cross(x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]);
    const double b1 = cross(px - x[0], py - y[0], x[2] - x[0], y[2] - y[0]) / area;
    const double b2 = cross(x[1] - x[0], y[1] - y[0], px - x[0], py - y[0]) / area;
    return {1 - b1 - b2, b1, b2};
  }
  bool contains(const std::array<double, 3>& b) const { return *std::min_element(b.begin(), b.end()) > 1e-9; }
  static double clip(double window) { return window / (kSide / 2.0) - 1; }
};
constexpr WindowCorners kCorners{{2.5, 61.25, 20.125}, {3.25, 10.5, 60.75}};

TEST(Quality, AffineInterpolationIsLinearInTheWindow) {
  const double w[3] = {1, 8, 2};
  MeshData mesh;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double c : {WindowCorners::clip(kCorners.x[k]) * w[k],
                           WindowCorners::clip(kCorners.y[k]) * w[k], 0.25 * w[k], w[k]})
      mesh.positions.push_back(static_cast<float>(c));
  mesh.position_components = 4;
  const float colors[3][3] = {{0, 1, 0.25f}, {1, 0.5f, 0.75f}, {0.125f, 0, 1}};
  for (const auto& color : colors) mesh.colors.insert(mesh.colors.end(), {color[0], color[1], color[2], 1});
  DrawState state;
  state.lighting = false;
  std::vector<std::uint32_t> affine_depths, depths;
  const auto affine =
      drawn_levels(mesh, state, {.interpolation = InterpolationCap::affine}, {}, &affine_depths);
  const auto perspective = drawn_levels(mesh, state, {}, {}, &depths);
  EXPECT_EQ(affine_depths, depths);
  int inside = 0;
  double largest_difference = 0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const std::array<double, 3> b = kCorners.at(column, row);
      if (!kCorners.contains(b)) continue;
      ++inside;
      const auto pixel = static_cast<std::size_t>(row * kSide + column);
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = 255 * (b[0] * colors[0][c] + b[1] * colors[1][c] + b[2] * colors[2][c]);
        ASSERT_NEAR(affine[pixel][c], expected, 0.501) << column << " " << row;
        largest_difference = std::max(largest_difference, std::abs(perspective[pixel][c] - expected));
      }
    }
  EXPECT_GT(inside, 800);
  EXPECT_GT(largest_difference, 40) << "perspective would give the same picture";
}

TEST(Quality, AffineTextureCoordinatesAreLinearInTheWindow) {
  // A ramp over 256 texels, magnified: its linear filter is a linear function of s.
  std::vector<std::uint8_t> ramp(256);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::uint8_t>(i);
  const Texture texture({.pixels = ramp.data(), .width = 256, .height = 1, .channels = 1},
                        {.min = TextureFilter::linear, .wrap_s = TextureWrap::clamp_to_edge});
  const double w[3] = {1, 6, 3};
  const double s[3] = {0.1, 0.9, 0.4};
  MeshData mesh;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double c :
         {WindowCorners::clip(kCorners.x[k]) * w[k], WindowCorners::clip(kCorners.y[k]) * w[k], 0.0, w[k]})
      mesh.positions.push_back(static_cast<float>(c));
    mesh.texcoords.insert(mesh.texcoords.end(), {static_cast<float>(s[k]), 0.5f});
  }
  mesh.position_components = 4;
  const auto levels = drawn_levels(mesh, replacing(texture), {.interpolation = InterpolationCap::affine});
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const std::array<double, 3> b = kCorners.at(column, row);
      if (!kCorners.contains(b)) continue;
      const double expected = 256 * (b[0] * s[0] + b[1] * s[1] + b[2] * s[2]) - 0.5;
      ASSERT_NEAR(levels[static_cast<std::size_t>(row * kSide + column)][0], expected, 0.52);
    }
}

/// The triangle with normals (nx, ny, nz) at its corners, in clip space z = 0.
MeshData triangle_with_normals(const double (&normals)[3][3]) {
  MeshData mesh;
  for (std::size_t k = 0; k < 3; ++k) {
    mesh.positions.insert(mesh.positions.end(), {static_cast<float>(WindowCorners::clip(kCorners.x[k])),
                                                 static_cast<float>(WindowCorners::clip(kCorners.y[k])), 0});
    for (const double c : normals[k]) mesh.normals.push_back(static_cast<float>(c));
  }
  return mesh;
}

TEST(Quality, NormalsAreUsedAsTheyAreWithoutRenormalization) {
  const double normals[3][3] = {{0.9, 0, 0.3}, {-0.8, 0.1, 0.5}, {0, 0.7, 0.7}};
  MeshData mesh = triangle_with_normals(normals);
  for (float& c : mesh.positions) c /= 2;
  Light light;  // along +z: the colour is the z of the normal
  light.specular = {0, 0, 0, 1};
  for (const bool normalize : {false, true}) {
    DrawState state;
    state.shading = Shading::phong;
    state.normalize = normalize;
    state.transform = scale(2, 2, 2);  // halves normals that keep their length
    state.material.ambient = {0, 0, 0, 1};
    state.material.diffuse = {1, 1, 1, 1};
    const auto levels = drawn_levels(mesh, state, {.renormalize = false}, {light});
    const auto renormalized = drawn_levels(mesh, state, {}, {light});
    double z[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = std::sqrt(normals[k][0] * normals[k][0] + normals[k][1] * normals[k][1] +
                                      normals[k][2] * normals[k][2]);
      z[k] = normals[k][2] / (normalize ? length : 2);
    }
    int largest = 0;
    for (int row = 0; row < kSide; ++row)
      for (int column = 0; column < kSide; ++column) {
        const std::array<double, 3> b = kCorners.at(column, row);
        if (!kCorners.contains(b)) continue;
        const auto pixel = static_cast<std::size_t>(row * kSide + column);
        ASSERT_NEAR(levels[pixel][0], 255 * (b[0] * z[0] + b[1] * z[1] + b[2] * z[2]), 0.501);
        largest = std::max(largest, std::abs(levels[pixel][0] - renormalized[pixel][0]));
      }
    EXPECT_GT(largest, 20) << "renormalized normals would give the same picture";
  }
}

}  // namespace
}  // namespace tessera::quality_test
