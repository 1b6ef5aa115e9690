// Everything that can be specified for a frame, as one object whose fields may hold any value; and the
// outcome: an error from one of the calls, or a picture.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::test {

/// One value for each field of each struct of the interface. `texels` is memory for images of up to 16384
/// pixels in one direction.
struct InterfaceCase {
  std::string name;
  RendererOptions options{.threads = 1};
  FrameBufferFormat format{.width = 48, .height = 36};
  Camera camera{.view = translate(0, 0, -4), .projection = perspective(50, 48.0 / 36, 1, 9)};
  std::vector<Light> lights;
  LightModel model;
  Clear clear{.color = Color{0.25f, 0.5f, 0.75f, 1}};
  MeshData data;
  DrawState state;
  TextureImage image{.width = 8, .height = 4};
  TextureSampler sampler;
  bool textured = false;
  Bitmap bitmap{.width = 9, .height = 5, .x = 4, .y = 3, .depth = 0.1};
  PixelImage pixels{.width = 7, .height = 6, .x = 30, .y = 20, .zoom_x = 1.5, .zoom_y = 1.25, .depth = 0.2};
  FragmentState fragments;
  std::optional<Accum> accum;
  ImageTarget target;
  std::vector<Buffer> kept{Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

  InterfaceCase() {
    static const std::vector<std::uint8_t> texels = [] {
      std::vector<std::uint8_t> bytes(1 << 20);
      Random random(21);
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
      return bytes;
    }();
    image.pixels = pixels.pixels = bitmap.bits = texels.data();
    Random random(22);
    // Triangles, lines or points; some reach beyond the near plane and the window.
    for (int i = 0; i < 30; ++i) {
      for (int c = 0; c < 3; ++c) {
        data.positions.push_back(random.between(-2, 2));
        data.normals.push_back(random.between(-1, 1));
      }
      for (int c = 0; c < 4; ++c) data.colors.push_back(random.between(0, 1));
      for (int c = 0; c < 2; ++c) data.texcoords.push_back(random.between(-1, 2));
      data.color_indices.push_back(random.between(0, 300));
    }
    lights.resize(2);
    lights[1].position = {0.5f, 1, 2, 1};
    lights[1].spot_cutoff = 50;
    lights[1].spot_exponent = 3;
    lights[1].attenuation_linear = 0.2f;
    lights[1].attenuation_quadratic = 0.1f;
    model.local_viewer = model.two_sided = true;
    state.material.specular = {0.4f, 0.5f, 0.6f, 1};
    state.material.emission = {0.1f, 0, 0.05f, 1};
    state.material.shininess = 9;
    state.back_material = state.material;
    state.back_material->diffuse = {0.2f, 0.9f, 0.3f, 0.7f};
    state.viewport = Rect{3, 2, 40, 30};
    state.scissor = Rect{6, 4, 33, 25};
    state.point_size = 4.5f;
    state.line_width = 3;
    fragments.scissor = Rect{1, 1, 44, 33};
  }
};

/// Result of a case: an error, or the stored values of every buffer.
struct Outcome {
  /// The rejecting call and its error message.
  std::string refused_by;
  std::string message;
  Fingerprint fingerprint;
  std::vector<std::uint32_t> color;
  std::vector<std::uint32_t> depth;
  std::vector<std::uint32_t> shown;
  FrameStats stats;
};

/// Makes every call, in order, until one throws Error.
inline Outcome run(InterfaceCase& w, InstructionSet set) {
  Outcome outcome;
  const char* call = "Renderer";
  try {
    RendererOptions options = w.options;
    options.instruction_set = set;
    Renderer renderer(options);
    call = "FrameBuffer";
    FrameBuffer buffer(w.format);
    Frame frame(buffer);
    call = "Texture";
    std::optional<Texture> texture;
    if (w.textured) texture.emplace(w.image, w.sampler);
    w.state.texture = texture ? &*texture : nullptr;
    call = "Frame::keep";
    for (const Buffer which : w.kept) frame.keep({which});
    frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
    call = "Frame::set_camera";
    frame.set_camera(w.camera);
    call = "Frame::set_lights";
    frame.set_lights(w.lights);
    call = "Frame::set_light_model";
    frame.set_light_model(w.model);
    call = "Frame::clear";
    frame.clear(w.clear);
    call = "Frame::draw";
    frame.draw(w.data.view(), w.state);
    call = "Frame::draw_bitmap";
    frame.draw_bitmap(w.bitmap, w.fragments);
    call = "Frame::draw_image";
    frame.draw_image(w.pixels, w.fragments);
    call = "Frame::accumulate";
    if (w.accum) frame.accumulate(*w.accum);
    call = "Renderer::finish";
    outcome.shown.assign(pixel_count(buffer), 0xcdcdcdcdu);
    ImageTarget target = w.target;
    target.pixels = outcome.shown.data();
    if (target.width == 0) target.width = w.format.width;
    if (target.height == 0) target.height = w.format.height;
    if (target.stride_bytes == 0) target.stride_bytes = 4 * std::ptrdiff_t{w.format.width};
    outcome.stats = renderer.finish(frame, target);
    call = "FrameBuffer::read_packed_colors";
    outcome.fingerprint = fingerprint(buffer);
    outcome.color = packed_colors(buffer);
    if (w.format.depth != DepthFormat::none) outcome.depth = stored_depths(buffer);
  } catch (const Error& error) {
    outcome.refused_by = call;
    outcome.message = error.what();
  }
  return outcome;
}

/// Whether a pixel, counted from the lower left, is inside a rectangle of arbitrary values.
inline bool contains(const std::optional<Rect>& rect, int x, int y) {
  if (!rect) return true;
  const std::int64_t right = std::int64_t{rect->x} + rect->width;
  const std::int64_t top = std::int64_t{rect->y} + rect->height;
  return x >= rect->x && x < right && y >= rect->y && y < top;
}

/// Each case covers other fields: shadings, primitives, formats, tests, samples.
inline std::vector<InterfaceCase> interface_cases() {
  std::vector<InterfaceCase> all(7);
  all[0].name = "gouraud";
  all[0].format.stencil_bits = 5;
  all[0].clear = {
      .color = Color{0.25f, 0.5f, 0.75f, 1}, .depth = 0.9, .stencil = 3, .scissor = Rect{0, 0, 60, 60}};
  all[1].name = "phong, textured, blended";
  all[1].state.shading = Shading::phong;
  all[1].textured = true;
  all[1].state.texture_env = TextureEnv::blend;
  all[1].state.texture_env_color = {0.3f, 0.6f, 0.9f, 1};
  all[1].state.blend = BlendState{.src = BlendFactor::constant_color,
                                  .dst = BlendFactor::one_minus_constant_alpha,
                                  .color = {0.2f, 0.4f, 0.6f, 0.5f}};
  all[1].state.alpha_test = AlphaTest{.ref = 0.1f};
  all[1].state.color_material = ColorMaterial::diffuse;
  all[1].format.alpha_bits = 8;
  all[1].format.accumulation_bits = 16;
  all[1].clear.accumulation = Color{0.1f, -0.2f, 0.3f, 0.4f};
  all[1].accum = Accum{.op = AccumOp::accum, .value = 0.4, .scissor = Rect{2, 3, 30, 20}};
  all[2].name = "flat lines, stencil, 4 samples";
  all[2].state.shading = Shading::flat;
  all[2].data.primitive = Primitive::lines;
  all[2].format.samples = 4;
  all[2].format.depth = DepthFormat::float32;
  all[2].clear.depth = 0.8;
  all[2].state.depth_near = 0.1;
  all[2].state.depth_far = 0.9;
  all[2].state.stencil =
      StencilState{.front = {.func = Compare::gequal, .ref = 5, .zpass = StencilOp::incr_wrap},
                   .back = StencilFace{.ref = 2, .zfail = StencilOp::replace}};
  all[2].fragments.stencil = all[2].state.stencil;
  all[3].name = "index lighting, points";
  all[3].data.primitive = Primitive::points;
  all[3].format = {.width = 48,
                   .height = 36,
                   .color_mode = ColorMode::index,
                   .color_bits = 8,
                   .palette = {{0, 0, 0, 1}, {0.3f, 0.7f, 0.1f, 1}, {1, 1, 1, 1}},
                   .depth = DepthFormat::unorm32};
  all[3].state.material.index_ramp = {{3, 120, 250}};
  all[3].state.back_material->index_ramp = {{30, 20, 10}};
  all[3].clear = {.index = 7u, .depth = 1.0};
  all[4].name = "outlines with an offset, a logic operation";
  all[4].state.front_mode = PolygonMode::line;
  all[4].state.back_mode = PolygonMode::point;
  all[4].state.polygon_offset = {0.5f, 2};
  all[4].state.logic_op = LogicOp::bit_xor;
  all[4].state.provoking_vertex = ProvokingVertex::first;
  all[4].format.depth = DepthFormat::unorm32;
  all[4].format.accumulation_bits = 32;
  all[4].format.dither = Dither::bayer4;
  all[4].accum = Accum{.op = AccumOp::mult, .value = 2};
  all[5].name = "a shadow, reversed";
  all[5].state.shadow_on = ShadowOn{.plane = {0.1, 1, 0.2, 2}, .light = 1, .color = {0.1f, 0.2f, 0.3f, 1}};
  all[5].camera.projection = perspective(50, 48.0 / 36, 1, 9, true);
  all[5].camera.reversed = true;
  all[5].state.depth.test = Compare::greater;
  all[5].clear.depth = 0.0;
  all[5].format.depth = DepthFormat::unorm16;
  all[6].name = "filled with an offset, textured, 8 samples";
  all[6].state.polygon_offset = {0.5f, 2};
  all[6].textured = true;
  all[6].sampler.wrap_s = TextureWrap::mirrored_repeat;
  all[6].format.samples = 8;
  all[6].format.color_bits = 16;
  all[6].state.color_material = ColorMaterial::ambient_and_diffuse;
  all[6].target.region = Rect{5, 6, 20, 20};
  return all;
}

}  // namespace tessera::test
