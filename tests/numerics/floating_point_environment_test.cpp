// The caller's floating-point environment: every rounding mode, flush to zero, denormals as zero, each with
// and without traps, around every call of the interface. It changes no bit of any result, no call changes it,
// and no trap fires, whatever the inputs.
//
// Only library calls run between setting and restoring a mode.
#include <gtest/gtest.h>

#include "tests/numerics/every_host_mode.h"

#if defined(__x86_64__)

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <thread>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_operations.h"

namespace tessera::test::floating_point_environment_test {
using namespace detail;
using namespace program;
namespace {

constexpr float kDenormal = 1e-40f;

std::vector<std::uint64_t> bits_of(std::initializer_list<Matrix> matrices) {
  std::vector<std::uint64_t> bits;
  for (const Matrix& matrix : matrices)
    for (const double element : matrix.m) bits.push_back(std::bit_cast<std::uint64_t>(element));
  return bits;
}

TEST(FloatingPointEnvironment, ChangesNoBitOfAMatrix) {
  Matrix turned;
  Matrix viewed;
  Matrix wide;
  Matrix skew;
  Matrix box;
  Matrix product;
  Matrix shadow;
  Matrix moved;
  Matrix scaled;
  Camera calibrated;
  Light light;
  light.position = {0.1f, 3.3f, 0.7f, 1};
  const Matrix tiny{{1e-310, 0, 0, 1e-200, 0, 1e-160, 0, 0, 0, 0, 1.1, 0, 0, 0, 0, 0.9}};
  expect_the_same_in_every_mode(
      [&] {
        turned = rotate(33.3, 0.1, 0.7, 0.3);
        viewed = look_at({0.1, 0.7, 3.3}, {0.2, -0.1, 0.3}, {0.1, 1, 0.2});
        wide = perspective(47.3, 1.37, 0.11, 77.7, true);
        skew = frustum(-0.1, 0.3, -0.7, 0.2, 0.1, 33);
        box = orthographic(-0.1, 0.3, -0.7, 0.2, 0.1, 33);
        moved = translate(1e-310, 0.1, 7);
        scaled = scale(1e-310, 0.1, 7);
        product = tiny * viewed * turned;
        shadow = planar_shadow({0.1, 0.9, 0.2, 0.3}, light);
        calibrated = calibrated_camera({333.3, 313.1, 100.7, 77.3, 201, 151}, viewed, 0.1, 33);
      },
      [&] {
        return bits_of({turned, viewed, wide, skew, box, moved, scaled, product, shadow, calibrated.view,
                        calibrated.projection});
      });
}

TEST(FloatingPointEnvironment, ChangesNoColorOfAPalette) {
  std::vector<std::vector<Color>> palettes;
  const FrameBufferFormat format{
      .width = 3,
      .height = 2,
      .color_mode = ColorMode::index,
      .color_bits = 3,
      .palette = {{0.1f, 0.3f, 0.7f, 1}, {0.9f, 0.499f, 0.501f, 1}, {1.5f / 255, 2.5f / 255, kDenormal, 1}}};
  const std::vector<Color> other{{0.5f / 255, 254.5f / 255, 0.33f, 1}, {0.7f, kDenormal, 0.2f, 1}};
  std::vector<std::uint8_t> shown(96);
  expect_the_same_in_every_mode(
      [&] {
        palettes.clear();
        for (const char* const name : {"bw", "gray", "ega16", "vga256", "web216"})
          palettes.push_back(named_palette(name, 8));
        palettes.push_back(default_palette(3));
        FrameBuffer buffer(format);
        const ImageTarget target{.pixels = shown.data(), .width = 3, .height = 2, .stride_bytes = 12};
        buffer.read_color(target);
        buffer.set_palette(other);
        buffer.read_color({.pixels = shown.data() + 24,
                           .width = 3,
                           .height = 2,
                           .stride_bytes = 12,
                           .order = PixelOrder::bgra8});
        Frame frame(buffer);
        frame.clear({.color = Color{0.6f, 0.1f, 0.3f, 1}});  // quantized to the nearest entry
        Renderer({.threads = 1}).finish(frame);
        buffer.read_color({.pixels = shown.data() + 48, .width = 3, .height = 2, .stride_bytes = 12});
      },
      [&] {
        std::vector<std::uint32_t> bits;
        for (const auto& palette : palettes)
          for (const Color& c : palette)
            for (const float component : {c.r, c.g, c.b, c.a})
              bits.push_back(std::bit_cast<std::uint32_t>(component));
        bits.insert(bits.end(), shown.begin(), shown.end());
        return bits;
      });
}

/// Everything that can be read back, read in the given mode.
struct ReadBack {
  std::vector<std::uint32_t> words;
  std::vector<std::uint32_t> depth_words;
  std::vector<std::uint8_t> shown;
  std::vector<std::uint8_t> stencil;
  std::vector<float> depth;
  std::vector<float> view_depth;
  std::vector<float> accumulation;

  explicit ReadBack(const FrameBufferFormat& f) {
    const std::size_t pixels = static_cast<std::size_t>(f.width * f.height);
    words.resize(pixels);
    depth_words.resize(pixels);
    shown.resize(4 * pixels);
    stencil.resize(pixels);
    depth.resize(pixels);
    view_depth.resize(pixels);
    accumulation.resize(4 * pixels);
  }
  void read(const FrameBuffer& buffer, const Camera& camera) {
    const FrameBufferFormat& f = buffer.format();
    buffer.read_packed_colors(words);
    buffer.read_color(
        {.pixels = shown.data(), .width = f.width, .height = f.height, .stride_bytes = 4 * f.width});
    if (f.depth != DepthFormat::none) {
      buffer.read_stored_depths(depth_words);
      buffer.read_depth(depth);
      buffer.read_view_depth(view_depth, camera, 1e-41f);
    }
    if (f.stencil_bits > 0) buffer.read_stencil(stencil);
    if (f.accumulation_bits > 0) buffer.read_accumulation(accumulation);
  }
  std::uint64_t hash() const {
    Hash all;
    for (const auto* values : {&words, &depth_words})
      for (const std::uint32_t value : *values) all.add(value);
    for (const auto* values : {&shown, &stencil})
      for (const std::uint8_t value : *values) all.add(value);
    for (const auto* values : {&depth, &view_depth, &accumulation})
      for (const float value : *values) all.add(std::bit_cast<std::uint32_t>(value));
    return all.value();
  }
};

std::vector<FrameBufferFormat> formats() {
  const FrameBufferFormat base{.width = 90, .height = 60, .accumulation_bits = 32};
  std::vector<FrameBufferFormat> all(6, base);
  all[1].depth = DepthFormat::unorm16;
  all[1].color_bits = 15;
  all[1].dither = Dither::bayer4;
  all[2].depth = DepthFormat::unorm32;
  all[2].alpha_bits = 8;
  all[2].accumulation_bits = 16;
  all[3].depth = DepthFormat::float32;
  all[3].samples = 4;
  all[4].color_mode = ColorMode::index;
  all[4].color_bits = 8;
  all[4].accumulation_bits = 0;
  all[5].depth = DepthFormat::none;
  all[5].stencil_bits = 0;
  all[5].color_bits = 2;
  return all;
}

// Triangles, points, lines, outlines, textures, bitmaps, images, shadows, every fragment operation, and
// accumulation, on every instruction set, with one and several threads.
TEST(FloatingPointEnvironment, ChangesNoBitOfAFrame) {
  const ThreadLimit limit(3);
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (const InstructionSet set : available_instruction_sets())
    for (const int threads : {1, 3})
      renderers.push_back(
          std::make_unique<Renderer>(RendererOptions{.threads = threads, .instruction_set = set}));
  for (const FrameBufferFormat& format : formats()) {
    const RandomOperations scene(format, 24);
    std::uint64_t expected = 0;
    std::size_t turn = 0;
    for (const unsigned mode : HostModes::all()) {
      FrameBuffer buffer(format);
      FrameBuffer presented(format);
      Frame frame(buffer);
      Frame shown(presented);
      scene.record(frame);
      scene.record(shown);
      ReadBack found(format);
      std::vector<std::uint8_t> scanned(4 * pixel_count(buffer));
      const ImageTarget target{.pixels = scanned.data(),
                               .width = format.width,
                               .height = format.height,
                               .stride_bytes = 4 * format.width};
      std::vector<float> normals(3 * pixel_count(buffer));
      frame.capture({.normals = normals});
      Renderer& renderer = *renderers[turn++ % renderers.size()];
      bool untouched = false;
      {
        const HostMode host(mode);
        renderer.finish(frame);
        renderer.finish(shown, target);
        found.read(buffer, scene.camera);
        untouched = host.is_untouched();
      }
      ASSERT_TRUE(untouched) << described(mode) << ", " << describe(format);
      ASSERT_TRUE(scanned == found.shown) << described(mode) << ", " << describe(format);
      Hash all;
      all.add(found.hash());
      for (const float normal : normals) all.add(std::bit_cast<std::uint32_t>(normal));
      if (expected == 0) expected = all.value();
      ASSERT_EQ(all.value(), expected) << described(mode) << ", " << describe(format);
    }
  }
}

// Created, recorded and finished in the mode: textures, and draws whose recording computes values.
TEST(FloatingPointEnvironment, ChangesNoBitOfAFrameRecordedInIt) {
  const FrameBufferFormat format{
      .width = 60, .height = 40, .depth = DepthFormat::float32, .accumulation_bits = 16};
  std::vector<std::uint8_t> texels;
  Random random(16);
  for (int i = 0; i < 4 * 13 * 11; ++i) texels.push_back(static_cast<std::uint8_t>(random.next()));
  MeshData mesh = rectangle(-0.9f, -0.7f, 0.8f, 0.9f, -0.3f);
  MeshData line = rectangle(-0.9f, 0.7f, 0.8f, -0.9f, 0.2f);
  MeshData denormal = rectangle(-kDenormal, -kDenormal, kDenormal, kDenormal);
  mesh.texcoords = {0.1f, 0.3f, 1.9f, 0.2f, 2.3f, 1.7f, -0.3f, 1.1f};
  mesh.normals = {0.1f, 0.2f, 0.9f, 0.3f, -0.2f, 0.8f, kDenormal, 0, kDenormal, 0, 0.1f, 0.7f};
  line.primitive = Primitive::lines;
  line.indices = {0, 1, 1, 2, 2, 3, 3, 0};
  DrawState lit;
  DrawState shadow;
  DrawState scaled;
  DrawState points;
  lit.material.specular = {0.3f, 0.7f, 0.1f, 1};
  lit.material.shininess = 7.7f;
  lit.shading = Shading::phong;
  shadow.shadow_on = ShadowOn{.plane = {0.1, 0.9, 0.2, 0.3}, .light = 1, .color = {0.2f, 0.1f, 0.1f, 1}};
  scaled.transform = scale(1e39, 1e39, 0.37);
  scaled.shading = Shading::flat;
  points.front_mode = PolygonMode::point;
  points.point_size = 3.7f;
  points.polygon_offset = {0.7f, 3.3f};
  Light spot;
  spot.position = {0.3f, 1.7f, 2.2f, 0.9f};
  spot.spot_cutoff = 61;
  spot.spot_exponent = 2.7f;
  const std::vector<Light> lights{Light{}, spot};
  const Camera camera{.view = look_at({0.1, 0.2, 1.3}, {0, 0, 0}, {0, 1, 0}),
                      .projection = perspective(77, 1.5, 0.1, 9)};
  const Accum half{.op = AccumOp::load, .value = 0.3337};
  const Accum back{.op = AccumOp::return_color, .value = 2.1};
  ReadBack found(format);
  std::string reasons;
  Renderer renderer({.threads = 1});
  expect_the_same_in_every_mode(
      [&] {
        const Texture texture({.pixels = texels.data(), .width = 13, .height = 11});
        FrameBuffer buffer(format);
        Frame frame(buffer);
        frame.set_camera(camera);
        frame.set_lights(lights);
        frame.set_light_model({.ambient = {0.1f, 0.2f, 0.3f, 1}, .local_viewer = true});
        frame.clear({.color = Color{0.3f, 0.1f, 0.7f, 1}, .depth = 0.77});
        frame.draw(mesh.view(), lit);
        lit.texture = &texture;
        frame.draw(mesh.view(), lit);
        lit.texture = nullptr;
        frame.draw(mesh.view(), shadow);
        frame.draw(denormal.view(), scaled);
        frame.draw(mesh.view(), points);
        frame.draw(line.view(), points);
        frame.draw_bitmap({.bits = texels.data(),
                           .width = 13,
                           .height = 9,
                           .stride_bytes = 7,
                           .x = 3.9,
                           .y = -1.1,
                           .depth = 0.1,
                           .color = {0.3f, 0.4f, 0.1f, 1}});
        frame.draw_image({.pixels = texels.data(),
                          .width = 13,
                          .height = 11,
                          .x = 30.3,
                          .y = 7.7,
                          .zoom_x = 0.77,
                          .zoom_y = -1.3});
        frame.accumulate(half);
        frame.accumulate(back);
        reasons = frame.explain(1) + frame.explain(2);
        renderer.finish(frame);
        found.read(buffer, camera);
      },
      [&] { return reasons + std::to_string(found.hash()); });
}

/// Host threads, each with its own floating-point mode.
class ThreadsWithModes : public Executor {
 public:
  int workers() const noexcept override { return 3; }
  void run(int count, void (*work)(void*, int), void* context) override {
    std::vector<std::thread> threads;
    for (int k = 0; k < count; ++k)
      threads.emplace_back([&, k] {
        const std::vector<unsigned> modes = HostModes::all();
        const unsigned mode = modes[static_cast<std::size_t>(turn + 7 * k) % modes.size()];
        const HostMode host(mode);
        work(context, k);
        if (!host.is_untouched()) touched = true;
      });
    for (std::thread& thread : threads) thread.join();
    ++turn;
  }
  int turn = 0;
  std::atomic<bool> touched = false;
};

TEST(FloatingPointEnvironment, ExecutorThreadModesNeitherMatterNorChange) {
  const auto executor = std::make_shared<ThreadsWithModes>();
  Renderer theirs({.threads = 3, .executor = executor});
  Renderer ours({.threads = 1});
  for (const FrameBufferFormat& format : formats()) {
    const RandomOperations scene(format, 24);
    FrameBuffer plain(format);
    Frame frame(plain);
    scene.record(frame);
    ours.finish(frame);
    for (int round = 0; round < 12; ++round) {
      FrameBuffer buffer(format);
      Frame again(buffer);
      scene.record(again);
      theirs.finish(again);
      ASSERT_EQ(fingerprint(buffer), fingerprint(plain)) << describe(format);
    }
  }
  EXPECT_FALSE(executor->touched);
  EXPECT_GT(executor->turn, 50);
}

}  // namespace
}  // namespace tessera::test::floating_point_environment_test

#endif
