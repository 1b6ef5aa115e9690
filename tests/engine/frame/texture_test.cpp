// Textures through the public interface: pictures, errors, and effects that are elided.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/record/texture_state.h"
#include "tests/engine/frame/api_support.h"

namespace tessera {
using namespace detail;
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Random pixels, rows from the top.
struct Pixels {
  int width;
  int height;
  int channels;
  std::vector<std::uint8_t> bytes;

  Pixels(int w, int h, int c, std::uint64_t seed = 1) : width(w), height(h), channels(c) {
    Random random(seed);
    for (int i = 0; i < w * h * c; ++i) bytes.push_back(static_cast<std::uint8_t>(random.next()));
  }
  Pixels(int w, int h, std::initializer_list<std::uint8_t> pixel)
      : width(w), height(h), channels(static_cast<int>(pixel.size())) {
    for (int i = 0; i < w * h; ++i)
      for (const std::uint8_t component : pixel) bytes.push_back(component);
  }
  TextureImage image() const {
    return {.pixels = bytes.data(), .width = width, .height = height, .channels = channels};
  }
  std::uint8_t at(int x, int y_from_top, int c) const {
    return bytes[static_cast<std::size_t>((y_from_top * width + x) * channels + c)];
  }
};

MeshData textured_window(float s1 = 1, float t1 = 1, float z = 0) {
  MeshData mesh = whole_window(z);
  mesh.texcoords = {0, 0, s1, 0, s1, t1, 0, t1};
  return mesh;
}

DrawState replacing(const Texture& texture) {
  DrawState state = unlit({1, 1, 1, 1});
  state.texture = &texture;
  state.texture_env = TextureEnv::replace;
  return state;
}

constexpr TextureSampler kNearest{.mag = TextureFilter::nearest, .min = TextureFilter::nearest};

// Stored pixels of a draw that covers the window: packed A:R:G:B, rows from the top.
std::vector<std::uint32_t> drawn(const MeshData& mesh, const DrawState& state, FrameBufferFormat format,
                                 const RendererOptions& options = {.threads = 1}) {
  FrameBuffer buffer(std::move(format));
  Frame frame(buffer);
  frame.clear(
      {.color = Color{0.25f, 0.5f, 0.75f, buffer.format().alpha_bits > 0 ? 0.5f : 1.0f}, .depth = 1.0});
  frame.draw(mesh.view(), state);
  Renderer(options).finish(frame);
  return packed_colors(buffer);
}

std::string explained(const MeshData& mesh, const DrawState& state,
                      const FrameBufferFormat& format = {.width = 16, .height = 16}) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.draw(mesh.view(), state);
  return frame.explain(0);
}

std::string refused(const TextureImage& image, const TextureSampler& sampler = {}) {
  return error_of([&] { Texture texture(image, sampler); }).value_or("(no error)");
}

// ---- errors

TEST(Texture, InvalidImagesAreRefused) {
  const Pixels pixels(4, 4, 4);
  TextureImage image = pixels.image();
  image.width = 0;
  EXPECT_EQ(refused(image), "Texture: the width is 0 texels, must be 1 to 16384");
  image.width = 4, image.height = -1;
  EXPECT_EQ(refused(image), "Texture: the height is -1 texels, must be 1 to 16384");
  image.height = kMaxTextureSize + 1;
  EXPECT_EQ(refused(image), "Texture: the height is 16385 texels, must be 1 to 16384");
  image.height = 4, image.channels = 5;
  EXPECT_EQ(refused(image), "Texture: the image has 5 channels, must be 1 to 4");
  image.channels = 0;
  EXPECT_EQ(refused(image), "Texture: the image has 0 channels, must be 1 to 4");
  image.channels = 4, image.pixels = nullptr;
  EXPECT_EQ(refused(image), "Texture: the pixels are null, must be 4x4 of them");
  image = pixels.image();
  image.stride_bytes = 15;
  EXPECT_EQ(refused(image), "Texture: the rows are 15 bytes apart, but 16 bytes long");
  image.stride_bytes = -15;
  EXPECT_EQ(refused(image), "Texture: the rows are -15 bytes apart, but 16 bytes long");
  EXPECT_EQ(refused(pixels.image(), {.mag = TextureFilter::linear_mipmap_linear}),
            "Texture: mag is a filter with mipmaps, must be nearest or linear");
}

TEST(Texture, DrawsRefuseUnusableTextures) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  Texture texture(Pixels(2, 2, 3).image());
  MeshData mesh = textured_window();
  DrawState state = replacing(texture);
  state.texture_env_color.g = kNan;
  EXPECT_THAT(
      *error_of([&] { frame.draw(mesh.view(), state); }),
      AllOf(HasSubstr("Frame::draw: texture_env_color"), HasSubstr("nan"), HasSubstr("must be finite")));
  state.texture_env_color.g = 0;
  mesh.texcoords.pop_back();
  EXPECT_THAT(*error_of([&] { frame.draw(mesh.view(), state); }),
              HasSubstr("the mesh has 7 floats of texcoords, its 4 vertices need 8"));
  mesh = textured_window();
  const Texture moved = std::move(texture);
  EXPECT_EQ(*error_of([&] { frame.draw(mesh.view(), state); }), "Frame::draw: the texture was moved from");
  EXPECT_EQ(frame.draw_count(), 0u);
}

TEST(Texture, CanBeMovedBetweenDrawAndFinish) {
  const Pixels pixels(2, 2, 3);
  Texture texture(pixels.image(), kNearest);
  FrameBuffer buffer({.width = 2, .height = 2});
  Frame frame(buffer);
  const MeshData mesh = textured_window();
  frame.draw(mesh.view(), replacing(texture));
  const Texture moved = std::move(texture);
  EXPECT_EQ(moved.width(), 2);
  EXPECT_EQ(moved.channels(), 3);
  Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(packed_colors(buffer)[0] & 0xff, pixels.at(0, 0, 2));
}

// ---- texels

TEST(Texture, NearestShowsEveryTexelForEveryNumberOfChannels) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Pixels pixels(9, 7, channels);
    const Texture texture(pixels.image(), kNearest);
    const std::vector<std::uint32_t> words =
        drawn(textured_window(), replacing(texture), {.width = 9, .height = 7, .alpha_bits = 8});
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) {
        const auto level = [&](int c) { return std::uint32_t{pixels.at(x, y, channels < 3 ? 0 : c)}; };
        const std::uint32_t alpha = channels == 2   ? pixels.at(x, y, 1)
                                    : channels == 4 ? pixels.at(x, y, 3)
                                                    : 255;
        EXPECT_EQ(words[static_cast<std::size_t>(9 * y + x)],
                  alpha << 24 | level(0) << 16 | level(1) << 8 | level(2))
            << channels << " channels, " << x << " " << y;
      }
  }
}

TEST(Texture, RowsMayHaveAnyOrderAndGaps) {
  const Pixels pixels(5, 6, 3);
  const Texture plain(pixels.image(), kNearest);
  const std::vector<std::uint32_t> expected =
      drawn(textured_window(), replacing(plain), {.width = 5, .height = 6});
  std::vector<std::uint8_t> spaced(6 * 20, 77);
  std::vector<std::uint8_t> upwards(6 * 20, 77);
  for (int y = 0; y < 6; ++y)
    for (int i = 0; i < 15; ++i)
      spaced[static_cast<std::size_t>(20 * y + i)] = upwards[static_cast<std::size_t>(20 * (5 - y) + i)] =
          pixels.bytes[static_cast<std::size_t>(15 * y + i)];
  TextureImage image{.pixels = spaced.data(), .width = 5, .height = 6, .channels = 3, .stride_bytes = 20};
  EXPECT_EQ(drawn(textured_window(), replacing(Texture(image, kNearest)), {.width = 5, .height = 6}),
            expected);
  image.pixels = upwards.data();
  image.bottom_row_first = true;
  EXPECT_EQ(drawn(textured_window(), replacing(Texture(image, kNearest)), {.width = 5, .height = 6}),
            expected);
  image.pixels = upwards.data() + 100;
  image.stride_bytes = -20;
  image.bottom_row_first = false;
  EXPECT_EQ(drawn(textured_window(), replacing(Texture(image, kNearest)), {.width = 5, .height = 6}),
            expected);
}

// Mipmaps by definition, in integers: the scale makes the texels of both sizes whole.
std::uint32_t mean_of_cover(const std::vector<std::uint32_t>& from, std::int64_t w, std::int64_t h,
                            std::int64_t next_w, std::int64_t next_h, std::int64_t i, std::int64_t j) {
  std::uint32_t word = 0;
  for (int c = 0; c < 4; ++c) {
    std::int64_t sum = 0;
    for (std::int64_t y = 0; y < h; ++y)
      for (std::int64_t x = 0; x < w; ++x) {
        const std::int64_t across =
            std::max<std::int64_t>(0, std::min((i + 1) * w, (x + 1) * next_w) - std::max(i * w, x * next_w));
        const std::int64_t up =
            std::max<std::int64_t>(0, std::min((j + 1) * h, (y + 1) * next_h) - std::max(j * h, y * next_h));
        sum += across * up * (from[static_cast<std::size_t>(y * w + x)] >> (8 * c) & 0xff);
      }
    word |=
        static_cast<std::uint32_t>(std::floor(static_cast<double>(sum) / static_cast<double>(w * h) + 0.5))
        << (8 * c);
  }
  return word;
}

// Each image is drawn so small that one texel of the level covers one pixel.
TEST(Texture, MipmapsAreMeansOfTheCoveredTexelsForAnySize) {
  constexpr int kSizes[][2] = {{16, 8}, {7, 5}, {33, 17}, {6, 1}, {1, 9}, {12, 10}, {3, 3}};
  for (const auto& [width, height] : kSizes) {
    const Pixels pixels(width, height, 4, 3);
    const Texture texture(pixels.image(),
                          {.mag = TextureFilter::nearest, .min = TextureFilter::nearest_mipmap_nearest});
    std::vector<std::uint32_t> level;  // rows from the bottom
    for (int y = height - 1; y >= 0; --y)
      for (int x = 0; x < width; ++x)
        level.push_back(static_cast<std::uint32_t>(pixels.at(x, y, 0) << 16 | pixels.at(x, y, 1) << 8 |
                                                   pixels.at(x, y, 2)) |
                        static_cast<std::uint32_t>(pixels.at(x, y, 3)) << 24);
    for (int w = width, h = height; w > 1 || h > 1;) {
      const int next_w = std::max(w / 2, 1);
      const int next_h = std::max(h / 2, 1);
      std::vector<std::uint32_t> next;
      for (int j = 0; j < next_h; ++j)
        for (int i = 0; i < next_w; ++i) next.push_back(mean_of_cover(level, w, h, next_w, next_h, i, j));
      level = next;
      w = next_w, h = next_h;
      // The level of detail must round to this level.
      const double detail = std::log2(
          std::max(static_cast<double>(width) / w, height > 1 ? static_cast<double>(height) / h : 0.0));
      int wanted = 0;
      for (int size = std::max(width, height); size > std::max(w, h); size /= 2) ++wanted;
      if (std::abs(detail - wanted) > 0.45) continue;
      const std::vector<std::uint32_t> words =
          drawn(textured_window(), replacing(texture), {.width = w, .height = h, .alpha_bits = 8});
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
          EXPECT_EQ(words[static_cast<std::size_t>(y * w + x)],
                    level[static_cast<std::size_t>((h - 1 - y) * w + x)])
              << width << "x" << height << " as " << w << "x" << h << ", " << x << " " << y;
    }
  }
}

TEST(Texture, OneRowIgnoresT) {
  const Pixels pixels(8, 1, 3);
  for (const TextureFilter filter :
       {TextureFilter::nearest, TextureFilter::linear, TextureFilter::linear_mipmap_linear}) {
    const Texture texture(
        pixels.image(),
        {.mag = filter == TextureFilter::nearest ? filter : TextureFilter::linear, .min = filter});
    EXPECT_EQ(drawn(textured_window(1, 40), replacing(texture), {.width = 16, .height = 16}),
              drawn(textured_window(1, 0), replacing(texture), {.width = 16, .height = 16}));
  }
}

// ---- elided effects

TEST(Texture, OneColorIsFoldedAndMatchesTexels) {
  // The same picture with texels: the second colour lies outside all texture coordinates.
  const Pixels one(1, 1, {200, 100, 50, 128});
  Pixels two(64, 1, {200, 100, 50, 128});
  two.bytes[4 * 63] = 0;
  const Texture folded(one.image(), kNearest);
  const Texture sampled(two.image(), kNearest);
  MeshData mesh = textured_window(0.5f, 0.5f);
  mesh.normals = {0, 0, 1, 0.6f, 0, 0.8f, 0, 0, 1, 0, 0.6f, 0.8f};
  mesh.colors = {1, 0, 0, 1, 0, 1, 0, 0.5f, 0.2f, 0.9f, 1, 0.25f, 1, 1, 1, 1};
  for (const TextureEnv env :
       {TextureEnv::modulate, TextureEnv::replace, TextureEnv::decal, TextureEnv::blend, TextureEnv::add})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
      for (const bool lit : {false, true})
        for (const bool blends : {false, true})
          for (const int samples : {1, 4}) {
            DrawState state;
            state.lighting = lit;
            state.shading = shading;
            state.color_material = ColorMaterial::ambient_and_diffuse;
            state.texture_env = env;
            state.texture_env_color = {0.9f, 0.1f, 2.0f, 0.5f};
            if (blends) state.blend = BlendState{};
            state.texture = &folded;
            const FrameBufferFormat format{.width = 20, .height = 20, .samples = samples};
            const std::vector<std::uint32_t> a = drawn(mesh, state, format);
            EXPECT_THAT(explained(mesh, state, format), HasSubstr("one colour"));
            state.texture = &sampled;
            const std::vector<std::uint32_t> b = drawn(mesh, state, format);
            EXPECT_THAT(explained(mesh, state, format), HasSubstr("texture: 64 x 1, 4 channels"));
            for (std::size_t i = 0; i < a.size(); ++i)
              for (int shift = 0; shift < 24; shift += 8) {
                const int apart =
                    std::abs(static_cast<int>(a[i] >> shift & 0xff) - static_cast<int>(b[i] >> shift & 0xff));
                ASSERT_LE(apart, 1) << "env " << static_cast<int>(env) << ", shading "
                                    << static_cast<int>(shading) << ", lit " << lit << ", blends " << blends
                                    << ", samples " << samples << ", pixel " << i;
              }
          }
}

TEST(Texture, TexturesWithoutEffectAreElided) {
  const Pixels white(4, 4, {255, 255, 255});
  const Pixels black(4, 4, {0, 0, 0});
  const Pixels clear(4, 4, {9, 8, 7, 0});
  const Pixels veil(4, 4, {255, 255, 255, 128});
  const MeshData mesh = textured_window();
  DrawState state;
  const auto explain = [&](const Pixels& pixels, TextureEnv env) {
    const Texture texture(pixels.image());
    state.texture = &texture;
    state.texture_env = env;
    return explained(mesh, state);
  };
  constexpr const char* kNothing = "texture: skipped, its one colour changes nothing";
  EXPECT_THAT(explain(white, TextureEnv::modulate), HasSubstr(kNothing));
  EXPECT_THAT(explain(black, TextureEnv::add), HasSubstr(kNothing));
  EXPECT_THAT(explain(black, TextureEnv::blend), HasSubstr(kNothing));
  EXPECT_THAT(explain(clear, TextureEnv::decal), HasSubstr(kNothing));
  EXPECT_THAT(explain(veil, TextureEnv::modulate), HasSubstr(kNothing)) << "alpha is not used";
  EXPECT_THAT(explain(white, TextureEnv::replace), HasSubstr("folded"));
  EXPECT_THAT(explain(black, TextureEnv::modulate), HasSubstr("folded"));
  state.alpha_test = AlphaTest{};
  EXPECT_THAT(explain(veil, TextureEnv::modulate), HasSubstr("folded")) << "an alpha test uses alpha";
  state.alpha_test.reset();
  state.blend = BlendState{};
  EXPECT_THAT(explain(veil, TextureEnv::modulate), HasSubstr("folded")) << "blending uses alpha";
}

TEST(Texture, TextureIsElidedWithoutColorOutput) {
  const Pixels pixels(4, 4, 4);
  const Pixels opaque(4, 4, 3);
  const Texture texture(pixels.image());
  const Texture without_alpha(opaque.image());
  DrawState state;
  state.texture = &texture;
  state.color_mask = {false, false, false, false};
  EXPECT_THAT(explained(textured_window(), state), HasSubstr("texture: skipped"));
  state.alpha_test = AlphaTest{};
  EXPECT_THAT(explained(textured_window(), state),
              AllOf(HasSubstr("texture: 4 x 4"), Not(HasSubstr("texture: skipped"))));
  state.texture = &without_alpha;
  EXPECT_THAT(explained(textured_window(), state), HasSubstr("texture: skipped"));
  state = {};
  state.texture = &texture;
  state.lighting = false;
  MeshData mesh = textured_window();
  mesh.color_indices = {1, 2, 3, 4};
  EXPECT_THAT(
      explained(mesh, state, {.width = 16, .height = 16, .color_mode = ColorMode::index, .color_bits = 8}),
      HasSubstr("texture: skipped"));
}

// s and t are 0 everywhere: the texel at the origin; with a linear filter, the mean of the four around that
// corner.
TEST(Texture, WithoutCoordinatesTheOriginIsShown) {
  const Pixels pixels(3, 4, 4);
  for (const TextureFilter mag : {TextureFilter::nearest, TextureFilter::linear})
    for (const TextureWrap wrap :
         {TextureWrap::repeat, TextureWrap::clamp_to_edge, TextureWrap::mirrored_repeat}) {
      const Texture texture(
          pixels.image(),
          {.mag = mag, .min = TextureFilter::linear_mipmap_linear, .wrap_s = wrap, .wrap_t = wrap});
      const FrameBufferFormat format{.width = 4, .height = 4, .alpha_bits = 8};
      MeshData mesh = whole_window();
      const std::vector<std::uint32_t> folded = drawn(mesh, replacing(texture), format);
      EXPECT_THAT(explained(mesh, replacing(texture)), HasSubstr("no texture coordinates"));
      mesh.texcoords.assign(8, 0.0f);
      EXPECT_EQ(folded, drawn(mesh, replacing(texture), format));
    }
}

// ---- combinations

TEST(Texture, AlphaTestsUseTexelAlpha) {
  Pixels pixels(4, 1, {255, 255, 255, 0});
  for (std::size_t i = 0; i < 4; ++i) pixels.bytes[4 * i + 3] = static_cast<std::uint8_t>(85 * i);
  const Texture texture(pixels.image(), kNearest);
  for (const bool writes_color : {true, false})
    for (const int samples : {1, 4}) {
      FrameBuffer buffer({.width = 4, .height = 4, .samples = samples});
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      DrawState state = replacing(texture);
      state.alpha_test = AlphaTest{.func = Compare::gequal, .ref = 1};
      if (!writes_color) state.color_mask = {false, false, false, false};
      const MeshData mesh = textured_window();
      frame.draw(mesh.view(), state);
      Renderer({.threads = 1}).finish(frame);
      const std::vector<std::uint32_t> depths = stored_depths(buffer);
      const std::vector<std::uint32_t> colors = packed_colors(buffer);
      for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(depths[i] != 0xffffff, i % 4 == 3) << i;
        EXPECT_EQ(colors[i] != 0, writes_color && i % 4 == 3) << i;
      }
    }
}

TEST(Texture, LevelsEqualThemselvesInAlphaTests) {
  for (const bool one_color : {true, false})
    for (int level = 0; level < 256; ++level) {
      Pixels pixels(2, 1, {255, 255, 255, static_cast<std::uint8_t>(level)});
      if (!one_color) pixels.bytes[0] = 7;
      const Texture texture(pixels.image(), one_color ? TextureSampler{} : kNearest);
      DrawState state = replacing(texture);
      state.alpha_test = AlphaTest{.func = Compare::equal, .ref = static_cast<float>(level) / 255.0f};
      state.color_mask = {false, true, false, false};
      const std::vector<std::uint32_t> words = drawn(textured_window(), state, {.width = 4, .height = 4});
      EXPECT_TRUE(std::all_of(words.begin(), words.end(),
                              [](std::uint32_t word) { return (word >> 8 & 255) == 255; }))
          << level << ", one colour " << one_color;
    }
}

TEST(Texture, OddCoordinatesDropTheirTriangles) {
  const Pixels pixels(4, 4, 3);
  const Texture texture(pixels.image());
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  MeshData mesh = textured_window();
  mesh.texcoords[2] = kNan;  // vertex 1 belongs to the first triangle only
  frame.draw(mesh.view(), replacing(texture));
  EXPECT_EQ(Renderer({.threads = 1}).finish(frame).dropped_non_finite, 1u);
}

// Perspective, minification, clipping and all operations: the same bits for any number of threads, tile size,
// instruction set and shading time.
TEST(Texture, BitsDoNotDependOnRendererOptions) {
  Random random(8);
  MeshData mesh;
  for (int i = 0; i < 300; ++i) {
    const float size = i % 10 == 0 ? 5.0f : 0.5f;
    const float center[3] = {random.between(-3, 3), random.between(-2, 2), random.between(-8, 0)};
    for (int k = 0; k < 3; ++k) {
      for (const float c : center) mesh.positions.push_back(c + random.between(-size, size));
      for (int c = 0; c < 3; ++c) mesh.normals.push_back(random.between(-1, 1));
      for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
      for (int c = 0; c < 2; ++c) mesh.texcoords.push_back(random.between(-4, 4));
    }
  }
  const Pixels grey(17, 9, 2, 4);
  const Pixels rgb(64, 64, 3, 5);
  const Pixels rgba(16, 32, 4, 6);
  const Texture textures[] = {Texture(rgb.image()),
                              Texture(grey.image(), {.mag = TextureFilter::nearest,
                                                     .min = TextureFilter::linear_mipmap_nearest,
                                                     .wrap_s = TextureWrap::mirrored_repeat}),
                              Texture(rgba.image(), {.mag = TextureFilter::linear,
                                                     .min = TextureFilter::nearest_mipmap_linear,
                                                     .wrap_t = TextureWrap::clamp_to_edge})};
  for (const int samples : {1, 4, 8}) {
    const auto record = [&](Frame& frame) {
      frame.clear({.color = Color{0.1f, 0.2f, 0.3f, 1}, .depth = 1.0, .stencil = 0u});
      frame.set_camera({.projection = perspective(60, 1.5, 0.5, 9)});
      for (int i = 0; i < 18; ++i) {
        DrawState state;
        state.texture = &textures[i % 3];
        state.texture_env = static_cast<TextureEnv>(i % 5);
        state.texture_env_color = {0.3f, 0.9f, 0.1f, 1};
        state.shading = static_cast<Shading>(i / 3 % 3);
        state.lighting = i % 4 != 0;
        state.color_material = i % 2 == 0 ? ColorMaterial::diffuse : ColorMaterial::none;
        if (i % 6 == 1) state.blend = BlendState{};
        if (i % 6 == 3) state.alpha_test = AlphaTest{};
        if (i % 6 == 4) state.stencil = StencilState{.front = {.zpass = StencilOp::incr}};
        if (i == 17) state.plane_mask = 0x0f0f0fu;
        state.transform = rotate(20.0 * i, 0, 0, 1);
        frame.draw(mesh.view(), state);
      }
    };
    const auto print = [&](const RendererOptions& options) {
      FrameBuffer buffer({.width = 150, .height = 100, .samples = samples});
      Frame frame(buffer);
      record(frame);
      Renderer(options).finish(frame);
      return fingerprint(buffer);
    };
    const Fingerprint expected =
        print({.threads = 1, .tile_size = 32, .instruction_set = InstructionSet::scalar});
    for (const InstructionSet set : available_instruction_sets())
      for (const int tile_size : {32, 64, 128})
        EXPECT_EQ(print({.threads = 2, .tile_size = tile_size, .instruction_set = set}), expected)
            << name(set) << ", tiles of " << tile_size << ", " << samples << " samples";
    EXPECT_EQ(print({.debug = {.defer_shading = false}}), expected) << samples << " samples";
  }
}

TEST(Texture, CapturesAndCountsFollowTheAlphaTest) {
  Pixels pixels(2, 1, {255, 255, 255, 0});
  pixels.bytes[7] = 255;
  const Texture texture(pixels.image(), kNearest);
  FrameBuffer buffer({.width = 4, .height = 2});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  DrawState state = replacing(texture);
  state.alpha_test = AlphaTest{};
  const MeshData mesh = textured_window();
  frame.draw(mesh.view(), state);
  std::vector<std::uint32_t> draw_ids(8);
  std::vector<float> normals(24);
  frame.capture({.draw_ids = draw_ids, .normals = normals});
  const FrameStats stats = Renderer({.threads = 1, .debug = {.count_fragments = true}}).finish(frame);
  EXPECT_EQ(stats.fragments, 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(draw_ids[i], i % 4 < 2 ? Capture::kNothing : 0u) << i;
    EXPECT_EQ(normals[3 * i + 2], i % 4 < 2 ? 0.0f : 1.0f) << i;
  }
}

}  // namespace
}  // namespace tessera
