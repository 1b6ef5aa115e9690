// Index buffers: indices of vertices, lighting of indices, palettes that change under a picture. By hand where numbers are few.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/engine/api_support.h"

namespace tessera {
namespace {

using namespace test;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::uint32_t>;
using Record = std::function<void(Frame&)>;

const FrameBufferFormat kFormat{.width = 64, .height = 32, .color_mode = ColorMode::index, .color_bits = 6};

Words drawn(const FrameBufferFormat& format, const Record& record, const RendererOptions& options = {.threads = 1}) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.clear({.index = 0, .depth = 1.0});
  record(frame);
  Renderer(options).finish(frame);
  return color_words(buffer);
}

// Covers the window; at pixel (x, y) from the lower left what is interpolated is a + (b - a) (x + 0.5) / 128 + (c - a) (y + 0.5) / 64.
MeshData large_triangle(float a, float b, float c) {
  MeshData mesh;
  mesh.positions = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
  mesh.color_indices = {a, b, c};
  return mesh;
}

DrawState index_state(Shading shading = Shading::gouraud) {
  DrawState state;
  state.lighting = false;
  state.shading = shading;
  return state;
}

// The same picture by every way through the pixels: at once or later, with operations whose order matters or does not.
std::vector<DrawState> every_way(const DrawState& plain) {
  std::vector<DrawState> states(4, plain);
  states[1].logic_op = LogicOp::or_;
  states[2].stencil = StencilState{.front = {.zpass = StencilOp::incr}};
  states[3].polygon_offset = {0, 1};
  return states;
}
void expect_everywhere(std::uint32_t word, const MeshData& mesh, const DrawState& plain, const FrameBufferFormat& format = kFormat, const std::vector<Light>& lights = {Light{}}) {
  for (const DrawState& state : every_way(plain)) {
    const Words words = drawn(format, [&](Frame& frame) {
      frame.set_lights(lights);
      frame.draw(mesh.view(), state);
    });
    EXPECT_THAT(words, Each(word)) << "shading " << static_cast<int>(state.shading) << ", logic " << static_cast<int>(state.logic_op) << ", stencil " << state.stencil.has_value();
    if (testing::Test::HasFailure()) return;
  }
}

double masked(double index, double count) { return index - count * std::floor(index / count); }

TEST(ColorIndex, IsInterpolatedFromMaskedVertices) {
  const float corners[][3] = {{2, 34, 10}, {-3, 70, 64.25f}, {63.75f, 63.75f, 62.875f}, {1000.25f, -1000.75f, 0.25f}, {-128, 6.5e4f, 17}};
  for (const auto& [a, b, c] : corners) {
    const MeshData mesh = large_triangle(a, b, c);
    const double at[3] = {masked(a, 64), masked(b, 64), masked(c, 64)};
    for (const DrawState& state : every_way(index_state())) {
      const Words words = drawn(kFormat, [&](Frame& frame) { frame.draw(mesh.view(), state); });
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
          const double index = at[0] + (at[1] - at[0]) * (x + 0.5) / 128 + (at[2] - at[0]) * (y + 0.5) / 64;
          if (std::abs(index + 0.5 - std::round(index + 0.5)) < 1e-4) continue;
          const auto expected = static_cast<std::uint32_t>(masked(std::floor(index + 0.5), 64));
          ASSERT_EQ(words[static_cast<std::size_t>((31 - y) * 64 + x)], expected) << "at " << x << " " << y << " of " << a << " " << b << " " << c << ": " << index;
        }
    }
  }
}

TEST(ColorIndex, IsRoundedToTheNearestAndMaskedAgain) {
  FrameBufferFormat deep = kFormat;
  deep.color_bits = 24;
  struct Case {
    float index;
    std::uint32_t word, deep_word;
  };
  const Case cases[] = {{2.5f, 3, 3}, {3.5f, 4, 4}, {3.4999f, 3, 3}, {0.49999997f, 0, 0}, {63.5f, 0, 64}, {63.25f, 63, 63}, {-0.5f, 0, 0}, {-0.75f, 63, 16777215},
                        {8388609, 1, 8388609}, {16777215, 63, 16777215}, {16777216, 0, 0}, {-1e-30f, 0, 0}, {3e38f, 0, 0}};
  for (const Case& c : cases) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      SCOPED_TRACE(c.index);
      expect_everywhere(c.word, large_triangle(c.index, c.index, c.index), index_state(shading));
      if (c.index != -0.75f) expect_everywhere(c.deep_word, large_triangle(c.index, c.index, c.index), index_state(shading), deep);
    }
  }
}

TEST(ColorIndex, OfFlatTrianglesIsThatOfTheProvokingVertex) {
  DrawState state = index_state(Shading::flat);
  expect_everywhere(13, large_triangle(5, 9, 13), state);
  expect_everywhere(61, large_triangle(5, 9, -3), state);
  state.provoking_vertex = ProvokingVertex::first;
  expect_everywhere(5, large_triangle(5, 9, 13), state);
}

TEST(ColorIndex, IsNeverDithered) {
  FrameBufferFormat format = kFormat;
  format.palette = named_palette("ega16", 6);
  const MeshData mesh = large_triangle(0, 60, 20);
  const auto record = [&](Frame& frame) { frame.draw(mesh.view(), index_state()); };
  const Words plain = drawn(format, record);
  format.dither = Dither::bayer8;
  EXPECT_EQ(drawn(format, record), plain);
}

TEST(ColorIndex, GivesWayToColoursWhereItDoesNotApply) {
  MeshData mesh = large_triangle(40, 41, 42);
  mesh.colors = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
  const auto record = [&](Frame& frame) { frame.draw(mesh.view(), index_state()); };
  const FrameBufferFormat rgb{.width = 64, .height = 32};
  EXPECT_THAT(drawn(kFormat, record), Not(Each(12u)));
  DrawState lit;
  lit.color_material = ColorMaterial::emission;
  mesh.colors = {1, 0.33f, 0.33f, 1, 1, 0.33f, 0.33f, 1, 1, 0.33f, 0.33f, 1};
  lit.material.ambient = lit.material.diffuse = {0, 0, 0, 1};
  expect_everywhere(12, mesh, lit);  // bright red of ega16
  FrameBuffer buffer(rgb);
  Frame frame(buffer);
  frame.draw(mesh.view(), index_state());
  Renderer({.threads = 1}).finish(frame);
  EXPECT_THAT(color_words(buffer), Each(0xff5454u));
}

MeshData with_normals(float x, float y, float z) {
  MeshData mesh = large_triangle(1, 2, 3);
  mesh.normals = {x, y, z, x, y, z, x, y, z};
  return mesh;
}
Material index_material(float ambient, float diffuse, float specular, float shininess) {
  Material material;
  material.color_indexes = {ambient, diffuse, specular};
  material.shininess = shininess;
  return material;
}

// L = S = (0, 0, 1), n = (0.6, 0, 0.8): d is 0.8 and s is 0.64, each times a luminance.
TEST(IndexLighting, HasTheNumbersOfTheFormula) {
  const MeshData mesh = with_normals(0.6f, 0, 0.8f);
  const auto light = [](Color diffuse, Color specular) { return Light{.ambient = {9, 9, 9, 1}, .diffuse = diffuse, .specular = specular}; };
  const Color black{0, 0, 0, 1}, white{1, 1, 1, 1};
  struct Case {
    std::array<float, 3> indexes;
    std::vector<Light> lights;
    std::uint32_t word;
  };
  const Case cases[] = {
      {{10, 30, 50}, {Light{}}, 41},                                                        // 10 + 0.8 0.36 20 + 0.64 40 = 41.36
      {{10, 30, 50}, {light({0.5f, 0, 0, 1}, {0, 1, 0, 1})}, 27},                           // d 0.12, s 0.3776: 26.6
      {{10, 30, 50}, {light({0, 0, 0.5f, 1}, {0, 0, 1, 1})}, 14},                           // d 0.044, s 0.0704: 13.6
      {{10, 30, 50}, {light(white, {2, 2, 2, 1})}, 50},                                     // s 1.28: 56.7, at most the specular index
      {{10, 30, 60}, {light({2, 2, 2, 1}, black), light(white, black)}, 58},                // d 2.4 is not clamped
      {{10, 30, 60}, {light(white, black), light({-1.5f, -1.5f, -1.5f, 1}, black)}, 2},     // d -0.4
      {{10, 30, 60}, {light({-1, -1, -1, 1}, black)}, 58},                                  // d -0.8: -6, masked
      {{60, 100, 100}, {light(white, black)}, 28},                                          // 92, masked
      {{7, 30, 60}, {light(black, black)}, 7},
      {{70, 30, 90}, {}, 6},
      {{20, 20, 50}, {Light{}}, 39},                                                        // d does not matter: 20 + 0.64 30
      {{30, 10, 30}, {Light{}}, 24},                                                        // 30 - 0.8 0.36 20 = 24.24
      {{20, 20, 20}, {Light{}}, 20},
  };
  for (const auto& c : cases) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      DrawState state;
      state.shading = shading;
      state.material = index_material(c.indexes[0], c.indexes[1], c.indexes[2], 2);
      state.material.emission = state.material.ambient = {1, 1, 1, 1};
      SCOPED_TRACE(c.word);
      expect_everywhere(c.word, mesh, state, kFormat, c.lights);
    }
  }
}

TEST(IndexLighting, OfMeshesWithoutNormalsHasThoseOfTheFaces) {
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
    DrawState state;
    state.shading = shading;
    state.material = index_material(3, 33, 33, 0);
    Light light;
    light.position = {0, 0.6f, 0.8f, 0};
    light.specular = {0, 0, 0, 1};
    expect_everywhere(27, large_triangle(0, 0, 0), state, kFormat, {light});  // 3 + 0.8 30
  }
}

// The left half faces the viewer, the right one is seen from behind.
MeshData two_faces() {
  MeshData mesh = rectangle(-1, -1, 0, 1);
  const MeshData right = rectangle(0, -1, 1, 1);
  mesh.positions.insert(mesh.positions.end(), right.positions.begin(), right.positions.end());
  mesh.indices.insert(mesh.indices.end(), {4, 6, 5, 4, 7, 6});
  for (int i = 0; i < 8; ++i) mesh.normals.insert(mesh.normals.end(), {0, 0, i < 4 ? 1.0f : -1.0f});
  return mesh;
}

TEST(IndexLighting, GoesByTheMaterialOfEachFace) {
  const MeshData mesh = two_faces();
  Material white;
  white.ambient = white.diffuse = {0, 0, 0, 1};
  white.emission = {1, 1, 1, 1};
  const Material first = index_material(20, 40, 40, 0), second = index_material(0, 33, 33, 0);
  struct Case {
    Material front, back;
    std::uint32_t left, right;
  };
  const Case cases[] = {{first, white, 40, 15}, {white, first, 15, 40}, {first, second, 40, 33}, {white, white, 15, 15}};
  Light matt;
  matt.specular = {0, 0, 0, 1};
  for (const Case& c : cases) {
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      DrawState plain;
      plain.material = c.front;
      plain.back_material = c.back;
      plain.shading = shading;
      for (const DrawState& state : every_way(plain)) {
        const Words words = drawn(kFormat, [&](Frame& frame) {
          frame.set_light_model({.two_sided = true});
          frame.set_lights({matt});
          frame.draw(mesh.view(), state);
        });
        for (std::size_t i = 0; i < words.size(); ++i) ASSERT_EQ(words[i], i % 64 < 32 ? c.left : c.right) << "pixel " << i << ", shading " << static_cast<int>(shading);
      }
    }
  }
}

TEST(IndexLighting, OfConstantFacesIsEachOnesOwn) {
  const MeshData mesh = two_faces();
  DrawState state;
  state.material = index_material(20, 40, 40, 0);
  state.back_material = index_material(21, 40, 40, 0);
  const Words words = drawn(kFormat, [&](Frame& frame) {
    frame.set_light_model({.two_sided = true});
    frame.set_lights({});
    frame.draw(mesh.view(), state);
  });
  for (std::size_t i = 0; i < words.size(); ++i) ASSERT_EQ(words[i], i % 64 < 32 ? 20u : 21u);
}

TEST(ColorIndex, XorDrawnTwiceRestoresWhatWasThere) {
  const MeshData below = large_triangle(0, 63, 20), above = large_triangle(9, 40, 63);
  DrawState state = index_state();
  state.depth.enabled = false;
  const auto draws = [&](int times) {
    return drawn(kFormat, [&](Frame& frame) {
      frame.draw(below.view(), state);
      DrawState cursor = state;
      cursor.logic_op = LogicOp::xor_;
      for (int i = 0; i < times; ++i) frame.draw(above.view(), cursor);
    });
  };
  const Words before = draws(0), once = draws(1);
  EXPECT_EQ(draws(2), before);
  const Words alone = drawn(kFormat, [&](Frame& frame) { frame.draw(above.view(), state); });
  for (std::size_t i = 0; i < once.size(); ++i) ASSERT_EQ(once[i], before[i] ^ alone[i]);
}

TEST(ColorIndex, GoesThroughThePlaneMask) {
  DrawState state = index_state();
  state.plane_mask = 0b000111;
  const MeshData mesh = large_triangle(0b101010, 0b101010, 0b101010);
  const Words words = drawn(kFormat, [&](Frame& frame) {
    frame.clear({.index = 0b010101});
    frame.draw(mesh.view(), state);
  });
  EXPECT_THAT(words, Each(0b010010u));
}

std::vector<std::uint8_t> shown(const FrameBuffer& buffer) {
  Image image(buffer);
  buffer.read_color(image.target());
  return image.bytes;
}

TEST(Palette, ChangesWhatIsShownAndNotWhatIsStored) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.index = 2});
  Renderer renderer({.threads = 1});
  renderer.finish(frame);
  const Color red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1};
  const std::vector<Color> first{red, green, blue}, second{blue, red, green};
  buffer.set_palette(first);
  EXPECT_EQ(shown(buffer)[2], 255);
  buffer.set_palette(second);
  EXPECT_EQ(shown(buffer)[1], 255);
  EXPECT_EQ(shown(buffer)[2], 0);
  EXPECT_THAT(color_words(buffer), Each(2u));
  EXPECT_EQ(buffer.format().palette.size(), 3u);

  // Colours find the entries of the palette in force when the frame is finished.
  const MeshData mesh = whole_window();
  DrawState over = unlit(red);
  over.depth.enabled = false;
  const auto draw_red = [&] { frame.draw(mesh.view(), over); };
  draw_red();
  renderer.finish(frame);
  EXPECT_THAT(color_words(buffer), Each(1u));
  draw_red();
  buffer.set_palette(first);
  renderer.finish(frame);
  EXPECT_THAT(color_words(buffer), Each(0u));
  buffer.set_palette({});
  EXPECT_EQ(buffer.format().palette.size(), 16u);
  draw_red();
  renderer.finish(frame);
  EXPECT_THAT(color_words(buffer), Each(4u)) << "of ega16";
}

TEST(Palette, ErrorsChangeNothing) {
  FrameBuffer buffer(kFormat), rgb({.width = 4, .height = 4});
  Frame frame(buffer);
  frame.clear({.index = 9});
  Renderer({.threads = 1}).finish(frame);
  const auto before = shown(buffer);
  std::vector<Color> entries(65);
  EXPECT_THAT(error_of([&] { buffer.set_palette(entries); }).value_or(""), AllOf(HasSubstr("65"), HasSubstr("at most 64")));
  entries.resize(10);
  for (const float wrong : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    entries[7].g = wrong;
    EXPECT_THAT(error_of([&] { buffer.set_palette(entries); }).value_or(""), AllOf(HasSubstr("entry 7"), HasSubstr("0 to 1")));
  }
  EXPECT_EQ(shown(buffer), before);
  EXPECT_EQ(buffer.format().palette.size(), 16u);
  entries[7].g = 1;
  EXPECT_THAT(error_of([&] { rgb.set_palette(entries); }).value_or(""), AllOf(HasSubstr("set_palette"), HasSubstr("rgb")));
  EXPECT_EQ(error_of([&] { buffer.set_palette(entries); }), std::nullopt);
}

TEST(ColorIndex, ErrorsNameWhatIsWrong) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  MeshData mesh = large_triangle(1, 2, 3);
  mesh.color_indices.pop_back();
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), index_state()); }).value_or(""), AllOf(HasSubstr("2 floats of color_indices"), HasSubstr("3 vertices")));
  mesh.color_indices = {1, 2, 3};
  DrawState state;
  state.material = index_material(0, std::numeric_limits<float>::infinity(), 1, 0);
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""), AllOf(HasSubstr("material.color_indexes"), HasSubstr("finite")));
  state = index_state();
  state.blend = BlendState{};
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""), HasSubstr("do not blend"));
  state.blend.reset();
  state.alpha_test = AlphaTest{};
  EXPECT_THAT(error_of([&] { frame.draw(mesh.view(), state); }).value_or(""), HasSubstr("no alpha"));
}

TEST(ColorIndex, NotFiniteDropsItsTriangleWhereItIsUsed) {
  MeshData mesh = two_faces();
  mesh.color_indices.assign(8, 7);
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    mesh.color_indices[2] = wrong;
    for (const Shading shading : {Shading::flat, Shading::gouraud}) {
      const auto dropped = [&](const FrameBufferFormat& format, DrawState state) {
        state.shading = shading;
        FrameBuffer buffer(format);
        Frame frame(buffer);
        frame.draw(mesh.view(), state);
        return Renderer({.threads = 1}).finish(frame).dropped_non_finite;
      };
      EXPECT_EQ(dropped(kFormat, index_state()), 2u) << "both triangles of the left half";
      EXPECT_EQ(dropped(kFormat, DrawState{}), 0u) << "lit";
      EXPECT_EQ(dropped({.width = 64, .height = 32}, index_state()), 0u) << "of an RGB buffer";
    }
  }
}

// Strides, 16-bit indices and captures besides.
TEST(ColorIndex, HasTheSameBitsHoweverItIsMade) {
  Random random(5);
  MeshData mesh;
  for (int i = 0; i < 600; ++i) {
    mesh.positions.insert(mesh.positions.end(), {random.between(-1.3f, 1.3f), random.between(-1.3f, 1.3f), random.between(-1.1f, 0.9f)});
    mesh.normals.insert(mesh.normals.end(), {random.between(-1, 1), random.between(-1, 1), random.between(0, 1)});
    mesh.color_indices.push_back(random.between(-300, 300));
  }
  FrameBufferFormat format = kFormat;
  format.width = 150;
  format.height = 110;
  format.dither = Dither::bayer4;
  Light point;
  point.position = {0.5f, 0.5f, 2, 1};
  const auto record = [&](Frame& frame) {
    frame.set_lights({Light{}, point});
    frame.set_light_model({.two_sided = true});
    for (const DrawState& way : every_way({})) {
      for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
        DrawState state = way;
        state.shading = shading;
        state.viewport = Rect{40 * static_cast<int>(shading), 0, 70, 110};
        state.material = index_material(-20, 50, 90, 12);
        frame.draw(mesh.view(), state);
        state.back_material = Material{};
        frame.draw(mesh.view(), state);
        state.lighting = false;
        frame.draw(mesh.view(), state);
      }
    }
  };
  const Words expected = drawn(format, record);
  for (const InstructionSet set : available_instruction_sets())
    for (const int tile_size : {32, 64, 128})
      for (const int threads : {1, 3})
        for (const bool defer : {true, false})
          ASSERT_EQ(drawn(format, record, {.threads = threads, .tile_size = tile_size, .instruction_set = set, .defer_shading = defer}), expected)
              << name(set) << ", tiles of " << tile_size << ", " << threads << " threads, deferred " << defer;
}

TEST(ColorIndex, LeavesCapturesAlone) {
  const MeshData mesh = with_normals(0, 0, 2);
  DrawState plain = index_state();
  plain.depth.test = Compare::lequal;
  for (const DrawState& state : every_way(plain)) {
    Words objects(64 * 32), primitives(64 * 32);
    std::vector<float> normals(3 * 64 * 32);
    const Words words = drawn(kFormat, [&](Frame& frame) {
      frame.draw(mesh.view(), state);
      frame.draw(mesh.view(), state);
      frame.capture({.objects = objects, .primitives = primitives, .normals = normals});
    });
    EXPECT_EQ(words, drawn(kFormat, [&](Frame& frame) { frame.draw(mesh.view(), state); }));
    EXPECT_THAT(objects, Each(1u)) << "the second, not its index";
    EXPECT_THAT(primitives, Each(0u));
    for (std::size_t i = 0; i < normals.size(); ++i) ASSERT_EQ(normals[i], i % 3 == 2 ? 1.0f : 0.0f);
  }
}

std::string explain(const FrameBufferFormat& format, const MeshData& mesh, const DrawState& state) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.draw(mesh.view(), state);
  return frame.explain(0);
}

TEST(ColorIndex, ExplainTellsWhatIsNotUsed) {
  MeshData mesh = large_triangle(1, 2, 3);
  mesh.colors.assign(12, 1);
  FrameBufferFormat dithered = kFormat;
  dithered.dither = Dither::bayer2;
  EXPECT_THAT(explain(dithered, mesh, index_state()), AllOf(HasSubstr("indices of the vertices"), HasSubstr("colours are not used: it has color_indices"), HasSubstr("not dithered")));
  const FrameBufferFormat rgb{.width = 4, .height = 4};
  EXPECT_THAT(explain(rgb, mesh, index_state()), HasSubstr("color_indices are not used: the buffer holds RGB"));
  EXPECT_THAT(explain(kFormat, mesh, {}), AllOf(HasSubstr("color_indices are not used: it is lit"), Not(HasSubstr("index lighting"))));
  DrawState state;
  state.color_material = ColorMaterial::diffuse;
  state.material = index_material(0, 1, 2, 3);
  EXPECT_THAT(explain(kFormat, mesh, state), AllOf(HasSubstr("index lighting"), HasSubstr("Blinn highlight"), HasSubstr("colours are not used: the material has color_indexes")));
  EXPECT_THAT(explain(rgb, mesh, state), AllOf(HasSubstr("color_indexes are not used: the buffer holds RGB"), Not(HasSubstr("index lighting"))));
}

}  // namespace
}  // namespace tessera
