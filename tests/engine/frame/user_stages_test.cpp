// User stages against draws without a stage that must give the same picture, and their errors.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/program/scene/builtin_mesh.h"
#include "tests/engine/frame/api_support.h"
#include "tests/examples/phong.h"

namespace tessera::test::user_stages_test {
namespace {

const FrameBufferFormat kFormat{.width = 90, .height = 60};

void keep_everything(const FragmentBlock&, void*) {}

FragmentStage pass_through() {
  return {.run = keep_everything,
          .name = "pass through",
          .reads = {.position = true, .depth = true, .color = true, .eye = true, .normal = true}};
}

/// A sphere of big and small triangles with colours, normals and texture coordinates.
const MeshData& ball() {
  static const MeshData kBall = [] {
    MeshData mesh = builtin_mesh("sphere", 9);
    Random random(3);
    for (std::size_t i = 0; i < mesh.positions.size() / 3; ++i)
      for (int c = 0; c < 4; ++c) mesh.colors.push_back(random.between(0.2f, 1));
    return mesh;
  }();
  return kBall;
}

/// Two balls that cut each other, with a perspective view; near parts are clipped.
struct Picture {
  FrameBuffer buffer;
  FrameStats stats;

  explicit Picture(const FrameBufferFormat& format) : buffer(format) {}
};

std::unique_ptr<Picture> picture(const FrameBufferFormat& format, const DrawState& state,
                                 const RendererOptions& options = {.threads = 2},
                                 const MeshData& mesh = ball()) {
  auto result = std::make_unique<Picture>(format);
  Frame frame(result->buffer);
  Clear clear{.color = Color{0.1f, 0.2f, 0.3f, 1}};
  if (format.depth != DepthFormat::none) clear.depth = 1.0;
  frame.clear(clear);
  frame.set_camera({.view = look_at({0.4f, 0.6f, 2.2f}, {0, 0, 0}, {0, 1, 0}),
                    .projection = perspective(50, 1.5, 0.9, 10)});
  Light point;
  point.position = {1, 2, 2, 1};
  frame.set_lights({Light{}, point});
  frame.set_light_model({.local_viewer = true, .two_sided = true});
  DrawState moved = state;
  frame.draw(mesh.view(), moved);
  moved.transform = translate(0.7, 0.2, 0.4) * rotate(70, 1, 1, 0);
  frame.draw(mesh.view(), moved);
  result->stats = Renderer(options).finish(frame);
  return result;
}

std::vector<std::uint32_t> colors_of(const FrameBuffer& buffer) {
  std::vector<std::uint32_t> colors(pixel_count(buffer));
  buffer.read_packed_colors(colors);
  return colors;
}

/// Largest difference of a component.
int largest_difference(const FrameBuffer& a, const FrameBuffer& b) {
  const std::vector<std::uint32_t> x = colors_of(a), y = colors_of(b);
  int largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int shift = 0; shift < 32; shift += 8)
      largest = std::max(
          largest, std::abs(static_cast<int>(x[i] >> shift & 255) - static_cast<int>(y[i] >> shift & 255)));
  return largest;
}

DrawState shiny(Shading shading) {
  DrawState state;
  state.shading = shading;
  state.material.specular = {0.6f, 0.6f, 0.6f, 1};
  state.material.shininess = 20;
  return state;
}

const Texture& checks() {
  static const std::uint8_t kTexels[] = {255, 40, 40,  255, 40,  255, 40,  60,
                                         40,  40, 255, 120, 200, 200, 200, 255};
  static const Texture kTexture({.pixels = kTexels, .width = 2, .height = 2, .channels = 4},
                                {.wrap_s = TextureWrap::repeat, .wrap_t = TextureWrap::repeat});
  return kTexture;
}

struct StateCase {
  const char* name;
  void (*change)(DrawState&);
};
const StateCase kStates[] = {
    {"plain", [](DrawState&) {}},
    {"unlit", [](DrawState& s) { s.lighting = false; }},
    {"tracked", [](DrawState& s) { s.color_material = ColorMaterial::ambient_and_diffuse; }},
    {"textured", [](DrawState& s) { s.texture = &checks(); }},
    {"blended",
     [](DrawState& s) {
       s.blend = BlendState{};
       s.material.diffuse.a = 0.5f;
     }},
    {"alpha test",
     [](DrawState& s) {
       s.texture = &checks();
       s.alpha_test = AlphaTest{};
     }},
    {"outlined",
     [](DrawState& s) {
       s.front_mode = s.back_mode = PolygonMode::line;
       s.line_width = 3;
     }},
    {"corners",
     [](DrawState& s) {
       s.front_mode = s.back_mode = PolygonMode::point;
       s.point_size = 3;
     }},
    {"offset",
     [](DrawState& s) {
       s.polygon_offset = {1, 2};
     }},
    {"no depth test", [](DrawState& s) { s.depth.enabled = false; }},
};

// Gouraud-shaded triangles are otherwise interpolated as levels, not as colours 0 to 1.
int rounding_of(Shading shading) { return shading == Shading::gouraud ? 1 : 0; }

TEST(UserStages, StagesThatPassValuesThroughChangeNothing) {
  for (const int samples : {1, 4})
    for (const Dither dither : {Dither::none, Dither::bayer4})
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
        for (const StateCase& c : kStates)
          for (const bool discards : {false, true}) {
            FrameBufferFormat format = kFormat;
            format.samples = samples;
            format.dither = dither;
            DrawState state = shiny(shading);
            c.change(state);
            const auto expected = picture(format, state);
            state.fragment_stage = pass_through();
            state.fragment_stage->discards = discards;
            // With several samples the depth of sample 0 would replace those of the others.
            state.fragment_stage->writes_depth = discards && samples == 1;
            state.vertex_stage = VertexStage{.run = [](const VertexBlock&, void*) {},
                                             .reads = {.object = true, .eye = true, .normal = true},
                                             .writes = {.eye = true, .normal = true}};
            const auto staged = picture(format, state);
            EXPECT_LE(largest_difference(staged->buffer, expected->buffer), rounding_of(shading))
                << c.name << ", " << samples << " samples, shading " << static_cast<int>(shading)
                << (discards ? ", before the tests" : "");
            EXPECT_EQ(fingerprint(staged->buffer).depth, fingerprint(expected->buffer).depth) << c.name;
          }
}

TEST(UserStages, ClipPositionsThatPassThroughMoveNothing) {
  for (const DepthFormat depth : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32}) {
    FrameBufferFormat format = kFormat;
    format.depth = depth;
    DrawState state = shiny(Shading::phong);
    const auto expected = picture(format, state);
    state.vertex_stage = VertexStage{
        .run = [](const VertexBlock&, void*) {}, .reads = {.clip = true}, .writes = {.clip = true}};
    const auto staged = picture(format, state);
    EXPECT_EQ(fingerprint(staged->buffer), fingerprint(expected->buffer));
    EXPECT_GT(staged->stats.clipped, 10u);
  }
}

TEST(UserStages, UnreadColorsAreNotComputed) {
  DrawState state = shiny(Shading::phong);
  state.fragment_stage = FragmentStage{.run = [](const FragmentBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      block.color[0][i] = 1;
      block.color[1][i] = block.color[2][i] = 0;
    }
  }};
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.draw(ball().view(), state);
  const std::string text = frame.explain(0);
  EXPECT_NE(text.find("shading: skipped, the fragment stage reads no colour"), std::string::npos) << text;
  EXPECT_NE(text.find("fragment stage custom: once per visible pixel"), std::string::npos) << text;
  EXPECT_EQ(text.find("light 0"), std::string::npos) << text;
  DrawState red;
  red.lighting = false;
  red.material.diffuse = {1, 0, 0, 1};
  const MeshData plain = [] {
    MeshData mesh = ball();
    mesh.colors.clear();
    return mesh;
  }();
  EXPECT_EQ(fingerprint(picture(kFormat, state)->buffer),
            fingerprint(picture(kFormat, red, {}, plain)->buffer));
}

// A stage that changes nothing but its colour runs once per visible pixel; repetitions may come on top.
TEST(UserStages, RunOncePerVisiblePixel) {
  std::atomic<std::size_t> runs = 0;
  DrawState state = shiny(Shading::phong);
  state.fragment_stage =
      FragmentStage{.run = [](const FragmentBlock& block,
                              void* data) { *static_cast<std::atomic<std::size_t>*>(data) += block.count; },
                    .data = &runs,
                    .reads = {.color = true}};
  const auto staged = picture(kFormat, state, {.threads = 1});
  EXPECT_GE(runs, staged->stats.shaded_pixels);
  EXPECT_LT(staged->stats.shaded_pixels, 90u * 60);
  EXPECT_LT(runs, 90u * 60 * 2);
}

TEST(UserStages, GetWindowPositionsAndDepths) {
  struct Seen {
    float x[60][90] = {}, y[60][90] = {};
    double depth[60][90] = {};
  } seen;
  DrawState state = unlit({1, 1, 1, 1});
  state.fragment_stage = FragmentStage{.run =
                                           [](const FragmentBlock& block, void* data) {
                                             Seen& s = *static_cast<Seen*>(data);
                                             for (std::size_t i = 0; i < block.count; ++i) {
                                               const int x = static_cast<int>(block.x[i]);
                                               const int y = static_cast<int>(block.y[i]);
                                               s.x[y][x] = block.x[i];
                                               s.y[y][x] = block.y[i];
                                               s.depth[y][x] = block.depth[i];
                                             }
                                           },
                                       .data = &seen,
                                       .reads = {.position = true, .depth = true}};
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{}, .depth = 1.0});
  MeshData slope = whole_window();
  for (std::size_t i = 0; i < 4; ++i)
    slope.positions[3 * i + 2] = slope.positions[3 * i] * 0.5f;  // z = x / 2
  frame.draw(slope.view(), state);
  Renderer({.threads = 1}).finish(frame);
  std::vector<float> depth(90 * 60);
  buffer.read_depth(depth);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 90; ++x) {
      EXPECT_EQ(seen.x[y][x], static_cast<float>(x) + 0.5f);
      EXPECT_EQ(seen.y[y][x], static_cast<float>(y) + 0.5f);
      EXPECT_EQ(static_cast<float>(seen.depth[y][x]), depth[static_cast<std::size_t>((59 - y) * 90 + x)]);
    }
}

// A draw that neither tests nor writes depth has depths all the same.
TEST(UserStages, ReadDepthWithoutADepthTest) {
  for (const bool discards : {false, true})
    for (const int samples : {1, 4}) {
      FrameBufferFormat format = kFormat;
      format.samples = samples;
      FrameBuffer buffer(format);
      Frame frame(buffer);
      frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
      DrawState state = unlit({1, 1, 1, 1});
      state.depth.enabled = false;
      state.fragment_stage = FragmentStage{.run =
                                               [](const FragmentBlock& block, void*) {
                                                 for (std::size_t i = 0; i < block.count; ++i)
                                                   block.color[0][i] = static_cast<float>(block.depth[i]);
                                               },
                                           .reads = {.depth = true, .color = true},
                                           .discards = discards};
      const MeshData mesh = whole_window(0.5f);
      frame.draw(mesh.view(), state);
      Renderer().finish(frame);
      for (const std::uint32_t color : colors_of(buffer)) ASSERT_EQ(color, 0xbfffffu) << samples << discards;
    }
}

TEST(UserStages, DiscardLikeAScissor) {
  DrawState state = shiny(Shading::phong);
  state.scissor = Rect{0, 0, 40, 60};
  const auto expected = picture(kFormat, state);
  state.scissor.reset();
  state.fragment_stage = FragmentStage{.run =
                                           [](const FragmentBlock& block, void*) {
                                             for (std::size_t i = 0; i < block.count; ++i)
                                               block.keep[i] = block.x[i] < 40;
                                           },
                                       .reads = {.position = true, .color = true},
                                       .discards = true};
  EXPECT_EQ(fingerprint(picture(kFormat, state)->buffer), fingerprint(expected->buffer));
}

TEST(UserStages, WriteDepthLikeADepthRange) {
  for (const DepthFormat depth : {DepthFormat::unorm16, DepthFormat::unorm24}) {
    FrameBufferFormat format = kFormat;
    format.depth = depth;
    DrawState state = shiny(Shading::phong);
    state.depth_near = 1;
    state.depth_far = 0;
    const auto expected = picture(format, state);
    std::swap(state.depth_near, state.depth_far);
    state.fragment_stage = FragmentStage{.run =
                                             [](const FragmentBlock& block, void*) {
                                               for (std::size_t i = 0; i < block.count; ++i)
                                                 block.depth[i] = 1 - block.depth[i];
                                             },
                                         .reads = {.depth = true, .color = true},
                                         .writes_depth = true};
    // A level in the middle between two rounds the other way.
    const auto staged = picture(format, state);
    const auto a = stored_depths(staged->buffer), b = stored_depths(expected->buffer);
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_LE(std::abs(static_cast<std::int64_t>(a[i]) - static_cast<std::int64_t>(b[i])), 1);
  }
}

TEST(UserStages, ColorsOfVerticesComeFromTheStage) {
  const auto paint = [](const VertexBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      block.color[0][i] = block.object[1][i] > 0 ? 1.0f : 0.25f;
      block.color[1][i] = 0.5f;
      block.color[2][i] = block.object[0][i] * 0.5f + 0.5f;
      block.color[3][i] = 1;
    }
  };
  MeshData painted = ball(), plain = ball();
  plain.colors.clear();
  painted.colors.clear();
  for (std::size_t i = 0; i < painted.positions.size(); i += 3) {
    const float x = painted.positions[i], y = painted.positions[i + 1];
    painted.colors.insert(painted.colors.end(), {y > 0 ? 1.0f : 0.25f, 0.5f, x * 0.5f + 0.5f, 1});
  }
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
    for (const bool lighting : {false, true}) {
      DrawState state = shiny(shading);
      state.lighting = lighting;
      state.color_material = ColorMaterial::diffuse;
      const auto expected = picture(kFormat, state, {.elide = false}, painted);
      state.vertex_stage = VertexStage{.run = paint, .reads = {.object = true}, .writes = {.color = true}};
      EXPECT_EQ(fingerprint(picture(kFormat, state, {}, plain)->buffer), fingerprint(expected->buffer))
          << static_cast<int>(shading) << lighting;
    }
}

TEST(UserStages, ExtrasAreInterpolatedLikeTextureCoordinates) {
  const auto from_object = [](const VertexBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      for (std::size_t k = 0; k < 8; ++k) block.extras[k][i] = static_cast<float>(k);
      for (std::size_t c = 0; c < 3; ++c) block.extras[c][i] = block.eye[c][i];
    }
  };
  struct Worst {
    std::atomic<float> difference = 0;
  } worst;
  const auto compare = [](const FragmentBlock& block, void* data) {
    Worst& w = *static_cast<Worst*>(data);
    for (std::size_t i = 0; i < block.count; ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        if (block.extras[c][i] != block.eye[c][i]) w.difference = 1;
      for (std::size_t k = 3; k < 8; ++k)
        if (block.extras[k][i] != static_cast<float>(k)) w.difference = 2;
    }
  };
  for (const int samples : {1, 4})
    for (const bool discards : {false, true})
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        FrameBufferFormat format = kFormat;
        format.samples = samples;
        DrawState state = shiny(shading);
        state.vertex_stage = VertexStage{.run = from_object, .reads = {.eye = true}, .extras = 8};
        state.fragment_stage = FragmentStage{.run = compare,
                                             .data = &worst,
                                             .reads = {.color = true, .eye = true, .extras = 8},
                                             .discards = discards};
        picture(format, state);
        EXPECT_EQ(worst.difference, 0.0f) << samples << discards << static_cast<int>(shading);
      }
}

TEST(UserStages, ColorsAreClampedAndNonFiniteOnesAreCounted) {
  const auto spoil = [](const FragmentBlock& block, void*) {
    for (std::size_t i = 0; i < block.count; ++i) {
      block.color[0][i] = 7;
      block.color[1][i] = -3;
      block.color[2][i] = block.x[i] < 10 ? std::numeric_limits<float>::quiet_NaN() : 0.5f;
      if (block.x[i] > 80) block.color[3][i] = std::numeric_limits<float>::infinity();
    }
  };
  for (const bool discards : {false, true})
    for (const int samples : {1, 4}) {
      FrameBufferFormat format = kFormat;
      format.samples = samples;
      FrameBuffer buffer(format);
      Frame frame(buffer);
      frame.clear({.color = Color{0.5f, 0.5f, 0.5f, 1}, .depth = 1.0});
      DrawState state = unlit({1, 1, 1, 1});
      state.fragment_stage =
          FragmentStage{.run = spoil, .reads = {.position = true, .color = true}, .discards = discards};
      const MeshData mesh = whole_window();
      frame.draw(mesh.view(), state);
      const FrameStats stats = Renderer().finish(frame);
      // With several samples, pixels on the diagonal have a fragment of each triangle.
      EXPECT_GE(stats.non_finite_fragments, 60u * 20);
      EXPECT_LE(stats.non_finite_fragments, samples == 1 ? 60u * 20 : 60u * 21);
      const auto colors = colors_of(buffer);
      EXPECT_EQ(colors[5], 0xff0000u);
      EXPECT_EQ(colors[50], 0xff0080u);
    }
}

TEST(UserStages, NonFiniteDepthDropsTheFragment) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  DrawState state = unlit({1, 1, 1, 1});
  state.fragment_stage =
      FragmentStage{.run =
                        [](const FragmentBlock& block, void*) {
                          for (std::size_t i = 0; i < block.count; ++i)
                            block.depth[i] = block.x[i] < 10 ? std::numeric_limits<double>::infinity() : 0.25;
                        },
                    .reads = {.position = true},
                    .writes_depth = true};
  const MeshData mesh = whole_window();
  frame.draw(mesh.view(), state);
  EXPECT_EQ(Renderer().finish(frame).non_finite_fragments, 600u);
  std::vector<float> depth(90 * 60);
  buffer.read_depth(depth);
  EXPECT_EQ(depth[5], 1.0f);
  EXPECT_NEAR(depth[20], 0.25f, 1e-6f);
}

TEST(UserStages, NonFiniteVerticesDropTheirTriangles) {
  for (const int which : {0, 1, 2, 3, 4}) {
    DrawState state = shiny(Shading::phong);
    state.vertex_stage = VertexStage{.run =
                                         [](const VertexBlock& block, void* data) {
                                           const float nan = std::numeric_limits<float>::quiet_NaN();
                                           if (block.first != 0) return;
                                           switch (*static_cast<const int*>(data)) {
                                             case 0: block.clip[2][0] = nan; break;
                                             case 1: block.eye[0][0] = nan; break;
                                             case 2: block.normal[1][0] = nan; break;
                                             case 3: block.color[3][0] = nan; break;
                                             default: block.extras[7][0] = nan;
                                           }
                                         },
                                     .data = const_cast<int*>(&which),
                                     .reads = {.eye = true, .clip = true, .normal = true, .color = true},
                                     .writes = {.eye = true, .clip = true, .normal = true, .color = true},
                                     .extras = 8};
    EXPECT_GT(picture(kFormat, state)->stats.dropped_non_finite, 0u) << which;
  }
}

// An exception of a stage comes out of finish(), and the same frame can be finished afterwards.
TEST(UserStages, ExceptionsEndTheFrame) {
  struct Fuse {
    std::atomic<int> left;
    static void burn(void* data) {
      if (--static_cast<Fuse*>(data)->left == 0) throw std::runtime_error("the fuse has blown");
    }
  };
  DrawState expected_state = shiny(Shading::phong);
  const auto expected = picture(kFormat, expected_state, {.elide = false});
  for (const bool in_vertices : {true, false})
    for (const bool discards : {false, true})
      for (const int at : {1, 2, 5}) {
        Fuse fuse{at};
        DrawState state = expected_state;
        if (in_vertices)
          state.vertex_stage =
              VertexStage{.run = [](const VertexBlock&, void* data) { Fuse::burn(data); }, .data = &fuse};
        else
          state.fragment_stage =
              FragmentStage{.run = [](const FragmentBlock&, void* data) { Fuse::burn(data); },
                            .data = &fuse,
                            .reads = {.color = true},
                            .discards = discards};
        FrameBuffer buffer(kFormat);
        Frame frame(buffer);
        frame.clear({.color = Color{0.1f, 0.2f, 0.3f, 1}, .depth = 1.0});
        frame.set_camera({.view = look_at({0.4f, 0.6f, 2.2f}, {0, 0, 0}, {0, 1, 0}),
                          .projection = perspective(50, 1.5, 0.9, 10)});
        Light point;
        point.position = {1, 2, 2, 1};
        frame.set_lights({Light{}, point});
        frame.set_light_model({.local_viewer = true, .two_sided = true});
        frame.draw(ball().view(), state);
        state.transform = translate(0.7, 0.2, 0.4) * rotate(70, 1, 1, 0);
        frame.draw(ball().view(), state);
        Renderer renderer({.threads = 2});
        try {
          renderer.finish(frame);
          ADD_FAILURE() << "no exception, block " << at;
        } catch (const std::runtime_error& error) {
          EXPECT_STREQ(error.what(), "the fuse has blown");
        }
        renderer.finish(frame);  // the fuse does not blow again
        EXPECT_EQ(fingerprint(buffer), fingerprint(expected->buffer)) << in_vertices << discards << at;
      }
}

TEST(UserStages, CapturesObeyDiscards) {
  DrawState state = shiny(Shading::phong);
  state.fragment_stage = FragmentStage{.run =
                                           [](const FragmentBlock& block, void*) {
                                             for (std::size_t i = 0; i < block.count; ++i)
                                               block.keep[i] = block.color[0][i] < 0.4f;
                                           },
                                       .reads = {.color = true},
                                       .discards = true};
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{1, 1, 1, 1}, .depth = 1.0});
  frame.set_camera(
      {.view = look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}), .projection = perspective(50, 1.5, 0.9, 10)});
  frame.draw(ball().view(), state);
  std::vector<std::uint32_t> draws(pixel_count(buffer)), primitives(pixel_count(buffer));
  std::vector<float> normals(3 * pixel_count(buffer));
  frame.capture({.draw_ids = draws, .primitive_ids = primitives, .normals = normals});
  Renderer().finish(frame);
  const auto colors = colors_of(buffer);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const bool is_drawn = colors[i] != 0xffffff;
    drawn += is_drawn ? 1 : 0;
    EXPECT_EQ(draws[i], is_drawn ? 0u : Capture::kNothing);
    EXPECT_EQ(primitives[i] != Capture::kNothing, is_drawn);
    const float squared = normals[3 * i] * normals[3 * i] + normals[3 * i + 1] * normals[3 * i + 1] +
                          normals[3 * i + 2] * normals[3 * i + 2];
    EXPECT_NEAR(squared, is_drawn ? 1 : 0, 1e-5);
  }
  EXPECT_GT(drawn, 100u);
  EXPECT_LT(drawn, 90u * 60 / 2);
}

// The example's lighting of the teapot, from several sides.
TEST(UserStages, PhongLightingAsAStageEqualsTheBuiltInOne) {
  const MeshData teapot = builtin_mesh("teapot", 10);
  Phong phong{{1, 2, 0}, {0.8f, 0.3f, 0.2f}, 0.6f, 20};
  DrawState state;
  state.shading = Shading::phong;
  state.material.ambient = {0, 0, 0, 1};
  state.material.diffuse = {0.8f, 0.3f, 0.2f, 1};
  state.material.specular = {0.6f, 0.6f, 0.6f, 1};
  state.material.shininess = 20;
  for (const double angle : {0.0, 100.0, 220.0}) {
    state.transform = translate(0, 0, -3) * rotate(25, 1, 0, 0) * rotate(angle, 0, 1, 0);
    const auto drawn = [&](const DrawState& s) {
      auto buffer = std::make_unique<FrameBuffer>(FrameBufferFormat{.width = 320, .height = 240});
      Frame frame(*buffer);
      frame.set_camera({.projection = perspective(40, 4.0 / 3, 1, 10)});
      frame.set_lights({Light{.position = {1, 2, 0, 1}}});
      frame.set_light_model(
          {.ambient = {0, 0, 0, 1}, .local_viewer = true, .specular = SpecularModel::phong});
      frame.clear({.color = Color{0.1f, 0.1f, 0.15f, 1}, .depth = 1.0});
      frame.draw(teapot.view(), s);
      Renderer().finish(frame);
      return buffer;
    };
    DrawState staged = state;
    staged.fragment_stage =
        FragmentStage{.run = Phong::run, .data = &phong, .reads = {.eye = true, .normal = true}};
    EXPECT_LE(largest_difference(*drawn(staged), *drawn(state)), 1) << angle;
  }
}

TEST(UserStages, AreNamedByExplain) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  DrawState state = shiny(Shading::phong);
  state.vertex_stage = VertexStage{.run = [](const VertexBlock&, void*) {}, .name = "wave"};
  state.fragment_stage = pass_through();
  frame.draw(ball().view(), state);
  state.fragment_stage->discards = true;
  frame.draw(ball().view(), state);
  state.fragment_stage = pass_through();
  state.color_mask = {false, false, false, false};
  frame.draw(ball().view(), state);
  EXPECT_NE(frame.explain(0).find("vertex stage wave: for every vertex\n"), std::string::npos);
  EXPECT_NE(frame.explain(0).find("fragment stage pass through: once per visible pixel\n"),
            std::string::npos);
  EXPECT_NE(frame.explain(1).find("fragment stage pass through: for every fragment, before the tests"),
            std::string::npos);
  EXPECT_NE(frame.explain(2).find("fragment stage pass through: skipped, no colour plane can change\n"),
            std::string::npos)
      << frame.explain(2);
}

TEST(UserStages, WrongStagesAreErrors) {
  const auto error_with = [&](const auto& change, FrameBufferFormat format = kFormat) {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    DrawState state;
    state.fragment_stage = pass_through();
    state.vertex_stage = VertexStage{.run = [](const VertexBlock&, void*) {}};
    change(state);
    return error_of([&] { frame.draw(ball().view(), state); }).value_or("");
  };
  EXPECT_EQ(error_with([](DrawState& s) { s.fragment_stage->run = nullptr; }),
            "Frame::draw: fragment_stage.run is null, must be a function");
  EXPECT_EQ(error_with([](DrawState& s) { s.vertex_stage->run = nullptr; }),
            "Frame::draw: vertex_stage.run is null, must be a function");
  EXPECT_EQ(error_with([](DrawState& s) { s.vertex_stage->extras = 9; }),
            "Frame::draw: vertex_stage.extras is 9, must be 0 to 8");
  EXPECT_EQ(error_with([](DrawState& s) { s.fragment_stage->reads.extras = 1; }),
            "Frame::draw: fragment_stage.reads.extras is 1, must be 0 to the 0 extras that the vertex stage "
            "writes");
  EXPECT_EQ(error_with([](DrawState& s) { s.vertex_stage->writes.object = true; }),
            "Frame::draw: vertex_stage.writes.object is true, but object positions are inputs");
  EXPECT_EQ(error_with([](DrawState& s) {
              s.shadow_on = ShadowOn{.plane = {0, 1, 0, 2}};
            }),
            "Frame::draw: shadow_on and a user stage exclude each other");
  FrameBufferFormat no_depth = kFormat;
  no_depth.depth = DepthFormat::none;
  EXPECT_EQ(error_with([](DrawState&) {}, no_depth),
            "Frame::draw: the fragment stage uses depth, but the frame buffer has no depth buffer");
  const FrameBufferFormat index{.width = 8,
                                .height = 8,
                                .color_mode = ColorMode::index,
                                .color_bits = 8,
                                .palette = named_palette("gray", 8)};
  EXPECT_EQ(error_with(
                [](DrawState& s) {
                  s.material.index_ramp = {0, 1, 2};
                },
                index),
            "Frame::draw: a fragment stage works on RGB colours, but the colours of this draw are indices");
}

}  // namespace
}  // namespace tessera::test::user_stages_test
