#include "tests/numerics/case_renderer.h"

#include <cmath>

#include "tests/numerics/bounds.h"

namespace tessera::test {
namespace {

class TesseraCases : public CaseRenderer {
 public:
  TesseraCases(const CaseFormat& format, const RendererOptions& options)
      : format_(format),
        buffer_({.width = format.width, .height = format.height, .depth = format.depth, .stencil_bits = 0}),
        renderer_(options),
        words_(static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height)) {
    const TextureFilter filter = format.nearest_texel ? TextureFilter::nearest : TextureFilter::linear;
    if (format.texture_width > 0)
      texture_.emplace(TextureImage{.pixels = format.texture.data(),
                                    .width = format.texture_width,
                                    .height = format.texture_height,
                                    .channels = 1,
                                    .bottom_row_first = true},
                       TextureSampler{.mag = filter, .min = filter});
  }

  const CasePicture& draw(const std::vector<CaseDraw>& draws) override {
    Frame frame(buffer_);
    frame.set_camera({.reversed = format_.reversed});
    const bool has_depth = format_.depth != DepthFormat::none;
    frame.clear({.color = Color{0, 0, 0, 1},
                 .depth = has_depth ? std::optional<double>(format_.cleared_depth) : std::nullopt});
    for (const CaseDraw& d : draws) {
      DrawState state;
      state.lighting = false;
      state.material.diffuse = d.color;
      state.depth = {.enabled = d.test_depth, .test = d.depth_func};
      state.depth_near = d.depth_near;
      state.depth_far = d.depth_far;
      state.viewport = d.viewport;
      state.transform = d.transform.value_or(Matrix{});
      state.polygon_offset = d.offset;
      if (d.add) state.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one};
      if (d.textured) {
        state.texture = &*texture_;
        state.texture_env = TextureEnv::replace;
      }
      frame.draw({.primitive = d.primitive,
                  .positions = d.positions,
                  .position_components = 4,
                  .colors = d.colors,
                  .indices = d.indices,
                  .texcoords = d.texcoords},
                 state);
    }
    renderer_.finish(frame);
    buffer_.read_packed_colors(words_);
    picture_.colors.resize(words_.size());
    for (std::size_t i = 0; i < words_.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        picture_.colors[i][c] = static_cast<float>(words_[i] >> (16 - 8 * c) & 255) / 255.0f;
    if (has_depth) {
      picture_.depth.resize(words_.size());
      buffer_.read_stored_depths(picture_.depth);
    }
    return picture_;
  }

 private:
  CaseFormat format_;
  FrameBuffer buffer_;
  Renderer renderer_;
  std::optional<Texture> texture_;
  std::vector<std::uint32_t> words_;
  CasePicture picture_;
};

}  // namespace

std::vector<int> CaseRenderer::count(const std::vector<CaseDraw>& draws) {
  const CasePicture& picture = draw(draws);
  std::vector<int> counts;
  for (const std::array<float, 3>& color : picture.colors)
    counts.push_back(static_cast<int>(std::lround(color[2] * 255)));
  return counts;
}

std::unique_ptr<CaseRenderer> make_tessera(const CaseFormat& format, const RendererOptions& options) {
  return std::make_unique<TesseraCases>(format, options);
}

#ifndef TESSERA_HAS_MESA
std::unique_ptr<CaseRenderer> make_mesa(const CaseFormat&) { return nullptr; }
#endif

void expect_figure(const std::string& quantity, long double promised, const std::string& unit,
                   const std::function<long double(const MakeRenderer& make, bool is_tessera)>& figure) {
  expect_within(quantity, figure([](const CaseFormat& format) { return make_tessera(format); }, true),
                promised, unit);
#ifdef TESSERA_HAS_MESA
  report_mesa_figure(quantity, figure([](const CaseFormat& format) { return make_mesa(format); }, false));
#endif
}

}  // namespace tessera::test
