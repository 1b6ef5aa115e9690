// Coverage of triangles on each pixel path. Most draws do not use the additive blending that other coverage
// tests count with. Each triangle is nearer than all before it, so exact integers determine which triangle is
// visible, how often each pixel was drawn, and its depth. No tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/visibility_oracle.h"

namespace tessera::test::coverage_of_draws_test {
namespace {

constexpr std::size_t kPixels = std::size_t{VisibilityOracle::kSide} * VisibilityOracle::kSide;

/// A colour path.
struct ShadingPath {
  std::string name;
  std::function<void(DrawState&)> change{};
  bool has_color = true;
  std::optional<TextureFilter> filter{};  // texture filter; the texels are the colours

  friend std::ostream& operator<<(std::ostream& out, const ShadingPath& path) { return out << path.name; }
};

const ShadingPath kShadingPaths[] = {
    {"flat", [](DrawState& state) { state.shading = Shading::flat; }},
    {"gouraud", [](DrawState&) {}},
    {"phong",
     [](DrawState& state) {
       state.lighting = true;
       state.shading = Shading::phong;
       state.material = {.ambient = {0, 0, 0, 1}, .diffuse = {0, 0, 0, 1}};
       state.color_material = ColorMaterial::emission;
     }},
    {"nearest", [](DrawState& state) { state.texture_env = TextureEnv::replace; }, true,
     TextureFilter::nearest},
    {"bilinear", [](DrawState& state) { state.texture_env = TextureEnv::replace; }, true,
     TextureFilter::linear},
    // An alpha of 1.
    {"blended", [](DrawState& state) { state.blend = BlendState{}; }},
    {"alpha_test", [](DrawState& state) { state.alpha_test = AlphaTest{}; }},
    {"depth_alone",
     [](DrawState& state) {
       state.color_mask = {false, false, false, false};
     },
     false},
};

struct Depth {
  std::string name;
  DepthFormat format = DepthFormat::none;
  Compare test = Compare::always;
};
const Depth kDepths[] = {{"no depth"},
                         {"24 bits, less", DepthFormat::unorm24, Compare::less},
                         {"24 bits, lequal", DepthFormat::unorm24, Compare::lequal},
                         {"16 bits, less", DepthFormat::unorm16, Compare::less},
                         {"32 bits, less", DepthFormat::unorm32, Compare::less},
                         {"float, less", DepthFormat::float32, Compare::less},
                         {"float, lequal", DepthFormat::float32, Compare::lequal}};

struct Painter {
  std::string name;
  RendererOptions options;
  std::unique_ptr<Renderer> renderer;
};
std::vector<Painter> painters() {
  std::vector<Painter> painters;
  for (const InstructionSet set : available_instruction_sets())
    for (const int tile_size : {32, 64, 128})
      for (const bool defers : {false, true}) {
        const RendererOptions options{
            .threads = 1, .tile_size = tile_size, .instruction_set = set, .debug = {.defer_shading = defers}};
        painters.push_back({std::string(name(set)) + ", tiles of " + std::to_string(tile_size) +
                                (defers ? "" : ", shaded at once"),
                            options, std::make_unique<Renderer>(options)});
      }
  return painters;
}

std::vector<VisibilityOracle> meshes() {
  std::vector<VisibilityOracle> meshes;
  for (int n = 0; n < (long_tests() ? 600 : 6); ++n) meshes.push_back(VisibilityOracle::of_shapes(n));
  for (int n = 0; n < (long_tests() ? 500 : 5); ++n)
    meshes.push_back(
        VisibilityOracle::of_grid(n, std::array{1.5, 5.0, 9.0, 26.0, 60.0}[static_cast<std::size_t>(n % 5)]));
  return meshes;
}

/// Wrong pixels, summed over all frames.
struct Wrong {
  long double colors = 0;
  long double depths = 0;
  long double counts = 0;  ///< stencil
  long double times = 0;   ///< fragments
  bool any() const { return colors + depths + counts + times > 0; }
};

class CoverageOfDraws : public testing::TestWithParam<ShadingPath> {
 protected:
  CoverageOfDraws() {
    if (!GetParam().filter) return;
    const std::vector<std::uint8_t> texels = VisibilityOracle::texels();
    const TextureImage image{.pixels = texels.data(),
                             .width = VisibilityOracle::kTextureSide,
                             .height = VisibilityOracle::kTextureSide,
                             .channels = 4,
                             .bottom_row_first = true};
    texture_.emplace(image, TextureSampler{.mag = *GetParam().filter, .min = *GetParam().filter});
  }

  void draw(const Depth& depth, bool counts, const VisibilityOracle& mesh, Painter& painter) {
    FrameBuffer buffer({.width = VisibilityOracle::kSide,
                        .height = VisibilityOracle::kSide,
                        .depth = depth.format,
                        .stencil_bits = 8});
    const ShadingPath& path = GetParam();
    DrawState state{.lighting = false};
    path.change(state);
    if (texture_) state.texture = &*texture_;
    state.depth = {.enabled = depth.format != DepthFormat::none, .test = depth.test};
    if (counts) state.stencil = StencilState{.front = {.zpass = StencilOp::incr_wrap}};
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1},
                 .depth = state.depth.enabled ? std::optional(1.0) : std::nullopt,
                 .stencil = 0u});
    frame.draw({.positions = mesh.positions,
                .normals = state.lighting ? FloatArray(mesh.normals) : FloatArray(),
                .colors = mesh.colors,
                .texcoords = state.texture != nullptr ? FloatArray(mesh.texcoords) : FloatArray()},
               state);
    const FrameStats stats = painter.renderer->finish(frame);

    Wrong here;
    buffer.read_packed_colors(words_);
    for (std::size_t i = 0; i < kPixels; ++i) {
      const std::uint32_t expected = path.has_color ? mesh.color_word(i) : 0;
      here.colors += words_[i] != expected ? 1 : 0;
    }
    if (state.depth.enabled) {
      buffer.read_stored_depths(words_);
      for (std::size_t i = 0; i < kPixels; ++i)
        here.depths += words_[i] != mesh.depth_word(i, depth.format) ? 1 : 0;
    }
    if (counts) {
      buffer.read_stencil(stencil_);
      for (std::size_t i = 0; i < kPixels; ++i) here.counts += stencil_[i] != (mesh.times(i) & 255) ? 1 : 0;
    }
    // Fragments that were drawn and later hidden show up only in this count.
    if (path.has_color && !painter.options.debug.defer_shading)
      here.times =
          std::abs(static_cast<long double>(stats.shaded_pixels) - static_cast<long double>(mesh.covered));
    if (here.any() && !wrong_.any())
      ADD_FAILURE() << path.name << ", " << depth.name << (counts ? ", counted" : "") << ", " << painter.name
                    << ": colours wrong " << here.colors << ", depths " << here.depths << ", counts "
                    << here.counts << ", drawn " << stats.shaded_pixels << " instead of " << mesh.covered;
    wrong_.colors += here.colors;
    wrong_.depths += here.depths;
    wrong_.counts += here.counts;
    wrong_.times += here.times;
  }

  Wrong wrong_;

 private:
  std::optional<Texture> texture_;
  std::vector<std::uint32_t> words_ = std::vector<std::uint32_t>(kPixels);
  std::vector<std::uint8_t> stencil_ = std::vector<std::uint8_t>(kPixels);
};

TEST_P(CoverageOfDraws, EqualsExactIntegers) {
  const std::vector<VisibilityOracle> all = meshes();
  std::vector<Painter> by = painters();
  std::size_t turn = 0;
  for (const Depth& depth : kDepths)
    for (const bool counts : {false, true}) {
      // Nothing is stored.
      if (!GetParam().has_color && depth.format == DepthFormat::none && !counts) continue;
      for (std::size_t n = 0; n < std::max(all.size(), by.size()); ++n)
        draw(depth, counts, all[turn++ % all.size()], by[n % by.size()]);
    }
  const std::string name = "covered exactly, " + GetParam().name;
  expect_within(name + ": pixels of another colour", wrong_.colors, 0, "pixels");
  expect_within(name + ": of another depth", wrong_.depths, 0, "pixels");
  expect_within(name + ": counted in the stencil otherwise", wrong_.counts, 0, "pixels");
  if (GetParam().has_color) expect_within(name + ": drawn more or less often", wrong_.times, 0, "pixels");
}
INSTANTIATE_TEST_SUITE_P(Paths, CoverageOfDraws, testing::ValuesIn(kShadingPaths),
                         [](const auto& path) { return path.param.name; });

}  // namespace
}  // namespace tessera::test::coverage_of_draws_test
