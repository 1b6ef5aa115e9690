// Strips, fans, quads and polygons, compared with a hand-written list of their triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::polygon_primitives_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

/// A triangle of a primitive.
struct Split {
  std::uint32_t corners[3];
  std::uint32_t last;   ///< provoking vertex of the polygon with ProvokingVertex::last
  std::uint32_t first;  ///< with ProvokingVertex::first
};
struct PrimitiveCase {
  const char* name;
  Primitive primitive;
  std::uint32_t vertices;
  std::vector<Split> triangles;
};

// Vertices counted from 0.
const std::vector<PrimitiveCase>& cases() {
  static const std::vector<PrimitiveCase> kAll = {
      {"triangles", Primitive::triangles, 6, {{{0, 1, 2}, 2, 0}, {{3, 4, 5}, 5, 3}}},
      {"strip",
       Primitive::triangle_strip,
       6,
       {{{0, 1, 2}, 2, 0}, {{2, 1, 3}, 3, 1}, {{2, 3, 4}, 4, 2}, {{4, 3, 5}, 5, 3}}},
      {"fan",
       Primitive::triangle_fan,
       6,
       {{{0, 1, 2}, 2, 1}, {{0, 2, 3}, 3, 2}, {{0, 3, 4}, 4, 3}, {{0, 4, 5}, 5, 4}}},
      {"quads",
       Primitive::quads,
       8,
       {{{0, 1, 2}, 3, 0}, {{0, 2, 3}, 3, 0}, {{4, 5, 6}, 7, 4}, {{4, 6, 7}, 7, 4}}},
      {"quad_strip",
       Primitive::quad_strip,
       6,
       {{{0, 1, 3}, 3, 0}, {{0, 3, 2}, 3, 0}, {{2, 3, 5}, 5, 2}, {{2, 5, 4}, 5, 2}}},
      {"polygon",
       Primitive::polygon,
       6,
       {{{0, 1, 2}, 0, 0}, {{0, 2, 3}, 0, 0}, {{0, 3, 4}, 0, 0}, {{0, 4, 5}, 0, 0}}},
  };
  return kAll;
}

constexpr int kWidth = 96, kHeight = 80;

// Positions anywhere, planar or not; each vertex has a normal and a colour.
MeshData random_mesh(const PrimitiveCase& of, std::uint64_t seed) {
  Random random(seed);
  MeshData mesh;
  mesh.primitive = of.primitive;
  for (std::uint32_t v = 0; v < of.vertices; ++v) {
    for (int k = 0; k < 3; ++k)
      mesh.positions.push_back(random.between(-1.2f, 1.2f) * (k == 2 ? 0.7f : 1.0f));
    for (int k = 0; k < 3; ++k) mesh.normals.push_back(random.between(-1, 1));
    for (int k = 0; k < 4; ++k) mesh.colors.push_back(random.between(0, 1));
  }
  return mesh;
}

void append(MeshData& to, const MeshData& from, std::uint32_t position, std::uint32_t rest) {
  const auto copy = [](std::vector<float>& a, const std::vector<float>& b, std::size_t v, std::size_t each) {
    a.insert(a.end(), b.begin() + static_cast<std::ptrdiff_t>(v * each),
             b.begin() + static_cast<std::ptrdiff_t>((v + 1) * each));
  };
  copy(to.positions, from.positions, position, 3);
  copy(to.normals, from.normals, rest, 3);
  copy(to.colors, from.colors, rest, 4);
}

// Triangles without shared vertices; at flat shading all corners have the attributes of the provoking vertex.
MeshData as_triangles(const PrimitiveCase& of, const MeshData& mesh, const DrawState& state) {
  MeshData out;
  for (const Split& t : of.triangles) {
    const std::uint32_t provoking = state.provoking_vertex == ProvokingVertex::last ? t.last : t.first;
    for (const std::uint32_t corner : t.corners)
      append(out, mesh, corner, state.shading == Shading::flat ? provoking : corner);
  }
  return out;
}

Image drawn(const Mesh& mesh, const DrawState& state,
            FrameBufferFormat format = {.width = kWidth, .height = kHeight}) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.clear({.color = Color{0.1f, 0.1f, 0.1f, 1}, .depth = 1.0});
  frame.draw(mesh, state);
  Renderer({.threads = 1}).finish(frame);
  Image image(buffer);
  buffer.read_color(image.target());
  return image;
}
int largest_difference(const Image& a, const Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.bytes.size(); ++i)
    largest = std::max(largest, std::abs(a.bytes[i] - b.bytes[i]));
  return largest;
}

TEST(PolygonPrimitives, MatchTheirTriangles) {
  for (const PrimitiveCase& of : cases())
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
      for (const ProvokingVertex provoking : {ProvokingVertex::last, ProvokingVertex::first})
        for (const bool lighting : {false, true})
          for (const bool with_operations : {false, true})
            for (std::uint64_t seed = 0; seed < 6; ++seed) {
              DrawState state;
              state.shading = shading;
              state.provoking_vertex = provoking;
              state.lighting = lighting;
              state.material.specular = {1, 1, 1, 1};
              state.material.shininess = 10;
              if (with_operations) state.alpha_test = AlphaTest{.func = Compare::greater, .ref = 0.3f};
              if (with_operations && lighting) state.color_material = ColorMaterial::diffuse;
              const MeshData mesh = random_mesh(of, seed);
              const MeshData triangles = as_triangles(of, mesh, state);
              // Interpolated colours may round differently if the vertices of a triangle are in another
              // order.
              EXPECT_LE(largest_difference(drawn(mesh.view(), state), drawn(triangles.view(), state)),
                        shading == Shading::flat ? 0 : 1)
                  << of.name << ", shading " << static_cast<int>(shading) << ", provoking "
                  << static_cast<int>(provoking) << ", lit " << lighting << ", operations " << with_operations
                  << ", seed " << seed;
            }
}

TEST(PolygonPrimitives, AcceptIndicesOfEverySize) {
  for (const PrimitiveCase& of : cases()) {
    MeshData mesh = random_mesh(of, 9);
    DrawState state;
    state.shading = Shading::flat;
    state.lighting = false;
    const Image expected = drawn(mesh.view(), state);
    // The same vertices in another order, restored by indices.
    MeshData turned;
    turned.primitive = of.primitive;
    std::vector<std::uint16_t> narrow;
    for (std::uint32_t v = of.vertices; v-- > 0;) append(turned, mesh, v, v);
    for (std::uint32_t v = 0; v < of.vertices; ++v) {
      turned.indices.push_back(of.vertices - 1 - v);
      narrow.push_back(static_cast<std::uint16_t>(of.vertices - 1 - v));
    }
    EXPECT_EQ(drawn(turned.view(), state).bytes, expected.bytes) << of.name;
    Mesh view = turned.view();
    view.indices = narrow;
    EXPECT_EQ(drawn(view, state).bytes, expected.bytes) << of.name;
  }
}

// A bow tie, split along 0-2: the left lobe, twice as large, is counter-clockwise, the right one clockwise.
MeshData bow_tie(Primitive primitive) {
  MeshData mesh;
  mesh.primitive = primitive;
  const float quad[4][3] = {{-0.9f, -0.8f, 0}, {0.6f, 0.4f, 0}, {0.6f, -0.4f, 0}, {-0.9f, 0.8f, 0}};
  const int order[2][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}};
  for (const int v : order[primitive == Primitive::quad_strip ? 1 : 0])
    mesh.positions.insert(mesh.positions.end(), quad[v], quad[v] + 3);
  return mesh;
}
std::size_t pixels_of(const MeshData& mesh, Cull cull, FrontFace front) {
  DrawState state = unlit({1, 1, 1, 1});
  state.cull = cull;
  state.front_face = front;
  const Image image = drawn(mesh.view(), state);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.bytes.size(); i += 4) count += image.bytes[i] == 255;
  return count;
}

TEST(PolygonPrimitives, HaveOneFacingForAllTriangles) {
  for (const Primitive primitive : {Primitive::quads, Primitive::quad_strip, Primitive::polygon}) {
    const MeshData tie = bow_tie(primitive);
    const std::size_t all = pixels_of(tie, Cull::none, FrontFace::ccw);
    EXPECT_GT(all, 500u);
    const std::size_t kept[2] = {pixels_of(tie, Cull::back, FrontFace::ccw),
                                 pixels_of(tie, Cull::front, FrontFace::ccw)};
    EXPECT_EQ(kept[0], all) << "the larger lobe decides";
    EXPECT_EQ(kept[1], 0u);
    EXPECT_EQ(pixels_of(tie, Cull::back, FrontFace::cw), kept[1]);
    EXPECT_EQ(pixels_of(tie, Cull::front, FrontFace::cw), kept[0]);
  }
}

TEST(PolygonPrimitives, UseTheMaterialOfTheirFacing) {
  // Triangles 0 1 2 and 0 2 3 of the bow tie have opposite windings; the whole is a front face.
  for (const bool with_operations : {false, true}) {
    const MeshData tie = bow_tie(Primitive::quads);
    FrameBuffer buffer({.width = kWidth, .height = kHeight});
    Frame frame(buffer);
    frame.set_light_model({.two_sided = true});
    frame.set_lights({});
    DrawState state;
    state.material.emission = {1, 0, 0, 1};
    state.back_material = Material{.emission = {0, 0, 1, 1}};
    state.material.ambient = state.back_material->ambient = {0, 0, 0, 1};
    if (with_operations)
      state.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one_minus_dst_alpha};
    frame.draw(tie.view(), state);
    Renderer({.threads = 1}).finish(frame);
    std::size_t red = 0;
    std::size_t blue = 0;
    for (const std::uint32_t word : packed_colors(buffer)) {
      red += word == 0xff0000u;
      blue += word == 0x0000ffu;
    }
    EXPECT_EQ(blue, 0u);
    EXPECT_GT(red, 500u);
  }
}

// A quad cut by the near plane: the facing is that of the remaining part.
TEST(PolygonPrimitives, HaveOneFacingIfClipped) {
  Random random(77);
  int visible_quads = 0;
  for (int turn = 0; turn < 200; ++turn) {
    MeshData quad;
    quad.primitive = Primitive::quads;
    quad.position_components = 4;
    for (int v = 0; v < 4; ++v)
      for (const float x :
           {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2), random.between(-0.5f, 2)})
        quad.positions.push_back(x);
    const std::size_t all = pixels_of(quad, Cull::none, FrontFace::ccw);
    const std::size_t front = pixels_of(quad, Cull::back, FrontFace::ccw);
    const std::size_t back = pixels_of(quad, Cull::front, FrontFace::ccw);
    const bool is_front = front == all && back == 0;
    const bool is_back = front == 0 && back == all;
    EXPECT_TRUE(is_front || is_back) << "turn " << turn << ": " << front << " and " << back << " of " << all;
    visible_quads += all > 50;
  }
  EXPECT_GT(visible_quads, 50);
}

// Not planar: separate triangles would have different slopes and different units.
TEST(PolygonPrimitives, HaveOneOffset) {
  const auto depths = [](const std::vector<float>& positions, DepthFormat format, PolygonOffset offset) {
    MeshData quad;
    quad.primitive = Primitive::quads;
    quad.positions = positions;
    FrameBuffer buffer({.width = kWidth, .height = kHeight, .depth = format});
    Frame frame(buffer);
    frame.clear({.color = Color{}, .depth = 1});
    DrawState state = unlit({1, 1, 1, 1});
    state.polygon_offset = offset;
    frame.draw(quad.view(), state);
    Renderer({.threads = 1}).finish(frame);
    return stored_depths(buffer);
  };
  const std::vector<float> folded{-0.8f, -0.8f, 0, 0.8f, -0.8f, 0.6f, 0.8f, 0.8f, 0, -0.8f, 0.8f, 0};
  const std::vector<std::uint32_t> before = depths(folded, DepthFormat::unorm24, {});
  const std::vector<std::uint32_t> after = depths(folded, DepthFormat::unorm24, {20, 0});
  // Depth rises by 0.3 over 0.8 of the window's width in the first triangle.
  const double moved = 20 * (0.3 / (0.8 * kHeight)) * 0xffffff;
  int count = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == 0xffffff) continue;
    ++count;
    ASSERT_NEAR(static_cast<double>(after[i]) - before[i], moved, 0.001 * moved) << i;
  }
  EXPECT_GT(count, 2000);

  const std::vector<float> tilted{-0.8f, -0.8f, -0.1f, 0.8f,  -0.8f, 0.2f,
                                  0.8f,  0.8f,  -0.1f, -0.8f, 0.8f,  -0.4f};  // depths 0.45, 0.6, 0.45, 0.3
  const std::vector<std::uint32_t> plane = depths(tilted, DepthFormat::float32, {});
  const std::vector<std::uint32_t> unit = depths(tilted, DepthFormat::float32, {0, 1});
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (plane[i] == std::bit_cast<std::uint32_t>(1.0f)) continue;
    const float difference = std::bit_cast<float>(unit[i]) - std::bit_cast<float>(plane[i]);
    ASSERT_EQ(difference, 0x1p-24f) << i;
  }
}

TEST(PolygonPrimitives, HaveOneGeneratedNormal) {
  // Not planar: the triangles' normals differ. Their sum is (0, 0.2, 1), slightly rotated.
  MeshData quad;
  quad.primitive = Primitive::quads;
  quad.positions = {-0.8f, -0.8f, 0, 0.8f, -0.8f, 0.3f, 0.8f, 0.8f, 0, -0.8f, 0.8f, 0.3f};
  DrawState flat;
  flat.shading = Shading::flat;
  const std::vector<std::uint32_t> words = [&] {
    FrameBuffer buffer({.width = kWidth, .height = kHeight});
    Frame frame(buffer);
    frame.draw(quad.view(), flat);
    Renderer({.threads = 1}).finish(frame);
    return packed_colors(buffer);
  }();
  std::uint32_t found = 0;
  for (const std::uint32_t word : words) {
    if (word == 0) continue;
    if (found == 0) found = word;
    ASSERT_EQ(word, found) << "one colour for the whole quad";
  }
  EXPECT_NE(found, 0u);
  // Smooth: each vertex belongs to the face once, so the normal is the same everywhere too.
  flat.shading = Shading::gouraud;
  FrameBuffer buffer({.width = kWidth, .height = kHeight});
  Frame frame(buffer);
  frame.draw(quad.view(), flat);
  Renderer({.threads = 1}).finish(frame);
  for (const std::uint32_t word : packed_colors(buffer)) ASSERT_TRUE(word == 0 || word == found);
}

TEST(PolygonPrimitives, AreDroppedWholeIfAVertexIsNonFinite) {
  MeshData quads;
  quads.primitive = Primitive::quads;
  quads.positions = {-0.9f, -0.9f, 0, -0.1f, -0.9f, 0, -0.1f, 0.9f, 0, std::nanf(""), 0.9f, 0,
                     0.1f,  -0.9f, 0, 0.9f,  -0.9f, 0, 0.9f,  0.9f, 0, 0.1f,          0.9f, 0};
  FrameBuffer buffer({.width = kWidth, .height = kHeight});
  Frame frame(buffer);
  frame.draw(quads.view(), unlit({1, 1, 1, 1}));
  const FrameStats stats = Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(stats.dropped_non_finite, 2u);
  const std::vector<std::uint32_t> words = packed_colors(buffer);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) ASSERT_EQ(words[static_cast<std::size_t>(y * kWidth + x)], 0u);
  EXPECT_EQ(words[static_cast<std::size_t>(kHeight / 2 * kWidth + kWidth * 3 / 4)], 0xffffffu);
}

TEST(PolygonPrimitives, AreCountedByCaptures) {
  for (const PrimitiveCase& of : cases()) {
    const MeshData mesh = random_mesh(of, 3);
    FrameBuffer buffer({.width = kWidth, .height = kHeight});
    Frame frame(buffer);
    std::vector<std::uint32_t> numbers(static_cast<std::size_t>(kWidth * kHeight));
    frame.capture({.primitive_ids = numbers});
    frame.draw(mesh.view(), unlit({1, 1, 1, 1}));
    Renderer({.threads = 1}).finish(frame);
    std::uint32_t triangles_each = 1;
    if (of.primitive == Primitive::quads || of.primitive == Primitive::quad_strip) triangles_each = 2;
    if (of.primitive == Primitive::polygon) triangles_each = 4;
    const std::uint32_t count = static_cast<std::uint32_t>(of.triangles.size()) / triangles_each;
    // The same triangles, drawn separately.
    MeshData split = mesh;
    split.primitive = Primitive::triangles;
    for (const Split& t : of.triangles) split.indices.insert(split.indices.end(), t.corners, t.corners + 3);
    std::vector<std::uint32_t> of_triangles(numbers.size());
    Frame other(buffer);
    other.clear({.color = Color{}, .depth = 1});
    other.capture({.primitive_ids = of_triangles});
    other.draw(split.view(), unlit({1, 1, 1, 1}));
    Renderer({.threads = 1}).finish(other);
    std::set<std::uint32_t> found;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_EQ(numbers[i],
                of_triangles[i] == Capture::kNothing ? Capture::kNothing : of_triangles[i] / triangles_each)
          << of.name;
      found.insert(numbers[i]);
    }
    found.erase(Capture::kNothing);
    EXPECT_EQ(found.size(), count) << of.name;
  }
}

TEST(PolygonPrimitives, ErrorsNameTheVertexCount) {
  const auto error = [](Primitive primitive, std::size_t vertices, bool indexed) {
    MeshData mesh;
    mesh.primitive = primitive;
    mesh.positions.assign(3 * vertices, 0.0f);
    for (std::uint32_t i = 0; i < vertices && indexed; ++i) mesh.indices.push_back(i);
    FrameBuffer buffer({.width = 8, .height = 8});
    Frame frame(buffer);
    return error_of([&] { frame.draw(mesh.view(), {}); }).value_or("");
  };
  EXPECT_THAT(error(Primitive::quads, 5, false),
              AllOf(HasSubstr("5 vertices"), HasSubstr("quads need a multiple of 4")));
  EXPECT_THAT(error(Primitive::quads, 6, true), AllOf(HasSubstr("6 indices"), HasSubstr("a multiple of 4")));
  EXPECT_THAT(error(Primitive::triangles, 4, false),
              AllOf(HasSubstr("4 vertices"), HasSubstr("triangles need a multiple of 3")));
  EXPECT_THAT(error(Primitive::triangle_strip, 2, false),
              AllOf(HasSubstr("2 vertices"), HasSubstr("a triangle strip needs 3 or more")));
  EXPECT_THAT(error(Primitive::triangle_fan, 1, true),
              AllOf(HasSubstr("1 indices"), HasSubstr("a triangle fan needs 3 or more")));
  EXPECT_THAT(error(Primitive::polygon, 2, false), HasSubstr("a polygon needs 3 or more"));
  EXPECT_THAT(error(Primitive::quad_strip, 5, false),
              AllOf(HasSubstr("5 vertices"), HasSubstr("a quad strip needs 4, 6, 8, ...")));
  EXPECT_THAT(error(Primitive::quad_strip, 2, false), HasSubstr("4, 6, 8, ..."));
  for (const PrimitiveCase& of : cases()) EXPECT_EQ(error(of.primitive, 0, false), "") << of.name;
}

}  // namespace
}  // namespace tessera::polygon_primitives_test
