// Dithers of the public interface: the mean that they preserve, positions, and error diffusion of a frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::test::dither_test {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr Dither kDithers[] = {Dither::bayer2,          Dither::bayer4, Dither::bayer8, Dither::blue_noise,
                               Dither::floyd_steinberg, Dither::jarvis, Dither::pattern};
constexpr Dither kOrdered[] = {Dither::bayer2, Dither::bayer4, Dither::bayer8, Dither::blue_noise,
                               Dither::pattern};

Words words_of(const FrameBuffer& buffer) {
  Words words(static_cast<std::size_t>(buffer.format().width) *
              static_cast<std::size_t>(buffer.format().height));
  buffer.read_packed_colors(words);
  return words;
}

std::vector<std::uint8_t> shown_by(const FrameBuffer& buffer) {
  const int width = buffer.format().width, height = buffer.format().height;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(4 * width * height));
  buffer.read_color(
      {.pixels = pixels.data(), .width = width, .height = height, .stride_bytes = std::ptrdiff_t{4} * width});
  return pixels;
}

Color grey(float level) { return {level, level, level, 1}; }

/// sRGB's curve, IEC 61966-2-1.
double light_of(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

/// Half a step of a dither, as a share of the distance of two levels.
double half_step(Dither dither) {
  switch (dither) {
    case Dither::bayer2: return 1 / 8.0;
    case Dither::bayer4:
    case Dither::pattern: return 1 / 32.0;
    default: return 1 / 64.0;
  }
}

/// Mean of a channel of the shown picture, and the distance of the two values between which `wanted` lies.
struct FlatField {
  double mean;
  double distance;
};

FlatField flat_field(const FrameBuffer& buffer, std::size_t channel, bool in_light, double wanted,
                     const std::vector<double>& levels) {
  const auto value = [in_light](double c) { return in_light ? light_of(c) : c; };
  const std::vector<std::uint8_t> pixels = shown_by(buffer);
  double sum = 0;
  for (std::size_t i = channel; i < pixels.size(); i += 4) sum += value(pixels[i] / 255.0);
  double below = 0, above = 1;
  for (const double level : levels) {
    if (value(level) <= wanted) below = std::max(below, value(level));
    else above = std::min(above, value(level));
  }
  return {sum / (static_cast<double>(pixels.size()) / 4), above - below};
}

std::vector<double> shown_levels(int bits) {
  std::vector<double> levels;
  for (int level = 0; level < 1 << bits; ++level)
    levels.push_back(std::floor(255.0 * level / ((1 << bits) - 1) + 0.5) / 255);
  return levels;
}

void draw_flat(Renderer& renderer, FrameBuffer& buffer, float level) {
  Frame frame(buffer);
  frame.clear({.depth = 1});
  const MeshData window = whole_window();
  frame.draw(window.view(), unlit(grey(level)));
  renderer.finish(frame);
}

/// Display levels are rounded to 8 bits.
constexpr double kRounding = 0.5 / 255;

TEST(Dither, KeepsTheMeanOfFlatGreys) {
  Renderer renderer({.threads = 1});
  for (const bool in_light : {false, true})
    for (const int bits : {1, 2, 4, 8})
      for (const Dither dither : kDithers) {
        FrameBuffer buffer({.width = 64,
                            .height = 64,
                            .color_bits = bits,
                            .dither = dither,
                            .dither_in = in_light ? DitherSpace::light : DitherSpace::levels});
        const int channel_bits[3] = {bits <= 2 ? bits : bits / 3 + (bits % 3 == 2),
                                     bits <= 2 ? bits : bits / 3 + (bits % 3 >= 1),
                                     bits <= 2 ? bits : bits / 3};
        for (int g = 0; g < 16; ++g) {
          const float level = static_cast<float>(g) / 15;
          draw_flat(renderer, buffer, level);
          const double wanted = in_light ? light_of(level) : static_cast<double>(level);
          for (std::size_t channel = 0; channel < 3; ++channel) {
            const FlatField field =
                flat_field(buffer, channel, in_light, wanted, shown_levels(channel_bits[channel]));
            EXPECT_NEAR(field.mean, wanted, field.distance * half_step(dither) + kRounding)
                << g << "/15 at " << bits << " bits, dither " << static_cast<int>(dither) << ", light "
                << in_light;
          }
        }
      }
}

// Ordered dithers of palettes spread beyond two neighbouring greys (section 1 of the specification), so only
// the other dithers keep the mean at the ends.
TEST(Dither, KeepsTheMeanOfFlatGreysInGreyPalettes) {
  Renderer renderer({.threads = 1});
  for (const bool in_light : {false, true})
    for (const int bits : {1, 2, 4, 8})
      for (const Dither dither : {Dither::floyd_steinberg, Dither::jarvis, Dither::pattern}) {
        FrameBuffer buffer({.width = 64,
                            .height = 64,
                            .color_mode = ColorMode::index,
                            .color_bits = bits,
                            .palette = named_palette(bits == 1 ? "bw" : "gray", bits),
                            .dither = dither,
                            .dither_in = in_light ? DitherSpace::light : DitherSpace::levels});
        for (int g = 0; g < 16; ++g) {
          const float level = static_cast<float>(g) / 15;
          draw_flat(renderer, buffer, level);
          const double wanted = in_light ? light_of(level) : static_cast<double>(level);
          const FlatField field = flat_field(buffer, 1, in_light, wanted, shown_levels(bits));
          EXPECT_NEAR(field.mean, wanted, field.distance * half_step(dither) + kRounding)
              << g << "/15 at " << bits << " bits, dither " << static_cast<int>(dither) << ", light "
              << in_light;
        }
      }
}

/// A shaded picture: a quadrangle of four colours, and a darker one over it.
void draw_gradients(Frame& frame, std::optional<Rect> viewport = {}) {
  static const auto colored = [](MeshData mesh, std::vector<float> colors) {
    mesh.colors = std::move(colors);
    return mesh;
  };
  static const MeshData back =
      colored(rectangle(-0.9f, -0.8f, 0.7f, 0.9f, 0.5f),
              {1, 0.2f, 0.1f, 1, 0.1f, 0.9f, 0.3f, 1, 0.2f, 0.3f, 1, 1, 0.9f, 0.9f, 0.8f, 1});
  static const MeshData front =
      colored(rectangle(-0.5f, -0.5f, 0.4f, 0.3f, 0),
              {0, 0, 0, 1, 0.3f, 0.3f, 0.3f, 1, 0.6f, 0.6f, 0.6f, 1, 0.2f, 0.1f, 0, 1});
  DrawState state = unlit(grey(1));
  state.viewport = viewport;
  frame.draw(back.view(), state);
  frame.draw(front.view(), state);
}

FrameBufferFormat format_of(Dither dither, DitherSpace space, ColorMode mode, int bits, int size = 192) {
  return {.width = size,
          .height = size,
          .color_mode = mode,
          .color_bits = bits,
          .dither = dither,
          .dither_in = space};
}

TEST(Dither, HasTheSameBitsForThreadsTilesAndInstructionSets) {
  for (const Dither dither : kDithers)
    for (const DitherSpace space : {DitherSpace::levels, DitherSpace::light})
      for (const auto& [mode, bits] :
           {std::pair{ColorMode::rgb, 2}, {ColorMode::rgb, 15}, {ColorMode::index, 4}}) {
        Words first;
        for (const RendererOptions& options : {RendererOptions{.threads = 1},
                                               {.threads = 3, .tile_size = 32},
                                               {.threads = 8, .tile_size = 128},
                                               {.threads = 2, .instruction_set = InstructionSet::scalar},
                                               {.threads = 2, .debug = {.defer_shading = true}}}) {
          Renderer renderer(options);
          FrameBuffer buffer(format_of(dither, space, mode, bits));
          Frame frame(buffer);
          frame.clear({.color = Color{0.1f, 0.2f, 0.4f, 1}});
          draw_gradients(frame);
          renderer.finish(frame);
          if (first.empty()) first = words_of(buffer);
          ASSERT_EQ(words_of(buffer), first) << static_cast<int>(dither) << ", " << bits << " bits";
        }
      }
}

TEST(Dither, OrderedKindsMoveWithThePicture) {
  Renderer renderer({.threads = 2});
  constexpr int kSize = 256;
  for (const Dither dither : kOrdered)
    for (const DitherSpace space : {DitherSpace::levels, DitherSpace::light})
      for (const auto& [mode, bits] : {std::pair{ColorMode::rgb, 8}, {ColorMode::index, 4}}) {
        const int shift = dither == Dither::blue_noise ? 64 : 8;
        const auto words_at = [&](int pixels) {
          FrameBuffer buffer(format_of(dither, space, mode, bits, kSize));
          Frame frame(buffer);
          draw_gradients(frame, Rect{pixels, pixels, 128, 128});
          renderer.finish(frame);
          return words_of(buffer);
        };
        const Words at_origin = words_at(0), moved = words_at(shift);
        for (int y = 0; y < kSize - shift; ++y)
          for (int x = 0; x < kSize - shift; ++x)
            ASSERT_EQ(moved[static_cast<std::size_t>(y * kSize + x + shift)],
                      at_origin[static_cast<std::size_t>((y + shift) * kSize + x)])
                << "at " << x << ", " << y << ", dither " << static_cast<int>(dither);
      }
}

TEST(Dither, ClearsEqualDraws) {
  Renderer renderer({.threads = 2});
  for (const Dither dither : kDithers)
    for (const DitherSpace space : {DitherSpace::levels, DitherSpace::light})
      for (const auto& [mode, bits] :
           {std::pair{ColorMode::rgb, 1}, {ColorMode::rgb, 12}, {ColorMode::index, 4}}) {
        FrameBuffer cleared(format_of(dither, space, mode, bits)),
            drawn(format_of(dither, space, mode, bits));
        const Color color{0.3f, 0.55f, 0.7f, 1};
        Frame clear(cleared);
        clear.clear({.color = color});
        renderer.finish(clear);
        Frame draw(drawn);
        const MeshData window = whole_window();
        draw.draw(window.view(), unlit(color));
        renderer.finish(draw);
        EXPECT_EQ(words_of(cleared), words_of(drawn)) << static_cast<int>(dither) << ", " << bits << " bits";
      }
}

TEST(ErrorDiffusionFrames, ShowTheStoredPictureAndStartFromTheDrawnOne) {
  Renderer renderer({.threads = 2});
  for (const auto& [mode, bits] : {std::pair{ColorMode::rgb, 3}, {ColorMode::index, 4}}) {
    const FrameBufferFormat format = format_of(Dither::floyd_steinberg, DitherSpace::levels, mode, bits);
    FrameBuffer at_once(format), in_two(format);
    std::vector<std::uint8_t> image(static_cast<std::size_t>(4 * format.width * format.height));
    Frame frame(at_once);
    frame.clear({.color = grey(0.4f)});
    draw_gradients(frame);
    renderer.finish(frame, {.pixels = image.data(),
                            .width = format.width,
                            .height = format.height,
                            .stride_bytes = std::ptrdiff_t{4} * format.width});
    EXPECT_EQ(image, shown_by(at_once));
    // The second frame continues with 8 bits per component: nothing is diffused twice.
    Frame first(in_two);
    first.clear({.color = grey(0.4f)});
    renderer.finish(first);
    EXPECT_NE(words_of(in_two), words_of(at_once));
    Frame second(in_two);
    draw_gradients(second);
    renderer.finish(second);
    EXPECT_EQ(words_of(in_two), words_of(at_once));
  }
}

TEST(ErrorDiffusionFrames, KeepIndicesOfDraws) {
  Renderer renderer({.threads = 2});
  FrameBuffer buffer(format_of(Dither::jarvis, DitherSpace::levels, ColorMode::index, 4, 64));
  EXPECT_EQ(words_of(buffer), Words(64 * 64, 0)) << "new buffers hold index 0";
  Frame frame(buffer);
  frame.clear({.index = 9});
  MeshData mesh = rectangle(-1, -1, 0, 0);
  mesh.color_indices = {5, 5, 5, 5};
  frame.draw(mesh.view(), unlit(grey(1)));
  const MeshData right = rectangle(0, 0, 1, 1);
  frame.draw(right.view(), unlit(grey(0.5f)));
  renderer.finish(frame);
  const Words words = words_of(buffer);
  bool is_mixed = false;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint32_t word = words[static_cast<std::size_t>(y * 64 + x)];
      if (x < 32 && y >= 32) EXPECT_EQ(word, 5u);
      else if (x < 32 || y >= 32) EXPECT_EQ(word, 9u);
      else is_mixed |= word != words[32];
    }
  EXPECT_TRUE(is_mixed);
}

TEST(ErrorDiffusionFrames, RefuseOperationsOnStoredBits) {
  FrameBuffer buffer(format_of(Dither::jarvis, DitherSpace::levels, ColorMode::rgb, 12, 64));
  Frame frame(buffer);
  const MeshData window = whole_window();
  DrawState state = unlit(grey(1));
  state.logic_op = LogicOp::bit_xor;
  EXPECT_EQ(
      error_of([&] { frame.draw(window.view(), state); }),
      "Frame::draw: a logic operation is asked for, but a frame with error diffusion keeps colours of 8 "
      "bits per component until it is finished");
  state = unlit(grey(1));
  state.plane_mask = 0xff0;
  EXPECT_EQ(
      error_of([&] { frame.draw(window.view(), state); }),
      "Frame::draw: plane_mask selects some colour planes, but a frame with error diffusion keeps colours "
      "of 8 bits per component until it is finished");
  state.plane_mask = 0xfff;
  frame.draw(window.view(), state);
  Renderer renderer({.threads = 1});
  renderer.finish(frame);
  EXPECT_EQ(words_of(buffer), Words(64 * 64, 0xfff));
}

TEST(ErrorDiffusionFrames, CountTheirMemory) {
  FrameBufferFormat format = format_of(Dither::none, DitherSpace::levels, ColorMode::index, 4, 512);
  format.depth = DepthFormat::none;
  format.stencil_bits = 0;
  const std::size_t plane = FrameBuffer::memory_bytes(format) / 4;
  format.dither = Dither::floyd_steinberg;
  // 8 bits per component, and the bit that marks an index.
  EXPECT_EQ(FrameBuffer::memory_bytes(format), (4 + 25) * plane);
  FrameBuffer buffer(format);
  EXPECT_EQ(buffer.plane_count(Buffer::color), 4);
  Renderer renderer({.threads = 2});
  Frame frame(buffer);
  draw_gradients(frame);
  renderer.finish(frame);
  EXPECT_EQ(buffer.allocated_bytes(Buffer::color), (4 + 25) * plane);
}

TEST(ErrorDiffusionFrames, UseTheCallersMemory) {
  const FrameBufferFormat format =
      format_of(Dither::floyd_steinberg, DitherSpace::light, ColorMode::rgb, 1, 64);
  const std::size_t bytes = FrameBuffer::memory_bytes(format);
  std::vector<std::byte> memory(bytes + 64);
  auto* const aligned = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64;
  FrameBuffer inside(format, {aligned, bytes}), outside(format);
  Renderer renderer({.threads = 2});
  for (FrameBuffer* const buffer : {&inside, &outside}) {
    Frame frame(*buffer);
    draw_gradients(frame);
    renderer.finish(frame);
  }
  EXPECT_EQ(words_of(inside), words_of(outside));
  EXPECT_EQ(inside.plane(Buffer::color, 0).bits, reinterpret_cast<const std::uint8_t*>(aligned));
}

TEST(DitherErrors, NameWhatWasFound) {
  FrameBufferFormat format = format_of(Dither::pattern, DitherSpace::light, ColorMode::index, 9, 64);
  format.palette.assign(300, grey(0.5f));
  EXPECT_EQ(error_of([&] { FrameBuffer{format}; }),
            "FrameBuffer: dither is pattern and the palette has 300 entries; pattern mixes at most 256");
  format = format_of(Dither::bayer2, DitherSpace::light, ColorMode::rgb, 9, 64);
  format.dither_gamma = 0.5f;
  EXPECT_EQ(error_of([&] { FrameBuffer{format}; }),
            "FrameBuffer: dither_gamma is 0.500000, must be 1 to 4, or 0 for the curve of sRGB");
}

}  // namespace
}  // namespace tessera::test::dither_test
