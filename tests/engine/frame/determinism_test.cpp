// The same frame gives the same bits: for any number of threads, tile size and instruction set, with
// immediate or deferred shading, with effects left out or in full, in one or several bin passes, in any order
// of tiles, scanned out or read back, and on any machine. tests/picture_hashes.txt holds the hash of every
// scene, tests/random_frame_hashes.txt those of some random frames.
//
// After an intended change of pictures: TESSERA_WRITE_HASHES=1 engine_tests --gtest_filter='PictureHashes.*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "engine/program/scene/picture_hashes.h"
#include "engine/program/scene/scene.h"
#include "engine/program/scene/text_file.h"
#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_random_frame.h"
#include "tests/engine/frame/api_random_operations.h"

namespace tessera::determinism_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

const char* const kBuiltin = "builtin";  // name of the program's default scene
const std::string kHashes = TESSERA_SOURCE_DIR "/tests/picture_hashes.txt";
const std::string kRandomHashes = TESSERA_SOURCE_DIR "/tests/random_frame_hashes.txt";

std::vector<std::string> scene_names() {
  std::vector<std::string> names{kBuiltin};
  for (const auto& entry : std::filesystem::directory_iterator(TESSERA_TEST_SCENES))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Scene scene_of(const std::string& name) {
  Scene scene = name == kBuiltin ? builtin_scene()
                                 : load_scene(std::string(TESSERA_TEST_SCENES) + "/" + name + ".json");
  if (name == kBuiltin) apply({.width = 320, .height = 240}, scene);
  return scene;
}

std::string text(const RendererOptions& o) {
  return std::to_string(o.threads) + " threads, tiles of " + std::to_string(o.tile_size) + ", " +
         std::string(name(o.instruction_set)) + (o.debug.defer_shading ? "" : ", shaded at once") +
         (o.bin_memory == kMinBinMemory ? ", in parts" : "") + (o.debug.task_order != 0 ? ", shuffled" : "") +
         (o.elide ? "" : ", every effect in full");
}

const std::vector<RendererOptions>& all_options() {
  static const std::vector<RendererOptions> kAll = [] {
    std::vector<RendererOptions> all;
    // Each two-valued option meets every number of threads, every tile size and every instruction set, but
    // not every combination of them.
    for (int threads = 1; threads <= 8; ++threads)
      for (const int tile_size : {32, 64, 128})
        for (const InstructionSet set : available_instruction_sets()) {
          const int place = threads + tile_size / 32 / 2 + static_cast<int>(set);
          RendererOptions options{.threads = threads, .tile_size = tile_size, .instruction_set = set};
          if (place / 2 % 2 != 0) options.bin_memory = kMinBinMemory;
          options.debug.defer_shading = place % 2 == 0;
          options.elide = place / 4 % 2 == 0;
          if (threads % 3 != 0) options.debug.task_order = 17u * static_cast<unsigned>(place);
          all.push_back(options);
        }
    return all;
  }();
  return kAll;
}

// Cached: each renderer is made once and used for many frames.
Renderer& renderer(const RendererOptions& options) {
  static ThreadLimit limit(8);
  static std::map<std::string, Renderer> renderers;
  return renderers.try_emplace(text(options), options).first->second;
}

Fingerprint stored(const FrameBufferFormat& format, const std::function<void(Frame&)>& record, Renderer& by) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  by.finish(frame);
  return fingerprint(buffer);
}

std::vector<std::uint8_t> presented(const FrameBufferFormat& format,
                                    const std::function<void(Frame&)>& record, Renderer& by) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  Image image(buffer);
  by.finish(frame, image.target());
  return image.bytes;
}

std::vector<std::uint8_t> read_back(const FrameBufferFormat& format,
                                    const std::function<void(Frame&)>& record, Renderer& by) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  by.finish(frame);
  Image image(buffer);
  buffer.read_color(image.target());
  return image.bytes;
}

struct StoredAndShown {
  Fingerprint stored;
  std::vector<std::uint8_t> shown;
};
/// Stores every buffer and scans the picture out in one frame.
StoredAndShown stored_and_presented(const FrameBufferFormat& format,
                                    const std::function<void(Frame&)>& record, Renderer& by) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
  Image image(buffer);
  by.finish(frame, image.target());
  return {fingerprint(buffer), image.bytes};
}

/// Whether a frame is stored and scanned out at once; otherwise there is a frame for either. Both meet every
/// number of threads, every tile size and every instruction set.
bool presents_what_it_stores(const RendererOptions& options) {
  const int tile_size = options.tile_size == 128 ? 2 : options.tile_size / 64;
  return (options.threads + tile_size + static_cast<int>(options.instruction_set)) % 3 != 0;
}

void expect_same_bits_always(const FrameBufferFormat& format, const std::function<void(Frame&)>& record) {
  Renderer& plain = renderer({.threads = 1,
                              .tile_size = 64,
                              .instruction_set = InstructionSet::scalar,
                              .elide = false,
                              .debug = {.defer_shading = false}});
  const Fingerprint expected = stored(format, record, plain);
  const std::vector<std::uint8_t> shown = read_back(format, record, plain);
  for (const RendererOptions& options : all_options()) {
    Renderer& by = renderer(options);
    ASSERT_EQ(by.options().threads, options.threads) << "the thread limit is lower than requested";
    const StoredAndShown result =
        presents_what_it_stores(options)
            ? stored_and_presented(format, record, by)
            : StoredAndShown{stored(format, record, by), presented(format, record, by)};
    EXPECT_EQ(result.stored, expected) << text(options);
    EXPECT_TRUE(result.shown == shown) << "scanned out by " << text(options);
  }
}

class SceneBits : public testing::TestWithParam<std::string> {};

TEST_P(SceneBits, DoNotDependOnRendererOptions) {
  const Scene scene = scene_of(GetParam());
  expect_same_bits_always(scene.framebuffer, [&](Frame& frame) { record(scene, frame); });
}

INSTANTIATE_TEST_SUITE_P(Determinism, SceneBits, testing::ValuesIn(scene_names()), [](const auto& scene) {
  std::string safe = scene.param;
  std::replace_if(
      safe.begin(), safe.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return safe;
});

FrameBufferFormat random_format(ColorMode mode, int bits, DepthFormat depth) {
  return {.width = 330, .height = 210, .color_mode = mode, .color_bits = bits, .depth = depth};
}

TEST(Determinism, RandomTrianglesWithClippingAndOverdrawHaveTheSameBits) {
  const RandomFrame random(random_format(ColorMode::rgb, 24, DepthFormat::unorm24));
  expect_same_bits_always(random.format, [&](Frame& frame) { random.record(frame); });
  FrameBuffer buffer(random.format);
  Frame frame(buffer);
  random.record(frame);
  const FrameStats stats = renderer({1, 64, InstructionSet::scalar}).finish(frame);
  EXPECT_GT(stats.clipped, 100u);
  EXPECT_GT(stats.shaded_pixels, 4u * 330 * 210);
}

class SampledTriangles : public testing::TestWithParam<std::pair<std::string, DepthFormat>> {};

// Colours and depth only: samples have specialized paths for these.
TEST_P(SampledTriangles, HaveTheSameBits) {
  const DepthFormat depth = GetParam().second;
  const RandomFrame random(
      {.width = 150, .height = 90, .depth = depth, .samples = depth == DepthFormat::unorm16 ? 8 : 4});
  expect_same_bits_always(random.format, [&](Frame& frame) { random.record(frame); });
}

INSTANTIATE_TEST_SUITE_P(Determinism, SampledTriangles,
                         testing::Values(std::pair("none", DepthFormat::none),
                                         std::pair("unorm16", DepthFormat::unorm16),
                                         std::pair("unorm24", DepthFormat::unorm24),
                                         std::pair("unorm32", DepthFormat::unorm32),
                                         std::pair("float32", DepthFormat::float32)),
                         [](const auto& format) { return format.param.first; });

TEST(Determinism, RandomTrianglesHaveTheSameBitsInSixteenBitColorAndFloatDepth) {
  const RandomFrame random(random_format(ColorMode::rgb, 16, DepthFormat::float32));
  expect_same_bits_always(random.format, [&](Frame& frame) { random.record(frame); });
}

TEST(Determinism, RandomTrianglesHaveTheSameBitsInPaletteColors) {
  const RandomFrame random(random_format(ColorMode::index, 8, DepthFormat::unorm32), 500);
  expect_same_bits_always(random.format, [&](Frame& frame) { random.record(frame); });
}

TEST(Determinism, RandomTrianglesHaveTheSameBitsInGrey) {
  const RandomFrame random(random_format(ColorMode::rgb, 2, DepthFormat::unorm16), 500);
  expect_same_bits_always(random.format, [&](Frame& frame) { random.record(frame); });
}

// Several batches of triangles and several vertex tasks, so that many threads work at the same time.
TEST(Determinism, ManySmallTrianglesHaveTheSameBitsOnEightThreads) {
  const RandomFrame random(random_format(ColorMode::rgb, 24, DepthFormat::none), 20000);
  const auto record = [&](Frame& frame) { random.record(frame); };
  const Fingerprint expected = stored(random.format, record, renderer({1, 128, InstructionSet::automatic}));
  for (int round = 0; round < 5; ++round)
    for (const int threads : {2, 3, 8})
      EXPECT_EQ(stored(random.format, record, renderer({threads, 32, InstructionSet::automatic})), expected);
}

// `colors` and `stencils` are minimum numbers of different stored values: a frame of one colour would prove
// nothing.
void expect_same_bits_of_operations(const FrameBufferFormat& format, std::size_t colors,
                                    std::size_t stencils) {
  const RandomOperations random(format);
  const auto record = [&](Frame& frame) { random.record(frame); };
  expect_same_bits_always(format, record);
  FrameBuffer buffer(format);
  Frame frame(buffer);
  record(frame);
  renderer({1, 64, InstructionSet::scalar}).finish(frame);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  const std::vector<std::uint32_t> levels = stored_depths(buffer);
  const std::vector<std::uint8_t> values = stencil_values(buffer);
  EXPECT_GE(std::set<std::uint32_t>(words.begin(), words.end()).size(), colors);
  EXPECT_GE(std::set<std::uint8_t>(values.begin(), values.end()).size(), stencils);
  EXPECT_GE(std::set<std::uint32_t>(levels.begin(), levels.end()).size(), words.size() / 10);
}

FrameBufferFormat full_format(int samples) {
  return {.width = samples == 1 ? 173 : 133,
          .height = samples == 1 ? 107 : 71,
          .alpha_bits = 8,
          .dither = Dither::bayer8,
          .accumulation_bits = 16,
          .samples = samples};
}

TEST(Determinism, EveryOperationHasTheSameBits) { expect_same_bits_of_operations(full_format(1), 800, 60); }
// Here triangles with a stencil test use the kernels of draws without fragment operations.
TEST(Determinism, EveryOperationHasTheSameBitsInPlainColors) {
  expect_same_bits_of_operations({.width = 173, .height = 107}, 800, 60);
}
TEST(Determinism, EveryOperationHasTheSameBitsWithFourSamples) {
  expect_same_bits_of_operations(full_format(4), 1500, 60);
}
TEST(Determinism, EveryOperationHasTheSameBitsWithEightSamples) {
  expect_same_bits_of_operations(full_format(8), 1500, 60);
}
TEST(Determinism, EveryOperationHasTheSameBitsInGrey) {
  expect_same_bits_of_operations({.width = 173,
                                  .height = 107,
                                  .color_bits = 2,
                                  .depth = DepthFormat::unorm16,
                                  .stencil_bits = 3,
                                  .accumulation_bits = 32},
                                 4, 8);
}
TEST(Determinism, EveryOperationHasTheSameBitsInSixteenBitColorFloatDepthAndFourSamples) {
  expect_same_bits_of_operations({.width = 133,
                                  .height = 71,
                                  .color_bits = 16,
                                  .depth = DepthFormat::float32,
                                  .dither = Dither::bayer4,
                                  .samples = 4},
                                 800, 60);
}
TEST(Determinism, EveryOperationHasTheSameBitsInPaletteColors) {
  expect_same_bits_of_operations({.width = 173,
                                  .height = 107,
                                  .color_mode = ColorMode::index,
                                  .color_bits = 8,
                                  .depth = DepthFormat::unorm32,
                                  .dither = Dither::bayer2},
                                 200, 60);
}

/// Caps that together select every code path of a Quality.
const std::vector<Quality>& qualities() {
  static const std::vector<Quality> kQualities{
      {.shading = ShadingCap::phong_2x2},
      {.shading = ShadingCap::phong_4x4, .interpolation = InterpolationCap::affine},
      {.shading = ShadingCap::phong_2x2, .renormalize = false, .texture = TextureCap::bilinear},
      {.shading = ShadingCap::phong_4x4, .viewer = ViewerCap::infinite, .light_threshold = 0.3f},
      {.renormalize = false,
       .interpolation = InterpolationCap::affine,
       .texture = TextureCap::nearest,
       .light_threshold = 0.05f}};
  return kQualities;
}

/// The frame has the same bits always, and other bits than without the quality.
template <class Random>
void expect_same_bits_under_caps(const Random& random) {
  const auto in_full = [&](Frame& frame) { random.record(frame); };
  const Fingerprint plain = stored(random.format, in_full, renderer({1, 64, InstructionSet::automatic}));
  for (const Quality& quality : qualities()) {
    SCOPED_TRACE(testing::Message() << "quality " << &quality - qualities().data());
    const auto record = [&](Frame& frame) {
      frame.set_quality(quality);
      random.record(frame);
    };
    expect_same_bits_always(random.format, record);
    EXPECT_NE(stored(random.format, record, renderer({1, 64, InstructionSet::automatic})), plain);
  }
}

TEST(Determinism, TrianglesUnderCapsHaveTheSameBits) {
  expect_same_bits_under_caps(RandomFrame({.width = 150, .height = 90}, 400));
}
TEST(Determinism, TrianglesUnderCapsHaveTheSameBitsWithFourSamples) {
  expect_same_bits_under_caps(RandomFrame({.width = 110, .height = 70, .samples = 4}, 300));
}
TEST(Determinism, TrianglesUnderCapsHaveTheSameBitsInPaletteColors) {
  expect_same_bits_under_caps(
      RandomFrame({.width = 110, .height = 70, .color_mode = ColorMode::index, .color_bits = 8}, 200));
}
TEST(Determinism, EveryOperationUnderCapsHasTheSameBits) {
  expect_same_bits_under_caps(RandomOperations(full_format(1)));
}
TEST(Determinism, EveryOperationUnderCapsHasTheSameBitsWithFourSamples) {
  expect_same_bits_under_caps(RandomOperations(full_format(4)));
}

PictureHashes hashes_of_scenes() {
  PictureHashes hashes;
  for (const std::string& name : scene_names()) {
    const Scene scene = scene_of(name);
    hashes[name] = picture_hash(stored(
        scene.framebuffer, [&](Frame& frame) { record(scene, frame); }, renderer({})));
  }
  return hashes;
}

PictureHashes hashes_of_random_frames() {
  PictureHashes hashes;
  const auto add = [&](const char* name, const auto& random) {
    hashes[name] = picture_hash(stored(
        random.format, [&](Frame& frame) { random.record(frame); }, renderer({})));
  };
  add("triangles_unorm24", RandomFrame({.width = 150, .height = 90, .depth = DepthFormat::unorm24}, 500));
  add("triangles_palette_unorm32", RandomFrame({.width = 150,
                                                .height = 90,
                                                .color_mode = ColorMode::index,
                                                .color_bits = 8,
                                                .depth = DepthFormat::unorm32},
                                               500));
  add("triangles_16_bits_float32_samples_4",
      RandomFrame({.width = 150, .height = 90, .color_bits = 16, .depth = DepthFormat::float32, .samples = 4},
                  500));
  add("operations_unorm24", RandomOperations(full_format(1)));
  add("operations_plain_unorm24", RandomOperations({.width = 173, .height = 107}));
  add("operations_unorm24_samples_8", RandomOperations(full_format(8)));
  add("operations_palette_unorm32", RandomOperations({.width = 133,
                                                      .height = 71,
                                                      .color_mode = ColorMode::index,
                                                      .color_bits = 8,
                                                      .depth = DepthFormat::unorm32}));
  add("operations_grey_unorm16", RandomOperations({.width = 133,
                                                   .height = 71,
                                                   .color_bits = 2,
                                                   .depth = DepthFormat::unorm16,
                                                   .stencil_bits = 3,
                                                   .accumulation_bits = 32}));
  return hashes;
}

// With TESSERA_WRITE_HASHES set, writes the list instead.
void expect_hashes_of(const std::string& list, const PictureHashes& now) {
  const char* const write = std::getenv("TESSERA_WRITE_HASHES");
  if (write != nullptr && std::string(write) == "1") {
    std::ofstream out(list);
    for (const auto& [name, hash] : now) out << name << ' ' << to_text(hash) << '\n';
    ASSERT_TRUE(out.flush()) << list << " cannot be written";
    GTEST_SKIP() << "wrote " << list;
  }
  PictureHashes expected = parse_picture_hashes(read_text_file(list), list);
  for (const auto& [name, hash] : now) {
    if (!expected.contains(name)) ADD_FAILURE() << name << " has no hash in " << list;
    else
      EXPECT_EQ(to_text(hash), to_text(expected[name]))
          << name << ": colour, depth, stencil and accumulation";
    expected.erase(name);
  }
  for (const auto& [name, hash] : expected)
    ADD_FAILURE() << list << " has a hash of " << name << ", which no picture has";
}

TEST(PictureHashes, EverySceneMatchesItsHash) { expect_hashes_of(kHashes, hashes_of_scenes()); }
TEST(PictureHashes, EveryRandomFrameMatchesItsHash) {
  expect_hashes_of(kRandomHashes, hashes_of_random_frames());
}

}  // namespace
}  // namespace tessera::determinism_test
