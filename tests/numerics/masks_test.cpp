// Write masks, plane by plane: for any draw and format exactly the bits of the mask change, to the values
// they would have without a mask.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/engine/frame/pixel_support.h"
#include "tests/numerics/color_components.h"

namespace tessera::test::masks_test {
namespace {

constexpr int kWidth = 40, kHeight = 24;

struct Kind {
  const char* name;
  bool covers_all;  ///< covers every sample of every pixel
  std::function<void(Frame&, const FragmentState&)> draw;
};

MeshData with_colors(MeshData mesh) {
  Random random(12);
  for (std::size_t v = 0; v < mesh.positions.size() / 3; ++v) {
    for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
    mesh.color_indices.push_back(random.between(0, 255));
    for (int c = 0; c < 2; ++c) mesh.texcoords.push_back(random.between(0, 3));
  }
  return mesh;
}

// The data they borrow is static.
std::vector<Kind> kinds() {
  // A single triangle: two triangles of different colours would leave a mean at pixels that both partially
  // cover.
  static const MeshData window =
      with_colors({.positions = {-1, -1, 0.2f, 3, -1, 0.2f, -1, 3, 0.2f}, .indices = {0, 1, 2}});
  static const MeshData corners = with_colors(rectangle(-0.7f, -0.8f, 0.9f, 0.6f));
  static const std::vector<std::uint8_t> bytes = [] {
    std::vector<std::uint8_t> all;
    Random random(13);
    for (int i = 0; i < 4 * kWidth * kHeight; ++i) all.push_back(static_cast<std::uint8_t>(random.next()));
    return all;
  }();
  static const Texture texture({.pixels = bytes.data(), .width = 16, .height = 8});
  const auto mesh = [](const MeshData& data, Primitive primitive,
                       const std::function<void(DrawState&)>& change) {
    return [&data, primitive, change](Frame& frame, const FragmentState& fragments) {
      DrawState state = draw_state(fragments);
      state.lighting = false;
      state.point_size = state.line_width = 5;
      change(state);
      Mesh view = data.view();
      view.primitive = primitive;
      if (primitive != Primitive::triangles) view.indices = {};
      frame.draw(view, state);
    };
  };
  return {
      {"one colour", true,
       [](Frame& frame, const FragmentState& fragments) {
         static const MeshData plain = whole_window(0.2f);
         DrawState state = draw_state(fragments);
         state.lighting = false;
         state.material.diffuse = {0.37f, 0.81f, 0.55f, 0.63f};
         frame.draw(plain.view(), state);
       }},
      {"interpolated", true, mesh(window, Primitive::triangles, [](DrawState&) {})},
      {"flat", true, mesh(window, Primitive::triangles, [](DrawState& s) { s.shading = Shading::flat; })},
      {"lit at each pixel", true,
       mesh(window, Primitive::triangles,
            [](DrawState& s) {
              s.lighting = true;
              s.shading = Shading::phong;
              s.color_material = ColorMaterial::ambient_and_diffuse;
              s.material.index_ramp = {{3, 99, 200}};
            })},
      {"textured", true, mesh(window, Primitive::triangles, [](DrawState& s) { s.texture = &texture; })},
      {"a part", false, mesh(corners, Primitive::triangles, [](DrawState&) {})},
      {"lines", false, mesh(corners, Primitive::line_loop, [](DrawState&) {})},
      {"points", false, mesh(corners, Primitive::points, [](DrawState&) {})},
      {"outlines", false,
       mesh(corners, Primitive::quads, [](DrawState& s) { s.front_mode = PolygonMode::line; })},
      {"bitmap", false,
       [](Frame& frame, const FragmentState& fragments) {
         frame.draw_bitmap(
             {.bits = bytes.data(), .width = kWidth, .height = kHeight, .color = {0.3f, 0.7f, 0.1f, 0.2f}},
             fragments);
       }},
      {"image", true, [](Frame& frame, const FragmentState& fragments) {
         frame.draw_image({.pixels = bytes.data(), .width = kWidth, .height = kHeight}, fragments);
       }}};
}

std::vector<FrameBufferFormat> formats() {
  std::vector<FrameBufferFormat> all;
  const auto add = [&](ColorMode mode, int bits, int alpha_bits, Dither dither, int samples) {
    all.push_back({.width = kWidth,
                   .height = kHeight,
                   .color_mode = mode,
                   .color_bits = bits,
                   .alpha_bits = alpha_bits,
                   .dither = dither,
                   .samples = samples});
  };
  for (const int bits : {1, 2, 3, 8, 15, 16, 24})
    add(ColorMode::rgb, bits, bits % 2 == 0 ? 8 : 0, bits == 8 || bits == 15 ? Dither::bayer4 : Dither::none,
        1);
  for (const int bits : {1, 4, 8, 24})
    add(ColorMode::index, bits, 0, bits == 4 ? Dither::bayer2 : Dither::none, 1);
  add(ColorMode::rgb, 24, 8, Dither::none, 4);
  add(ColorMode::rgb, 13, 0, Dither::bayer8, 8);
  return all;
}

/// Buffer contents after a background and a draw over it.
struct Buffers {
  std::vector<std::uint32_t> words;
  std::vector<std::uint32_t> depths;
};
Buffers run(const FrameBufferFormat& format, const std::function<void(Frame&)>& draw) {
  static Renderer renderer({.threads = 1});
  static const std::vector<std::uint8_t> background = [] {
    std::vector<std::uint8_t> all;
    Random random(14);
    for (int i = 0; i < 4 * kWidth * kHeight; ++i) all.push_back(static_cast<std::uint8_t>(random.next()));
    return all;
  }();
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.draw_image({.pixels = background.data(), .width = kWidth, .height = kHeight},
                   {.depth = {.enabled = false}});
  renderer.finish(frame);  // Ends the frame, so that all samples of a pixel start with the same packed color.
  draw(frame);
  renderer.finish(frame);
  return {packed_colors(buffer), stored_depths(buffer)};
}

// Operations that read the stored colour respect the masks like all others.
std::vector<FragmentState> operations(const FrameBufferFormat& format) {
  std::vector<FragmentState> all(2);
  all[1].logic_op = LogicOp::bit_xor;
  if (format.color_mode == ColorMode::rgb) all.emplace_back().blend.emplace();
  return all;
}

TEST(Masks, ChangeOnlyTheBitsOfTheirPlanes) {
  for (const FrameBufferFormat& format : formats())
    for (const Kind& kind : kinds()) {
      // A mean of samples with preserved bits does not preserve those bits.
      if (format.samples > 1 && !kind.covers_all) continue;
      for (const FragmentState& operation : operations(format)) {
        SCOPED_TRACE(std::string(kind.name) + ", " + describe(format) + (operation.blend ? ", blended" : "") +
                     (operation.logic_op != LogicOp::copy ? ", xor" : ""));
        const Buffers before = run(format, [](Frame&) {});
        const Buffers full = run(format, [&](Frame& frame) { kind.draw(frame, operation); });
        const int planes = format.color_bits + format.alpha_bits;
        const bool all_or_none = format.color_mode == ColorMode::index || format.color_bits <= 2;
        Random random(15);
        for (int turn = 0; turn < planes + 6; ++turn) {
          FragmentState masked = operation;
          if (turn < planes) masked.plane_mask = 1u << turn;
          else masked.plane_mask = turn == planes ? 0 : random.next();
          if (turn > planes + 1) {
            const bool red = turn % 2 == 0;
            masked.color_mask = {red, all_or_none ? red : random.next() % 2 == 0,
                                 all_or_none ? red : random.next() % 2 == 0, random.next() % 2 == 0};
          }
          std::uint32_t mask = 0;
          const ComponentBits split(format);
          for (std::size_t c = 0; c < 4; ++c)
            if (masked.color_mask[c] && (format.color_mode == ColorMode::rgb || c == 3))
              mask |= static_cast<std::uint32_t>(split.levels(c)) << split.shift[c];
          if (format.color_mode == ColorMode::index)
            mask = masked.color_mask[0] ? (1u << format.color_bits) - 1 : 0;
          mask &= masked.plane_mask;
          const Buffers after = run(format, [&](Frame& frame) { kind.draw(frame, masked); });
          for (std::size_t i = 0; i < after.words.size(); ++i)
            ASSERT_EQ(after.words[i], (before.words[i] & ~mask) | (full.words[i] & mask))
                << std::hex << "mask " << mask << ": " << before.words[i] << " became " << after.words[i]
                << ", without a mask " << full.words[i];
          ASSERT_TRUE(after.depths == full.depths) << "color masks must not affect depth";
        }
      }
    }
}

TEST(Masks, DepthMaskKeepsEveryPlaneOfDepth) {
  for (const DepthFormat depth :
       {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32})
    for (const int samples : {1, 4})
      for (const Kind& kind : kinds())
        for (const bool enabled : {true, false}) {
          SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(samples) + " samples");
          const FrameBufferFormat format{
              .width = kWidth, .height = kHeight, .depth = depth, .samples = samples};
          const DepthState open{.test = Compare::always};
          const DepthState masked{.enabled = enabled, .test = Compare::always, .write = !enabled};
          const Buffers before = run(format, [](Frame&) {});
          const Buffers full = run(format, [&](Frame& frame) { kind.draw(frame, {.depth = open}); });
          const Buffers after = run(format, [&](Frame& frame) { kind.draw(frame, {.depth = masked}); });
          ASSERT_TRUE(after.depths == before.depths);
          ASSERT_TRUE(after.words == full.words) << "the depth mask must not affect colour";
          ASSERT_TRUE(full.depths != before.depths);
        }
}

}  // namespace
}  // namespace tessera::test::masks_test
