// A frame with every fragment operation: triangles of all sizes, every other primitive, bitmaps and images,
// in draws that each enable different operations, with partial clears and accumulation in between. Every
// operation, factor and function occurs.
#pragma once

#include <vector>

#include "tests/engine/frame/pixel_support.h"

namespace tessera::test {

struct RandomOperations {
  FrameBufferFormat format;
  int draws;
  MeshData small;
  MeshData mixed;
  std::vector<MeshData> elements;  // one mesh per primitive
  std::vector<std::uint8_t> texels;
  std::vector<Texture> textures;
  std::vector<Light> lights;
  Camera camera;

  explicit RandomOperations(FrameBufferFormat f, int draw_count = 48)
      : format(std::move(f)), draws(draw_count) {
    Random random(7);
    Random texel_random(8);
    for (int i = 0; i < 40 * 40 * 4; ++i) texels.push_back(static_cast<std::uint8_t>(texel_random.next()));
    small = triangles(random, 60, 0.12f);
    mixed = triangles(random, 24, 0);
    Random element_random(9);
    for (int primitive = 0; primitive <= static_cast<int>(Primitive::polygon); ++primitive) {
      MeshData& mesh = elements.emplace_back(triangles(element_random, 4, primitive % 2 == 0 ? 0.5f : 0));
      mesh.primitive = static_cast<Primitive>(primitive);
      for (int i = 0; i < 12; ++i)
        mesh.texcoords.push_back(element_random.between(-2, 3)),
            mesh.texcoords.push_back(element_random.between(-2, 3));
    }
    for (int i = 0; i < 6; ++i)
      textures.emplace_back(
          TextureImage{
              .pixels = texels.data(), .width = 17 + i, .height = i == 1 ? 1 : 13, .channels = 1 + i % 4},
          TextureSampler{.mag = i % 2 == 0 ? TextureFilter::linear : TextureFilter::nearest,
                         .min = static_cast<TextureFilter>(i),
                         .wrap_s = static_cast<TextureWrap>(i % 3)});
    Light point;
    point.position = {1, 2, 0, 1};
    point.diffuse = {0.9f, 0.6f, 0.3f, 1};
    lights = {Light{}, point};
    camera.projection = perspective(60, static_cast<double>(format.width) / format.height, 0.5, 7);
  }

  /// Records the frame, which borrows the meshes and the texels.
  void record(Frame& frame) const {
    Random random(11);
    Random pixel_random(12);
    Random element_random(13);
    frame.clear(whole_clear());
    frame.set_camera(camera);
    frame.set_lights(lights);
    for (int i = 0; i < draws; ++i) {
      if (i % 5 == 4) frame.clear(clear_of_part(random));
      if (i % 4 == 3 && format.accumulation_bits > 0) frame.accumulate(accum(random, i / 4));
      frame.set_light_model({.local_viewer = i % 3 == 0, .two_sided = i % 2 == 0});
      frame.draw((i % 3 == 0 ? mixed : small).view(), state(random, i));
      if (i % 3 == 1) draw_pixels(frame, pixel_random, i);
      if (i % 2 == 1) draw_element(frame, element_random, i / 2);
    }
  }

 private:
  bool is_index() const { return format.color_mode == ColorMode::index; }
  bool has_depth() const { return format.depth != DepthFormat::none; }

  // Triangles of half size `size`, or of mixed sizes if it is 0.
  MeshData triangles(Random& random, int count, float size) const {
    MeshData mesh;
    for (int i = 0; i < count; ++i) {
      float half = i % 2 == 0 ? 0.9f : 0.3f;
      if (i % 6 == 0) half = 4.0f;
      if (size > 0) half = size;
      const float center[3] = {random.between(-2.5f, 2.5f), random.between(-1.8f, 1.8f),
                               random.between(-7, -1)};
      for (int k = 0; k < 3; ++k) {
        for (const float c : center) mesh.positions.push_back(c + random.between(-half, half));
        for (int c = 0; c < 3; ++c) mesh.normals.push_back(random.between(-1, 1));
        for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0, 1));
        if (is_index()) mesh.color_indices.push_back(random.between(0, 300));
      }
    }
    return mesh;
  }

  // A bitmap, or an image of 1 to 4 channels with any zoom.
  void draw_pixels(Frame& frame, Random& random, int i) const {
    const DrawState s = state(random, i);
    const double x = random.between(-20, static_cast<float>(format.width));
    const double y = random.between(-20, static_cast<float>(format.height));
    const double depth = random.between(0, 1);
    const double zoom_x = random.between(-4, 6);
    const double zoom_y = random.between(-4, 6);
    const int width = 1 + below(random, 40);
    const int height = 1 + below(random, 40);
    const int channels = 1 + i / 2 % 4;
    if (i % 2 == 0)
      frame.draw_bitmap({.bits = texels.data(),
                         .width = 8 * width,
                         .height = height,
                         .x = x,
                         .y = y,
                         .depth = depth,
                         .color = color(random)},
                        fragment_state(s));
    else
      frame.draw_image({.pixels = texels.data(),
                        .width = width,
                        .height = height,
                        .channels = channels,
                        .x = x,
                        .y = y,
                        .zoom_x = zoom_x,
                        .zoom_y = zoom_y,
                        .depth = depth},
                       fragment_state(s));
  }

  // Filled or outlined polygons; every second mesh is textured, some are drawn as planar shadows.
  void draw_element(Frame& frame, Random& random, int i) const {
    DrawState s = state(random, i);
    s.shading = static_cast<Shading>(i / 3 % 3);
    s.front_mode = static_cast<PolygonMode>(below(random, 3));
    s.back_mode = static_cast<PolygonMode>(below(random, 3));
    s.point_size = random.between(0.5f, 12);
    s.line_width = random.between(0.5f, 7);
    s.provoking_vertex = coin(random) ? ProvokingVertex::first : ProvokingVertex::last;
    if (coin(random))
      s.texture = &textures[static_cast<std::size_t>(below(random, static_cast<int>(textures.size())))];
    s.texture_env = static_cast<TextureEnv>(i % 5);
    s.texture_env_color = color(random);
    if (i % 7 == 6) s.shadow_on = ShadowOn{.plane = {0, 1, 0.1, 2}, .light = 1, .color = color(random)};
    frame.draw(elements[static_cast<std::size_t>(i) % elements.size()].view(), s);
  }

  static bool coin(Random& random) { return random.next() % 2 == 0; }
  static int below(Random& random, int n) {
    return static_cast<int>(random.next() % static_cast<std::uint32_t>(n));
  }
  Color color(Random& random) const {
    return {random.between(0, 1), random.between(0, 1), random.between(0, 1), random.between(0, 1)};
  }
  Rect part(Random& random) const {
    const int w = 1 + below(random, format.width);
    const int h = 1 + below(random, format.height);
    return {below(random, format.width) - w / 4, below(random, format.height) - h / 4, w, h};
  }

  Clear whole_clear() const {
    Clear clear{.color = Color{0.1f, 0.2f, 0.3f, 0.4f}};
    if (has_depth()) clear.depth = 1.0;
    if (format.stencil_bits > 0) clear.stencil = 1;
    return clear;
  }
  Clear clear_of_part(Random& random) const {
    Clear clear{.scissor = part(random)};
    if (coin(random)) clear.color = color(random);
    if (has_depth() && coin(random)) clear.depth = random.between(0.5f, 1);
    if (format.stencil_bits > 0 && coin(random)) clear.stencil = random.next() % (1u << format.stencil_bits);
    if (format.accumulation_bits > 0 && coin(random)) clear.accumulation = color(random);
    return clear;
  }
  Accum accum(Random& random, int turn) const {
    Accum accum{.op = static_cast<AccumOp>(turn % 5), .value = random.between(-0.3f, 1)};
    if (accum.op == AccumOp::return_color) accum.value = 1;
    if (coin(random)) accum.scissor = part(random);
    if (format.color_bits > 2 && coin(random))
      accum.color_mask = {coin(random), coin(random), true, coin(random)};
    return accum;
  }

  StencilFace face(Random& random, int turn) const {
    return {.func = static_cast<Compare>(turn % 3 == 0 ? turn / 3 % 8 : 7),
            .ref = random.next() % 256,
            .mask = random.next() % 256,
            .fail = static_cast<StencilOp>((3 * turn + 2) % 8),
            .zfail = static_cast<StencilOp>((5 * turn + 1) % 8),
            .zpass = static_cast<StencilOp>(turn % 8),
            .write_mask = coin(random) ? 255 : random.next() % 256};
  }

  void choose_tests(Random& random, int i, DrawState& s) const {
    if (i % 3 == 1 && !is_index())
      s.alpha_test = AlphaTest{static_cast<Compare>(i / 3 % 8), random.between(0, 1)};
    if (i % 4 != 1 && format.stencil_bits > 0) {
      s.stencil = StencilState{.front = face(random, i)};
      if (i % 2 == 0) s.stencil->back = face(random, i + 3);
    }
    if (!has_depth()) return;
    s.depth = {.enabled = i % 7 != 0,
               .test = i % 2 == 0 ? Compare::lequal : static_cast<Compare>(i / 2 % 8),
               .write = i % 5 != 2};
    if (coin(random)) s.polygon_offset = {random.between(-2, 2), random.between(-500, 500)};
    if (coin(random)) {
      s.depth_near = random.between(0, 0.3f);
      s.depth_far = random.between(0.6f, 1);
    }
  }

  void choose_writes(Random& random, int i, DrawState& s) const {
    const int turn = i / 2;
    if (i % 2 == 0 && !is_index()) {
      s.blend = BlendState{.src = static_cast<BlendFactor>((7 * turn + 6) % 15),
                           .dst = static_cast<BlendFactor>((4 * turn + 7) % 15),
                           .equation = static_cast<BlendEquation>(turn % 3 == 0 ? turn / 3 % 5 : 0),
                           .color = color(random)};
      if (coin(random)) s.blend->src_alpha = static_cast<BlendFactor>((2 * turn + 1) % 15);
      if (coin(random)) s.blend->dst_alpha = static_cast<BlendFactor>((11 * turn + 2) % 15);
    } else if (i % 4 == 1) {
      s.logic_op = static_cast<LogicOp>(5 * (i / 4) % 16);
    }
    if (i % 6 == 5) s.plane_mask = random.next();
    if (i % 5 != 3) return;
    const bool all = is_index() || format.color_bits <= 2;
    s.color_mask = all ? std::array<bool, 4>{true, true, true, coin(random)}
                       : std::array<bool, 4>{coin(random), coin(random), true, coin(random)};
  }

  DrawState state(Random& random, int i) const {
    DrawState s;
    s.material.diffuse = color(random);
    s.material.specular = {0.5f, 0.5f, 0.4f, 1};
    s.material.shininess = 12;
    if (is_index() && coin(random)) s.material.index_ramp = {{3, random.between(20, 200), 255}};
    if (i % 4 == 2) s.back_material = Material{.diffuse = color(random)};
    s.shading = static_cast<Shading>(i % 3);
    s.lighting = i % 4 != 3;
    if (coin(random)) s.color_material = ColorMaterial::ambient_and_diffuse;
    if (i % 8 == 6) s.cull = coin(random) ? Cull::back : Cull::front;
    if (i % 9 == 7) s.front_face = FrontFace::cw;
    // Separate statements: the order in which arguments of a call are evaluated is unspecified.
    const float x = random.between(-0.6f, 0.6f);
    const float y = random.between(-0.4f, 0.4f);
    const float z = random.between(-0.5f, 0.5f);
    s.transform = translate(x, y, z) * rotate(random.between(0, 360), 0, 0, 1);
    if (i % 3 == 2) s.scissor = part(random);
    choose_tests(random, i, s);
    choose_writes(random, i, s);
    return s;
  }
};

}  // namespace tessera::test
