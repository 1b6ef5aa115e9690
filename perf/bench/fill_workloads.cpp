// 16 layers over the whole window, two triangles each, one workload per fragment path.
#include "perf/bench/fill_workloads.h"

#include <cmath>
#include <cstdlib>

#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/bench/passing_stages.h"
#include "perf/rivals/literal_shaders.h"

namespace tessera::bench {
namespace {

constexpr int kLayers = 16;
constexpr int kTextureSize = 256;
// Irregular, so that no pixel centre lies on a texel border at any frame size.
constexpr float kMagnifiedTexelsPerPixel = 0.7013f;

using rivals::Varying;

using ChangeLayer = std::function<void(int layer, DrawState&)>;

std::uint64_t area(int width, int height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

/// Layers from back to front: window depth 0.9, 0.85, ...
Drawing layers(int width, int height, float texture_repeats, const ChangeLayer& change) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height, .stencil_bits = 0};
  for (int k = 0; k < kLayers; ++k)
    drawing.meshes.push_back(window_grid(1, 1, 0.8f - 0.1f * static_cast<float>(k), 0, texture_repeats));
  drawing.immediate_shading = true;
  drawing.fragments = kLayers * area(width, height);
  drawing.roofline = Roofline::tile_stores;
  drawing.pixel_bytes = 4;  // colour, or depth if nothing else is written
  drawing.roofline_bytes = drawing.pixel_bytes * drawing.fragments;
  drawing.record = [change](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    for (int k = 0; k < kLayers; ++k) {
      DrawState state;
      state.lighting = false;
      state.depth.enabled = false;
      change(k, state);
      if (!d.textures.empty()) state.texture = &d.textures.front();
      frame.draw(d.meshes[static_cast<std::size_t>(k)].view(), state);
    }
  };
  return drawing;
}

/// Counts depth or stencil stores in addition to colour.
void add_depth_or_stencil_store(Drawing& drawing) {
  drawing.pixel_bytes *= 2;
  drawing.roofline_bytes *= 2;
}

/// All layers as one mesh. `change` adjusts the state that they share.
std::function<GlWorkload(const Drawing&)> as_gl_workload(Varying varying, const Color& color,
                                                         std::function<void(GlWorkload&)> change = {}) {
  return [=](const Drawing& drawing) {
    GlWorkload gl;
    gl.mesh = merged(drawing.meshes);
    if (varying != Varying::colors) gl.mesh.colors.clear();
    if (varying != Varying::texcoords) gl.mesh.texcoords.clear();
    gl.shaders = rivals::window_shaders(varying, color);
    if (change) change(gl);
    return gl;
  };
}

/// Check that every pixel has this colour.
std::function<std::string(const Picture&)> all_of(int r, int g, int b) {
  return [=](const Picture& picture) {
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
      if (picture.rgba[i] != r || picture.rgba[i + 1] != g || picture.rgba[i + 2] != b)
        return std::string("a pixel does not have the colour of the last layer");
    return std::string();
  };
}

/// One colour per layer, without vertex colours.
Drawing flat_layers(int width, int height) {
  Drawing drawing = layers(width, height, 1, [](int k, DrawState& state) {
    state.material.diffuse = {1, 128 / 255.0f, static_cast<float>(k) / 255, 1};
  });
  for (MeshData& mesh : drawing.meshes) mesh.colors.clear();
  // The rival draws all layers in the colour of the last one: a single constant is fastest.
  drawing.gl_workload = as_gl_workload(Varying::nothing, {1, 128 / 255.0f, (kLayers - 1) / 255.0f, 1});
  drawing.fault = all_of(255, 128, kLayers - 1);
  return drawing;
}

/// Red runs from 0 at the left edge to 1, blue from 1 to 0, green from 0 at the bottom edge to 1.
std::string colors_across(const Picture& picture) {
  const std::uint8_t* pixel = picture.rgba.data();
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, pixel += 4) {
      const double u = (x + 0.5) / picture.width;
      const double v = 1 - (y + 0.5) / picture.height;
      const double expected[] = {u, v, 1 - u};
      for (int c = 0; c < 3; ++c)
        if (std::abs(pixel[c] - 255 * expected[c]) > 0.51)
          return "pixel " + std::to_string(x) + " of row " + std::to_string(y) +
                 " is more than half a level off";
    }
  return {};
}

Drawing gouraud_layers(int width, int height, const ChangeLayer& change,
                       std::function<void(GlWorkload&)> change_gl_workload = {}) {
  Drawing drawing = layers(width, height, 1, change);
  drawing.fault = colors_across;
  drawing.gl_workload = as_gl_workload(Varying::colors, {}, std::move(change_gl_workload));
  return drawing;
}

void with_depth(int, DrawState& state) { state.depth.enabled = true; }

Drawing gouraud_depth_layers(int width, int height) {
  Drawing drawing = gouraud_layers(width, height, with_depth, [](GlWorkload& gl) { gl.tests_depth = true; });
  add_depth_or_stencil_store(drawing);
  return drawing;
}

Drawing depth_layers(int width, int height) {
  Drawing drawing = layers(width, height, 1, [](int k, DrawState& state) {
    with_depth(k, state);
    state.color_mask = {false, false, false, false};
  });
  for (MeshData& mesh : drawing.meshes) mesh.colors.clear();
  // White wherever the depth of the last layer is stored.
  drawing.reveal = [](const Drawing& d, Frame& frame) {
    frame.draw(d.meshes.back().view(),
               {.material = {.diffuse = {1, 1, 1, 1}}, .lighting = false, .depth = {.test = Compare::equal}});
  };
  drawing.tested_fragments = drawing.fragments;
  drawing.fragments = area(width, height);
  drawing.fault = all_of(255, 255, 255);
  drawing.gl_workload =
      as_gl_workload(Varying::nothing, {1, 1, 1, 1},
                     [indices = static_cast<int>(drawing.meshes.back().indices.size())](GlWorkload& gl) {
                       gl.tests_depth = true;
                       gl.writes_color = false;
                       gl.revealed_indices = indices;
                     });
  return drawing;
}

Drawing blended_layers(int width, int height) {
  Drawing drawing = layers(width, height, 1, [](int, DrawState& state) { state.blend = BlendState{}; });
  for (MeshData& mesh : drawing.meshes)
    for (std::size_t i = 3; i < mesh.colors.size(); i += 4) mesh.colors[i] = 0.5f;
  drawing.gl_workload = as_gl_workload(Varying::colors, {}, [](GlWorkload& gl) { gl.blends = true; });
  return drawing;
}

Drawing stencilled_layers(int width, int height) {
  Drawing drawing = gouraud_layers(
      width, height,
      [](int, DrawState& state) {
        state.stencil = StencilState{.front = {.func = Compare::less, .ref = 0, .zpass = StencilOp::incr}};
      },
      [](GlWorkload& gl) { gl.increments_stencil = true; });
  drawing.format.stencil_bits = 8;
  add_depth_or_stencil_store(drawing);
  const auto record = drawing.record;
  drawing.record = [record](const Drawing& d, Frame& frame) {
    frame.clear({.stencil = 1u});
    record(d, frame);
  };
  return drawing;
}

/// @param texels_per_pixel  along x
Drawing textured_layers(int width, int height, const TextureSampler& sampler, float texels_per_pixel) {
  Drawing drawing = layers(width, height, texels_per_pixel * static_cast<float>(width) / kTextureSize,
                           [](int, DrawState& state) { state.texture_env = TextureEnv::replace; });
  std::vector<std::uint8_t> texels(4 * kTextureSize * kTextureSize);
  for (std::size_t i = 0; i < texels.size(); ++i)
    texels[i] = static_cast<std::uint8_t>((i * 2654435761u) >> 13);
  drawing.textures.emplace_back(
      TextureImage{.pixels = texels.data(), .width = kTextureSize, .height = kTextureSize, .channels = 4},
      sampler);
  drawing.gl_workload = as_gl_workload(Varying::texcoords, {}, [texels, sampler](GlWorkload& gl) {
    gl.texture_size = kTextureSize;
    gl.sampler = sampler;
    // The texels are noise: at borders of texels and mipmap levels the last bits of a coordinate are visible.
    gl.max_mismatch_share = 0.03;
    // OpenGL's first row is the bottom one.
    for (int y = kTextureSize - 1; y >= 0; --y)
      gl.texels.insert(gl.texels.end(), texels.begin() + 4 * kTextureSize * y,
                       texels.begin() + 4 * kTextureSize * (y + 1));
  });
  return drawing;
}

/// Deferred shading: only visible pixels are textured.
Drawing hidden_layers(int width, int height) {
  Drawing drawing = textured_layers(width, height, {}, 1.5f);
  drawing = Drawing{
      .format = drawing.format, .meshes = std::move(drawing.meshes), .textures = std::move(drawing.textures)};
  drawing.fragments = area(width, height);
  drawing.record = [](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.lighting = false;
    state.texture_env = TextureEnv::replace;
    state.texture = &d.textures.front();
    for (const MeshData& mesh : d.meshes) frame.draw(mesh.view(), state);
  };
  return drawing;
}

WorkloadEntry fill_entry(const std::string& name, const std::string& description,
                         std::function<Drawing(int width, int height)> make) {
  return drawn(
      "fill-" + name, "16 full-screen layers, " + description,
      [make = std::move(make)](int width, int height, std::uint32_t) { return make(width, height); });
}

}  // namespace

WorkloadEntry fill_with_stage() {
  WorkloadEntry entry = drawn_outside_mean(
      "stage-fill-gouraud", "fill-gouraud with a fragment stage that passes colours through",
      [](int w, int h, std::uint32_t) {
        Drawing drawing =
            gouraud_layers(w, h, [](int, DrawState& state) { state.fragment_stage = kPassingFragmentStage; });
        drawing.gl_workload = nullptr;
        return drawing;
      });
  entry.baseline = "fill-gouraud";
  return entry;
}

std::vector<WorkloadEntry> fill_workloads() {
  const auto plain = [](int, DrawState&) {};
  return {
      fill_entry("flat", "one colour per layer", flat_layers),
      fill_entry("gouraud", "colours interpolated",
                 [=](int w, int h) { return gouraud_layers(w, h, plain); }),
      fill_entry("gouraud-z", "colours interpolated, depth tested and written", gouraud_depth_layers),
      fill_entry("z", "depth only", depth_layers),
      fill_entry("blend", "colours interpolated and blended by alpha", blended_layers),
      fill_entry("stencil", "colours interpolated, stencil tested and incremented", stencilled_layers),
      fill_entry("nearest", "nearest texel",
                 [](int w, int h) {
                   return textured_layers(w, h,
                                          {.mag = TextureFilter::nearest, .min = TextureFilter::nearest},
                                          kMagnifiedTexelsPerPixel);
                 }),
      fill_entry("bilinear", "bilinear texture",
                 [](int w, int h) {
                   return textured_layers(w, h, {.mag = TextureFilter::linear, .min = TextureFilter::linear},
                                          kMagnifiedTexelsPerPixel);
                 }),
      fill_entry("trilinear", "trilinear texture",
                 [](int w, int h) {
                   return textured_layers(
                       w, h, {.mag = TextureFilter::linear, .min = TextureFilter::linear_mipmap_linear},
                       1.5f);
                 }),
      drawn_outside_mean(
          "fill-hidden",
          "16 full-screen layers, trilinear texture, each hides the one before; shading is deferred",
          [](int w, int h, std::uint32_t) { return hidden_layers(w, h); }),
  };
}

}  // namespace tessera::bench
