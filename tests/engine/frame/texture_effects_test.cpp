// Effects of textures in a draw: texturing that is folded or elided, alpha tests, odd coordinates, captures,
// and pictures that do not depend on renderer options.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/engine/frame/texture_support.h"

namespace tessera::texture_effects_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(TextureEffects, OneColorIsFoldedAndMatchesTexels) {
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

TEST(TextureEffects, TexturesWithoutEffectAreElided) {
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

TEST(TextureEffects, TextureIsElidedWithoutColorOutput) {
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

// s and t are 0 everywhere. This shows the texel at the origin or, with a linear filter, the mean of the four
// texels around that corner.
TEST(TextureEffects, WithoutCoordinatesTheOriginIsShown) {
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

TEST(TextureEffects, AlphaTestsUseTexelAlpha) {
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

TEST(TextureEffects, LevelsEqualThemselvesInAlphaTests) {
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

TEST(TextureEffects, OddCoordinatesDropTheirTriangles) {
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
TEST(TextureEffects, BitsDoNotDependOnRendererOptions) {
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
  const Pixels gray(17, 9, 2, 4);
  const Pixels rgb(64, 64, 3, 5);
  const Pixels rgba(16, 32, 4, 6);
  const Texture textures[] = {Texture(rgb.image()),
                              Texture(gray.image(), {.mag = TextureFilter::nearest,
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

TEST(TextureEffects, CapturesAndCountsFollowTheAlphaTest) {
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
}  // namespace tessera::texture_effects_test
