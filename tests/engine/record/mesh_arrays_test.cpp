// Vertices and indices in the caller's layouts: the picture equals that of packed floats, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::mesh_arrays_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

constexpr FrameBufferFormat kFormat{.width = 90, .height = 70};
constexpr std::size_t kVertices = 60;

// A common layout: all attributes of a vertex together.
struct Vertex {
  std::uint16_t before;
  std::uint8_t color[4];
  std::uint16_t between;
  float position[3];
  std::uint32_t more;
  float normal[3];
  float float_color[4];
};

struct Meshes {
  std::vector<Vertex> vertices;
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> colors;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint16_t> short_indices;

  Meshes() {
    Random random(11);
    for (std::size_t i = 0; i < kVertices; ++i) {
      Vertex v{};
      for (float& p : v.position) positions.push_back(p = random.between(-1, 1));
      for (float& n : v.normal) normals.push_back(n = random.between(-1, 1));
      for (std::size_t c = 0; c < 4; ++c) {
        bytes.push_back(v.color[c] = static_cast<std::uint8_t>(random.next()));
        colors.push_back(v.float_color[c] = static_cast<float>(v.color[c]) / 255.0f);
      }
      vertices.push_back(v);
    }
    for (std::size_t i = 0; i < 3 * kVertices; ++i) indices.push_back(random.next() % kVertices);
    short_indices.assign(indices.begin(), indices.end());
  }
  Mesh packed() const {
    return {.positions = positions, .normals = normals, .colors = colors, .indices = indices};
  }
};

Fingerprint drawn(const Mesh& mesh, const DrawState& state) {
  Renderer renderer({.threads = 1});
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw(mesh, state);
  renderer.finish(frame);
  return fingerprint(buffer);
}

class MeshArrays : public testing::TestWithParam<DrawState> {
 protected:
  const Meshes m;
  void expect_same(const char* what, Mesh packed, Mesh mesh) const {
    EXPECT_EQ(drawn(packed, GetParam()), drawn(mesh, GetParam())) << what;
  }
};

TEST_P(MeshArrays, MatchPackedFloatsIfInterleaved) {
  Mesh mesh = m.packed();
  mesh.positions = {m.vertices[0].position, kVertices, sizeof(Vertex)};
  expect_same("positions", m.packed(), mesh);
  mesh.normals = {m.vertices[0].normal, kVertices, sizeof(Vertex)};
  expect_same("normals", m.packed(), mesh);
  mesh.colors = {m.vertices[0].float_color, kVertices, sizeof(Vertex)};
  expect_same("colours", m.packed(), mesh);
  mesh.colors = {m.vertices[0].color, kVertices, sizeof(Vertex)};
  expect_same("colours of bytes", m.packed(), mesh);
  mesh.indices = m.short_indices;
  expect_same("indices of 16 bits", m.packed(), mesh);
}

TEST_P(MeshArrays, MatchPackedFloatsAsBytesAndShortIndices) {
  Mesh mesh = m.packed();
  mesh.colors = m.bytes;
  expect_same("colours", m.packed(), mesh);
  mesh.indices = m.short_indices;
  expect_same("indices", m.packed(), mesh);
  mesh.positions = {m.positions.data(), kVertices, 0};
  mesh.normals = {m.normals.data(), kVertices, 0};
  mesh.colors = {m.bytes.data(), kVertices, 0};
  expect_same("a stride of 0 is packed", m.packed(), mesh);
  Mesh no_normals = m.packed();
  Mesh short_no_normals = mesh;
  no_normals.normals = short_no_normals.normals = {};
  short_no_normals.positions = {m.vertices[0].position, kVertices, sizeof(Vertex)};
  expect_same("without normals", no_normals, short_no_normals);
}

INSTANTIATE_TEST_SUITE_P(
    States, MeshArrays,
    testing::Values(DrawState{.shading = Shading::flat, .color_material = ColorMaterial::diffuse},
                    DrawState{.shading = Shading::gouraud, .color_material = ColorMaterial::diffuse},
                    DrawState{.shading = Shading::phong, .color_material = ColorMaterial::diffuse},
                    DrawState{.shading = Shading::gouraud, .lighting = false}));

TEST(MeshArraysErrors, NameTheMismatch) {
  const Meshes m;
  const float* const floats = m.positions.data();
  const struct {
    const char* what;
    void (*change)(Mesh&, const float*, const Meshes&);
    const char* says;
  } rows[] = {
      {"stride",
       [](Mesh& mesh, const float* p, const Meshes&) {
         mesh.positions = {p, 6, 14};
       },
       "stride of 14 bytes for positions, must be a multiple of 4 and at least 12"},
      {"small stride",
       [](Mesh& mesh, const float* p, const Meshes&) {
         mesh.positions = {p, 6, 8};
       },
       "stride of 8 bytes for positions"},
      {"four components",
       [](Mesh& mesh, const float* p, const Meshes&) {
         mesh.positions = {p, 6, 12};
         mesh.position_components = 4;
       },
       "at least 16"},
      {"odd address",
       [](Mesh& mesh, const float* p, const Meshes&) {
         mesh.positions = {reinterpret_cast<const float*>(reinterpret_cast<const char*>(p) + 2), 6, 12};
       },
       "positions at an address that is no multiple of 4"},
      {"no address",
       [](Mesh& mesh, const float*, const Meshes&) {
         mesh.positions = {nullptr, 6, 12};
       },
       "no address for positions"},
      {"normals",
       [](Mesh& mesh, const float* p, const Meshes&) {
         mesh.normals = {p, 5, 12};
       },
       "normals of 5 vertices, but 60 vertices"},
      {"bytes",
       [](Mesh& mesh, const float*, const Meshes& n) {
         mesh.colors = {n.bytes.data(), kVertices, 3};
       },
       "stride of 3 bytes for colors, must be at least 4"},
      {"too few bytes",
       [](Mesh& mesh, const float*, const Meshes& n) {
         mesh.colors = {n.bytes.data(), 2, 4};
       },
       "colors of 2 vertices"},
      {"half a colour",
       [](Mesh& mesh, const float*, const Meshes& n) {
         mesh.colors = std::span(n.bytes).first(4 * kVertices - 1);
       },
       "239 bytes of colors, its 60 vertices need 240"},
      {"both",
       [](Mesh& mesh, const float*, const Meshes& n) {
         mesh.colors = n.bytes;
         mesh.colors.floats = n.colors;
       },
       "colors twice"},
      {"packed with a stride",
       [](Mesh& mesh, const float*, const Meshes&) { mesh.positions.stride_bytes = 12; },
       "180 packed floats of positions and also 0 vertices with a stride of 12 bytes"},
      {"packed of vertices", [](Mesh& mesh, const float*, const Meshes&) { mesh.normals.vertices = 60; },
       "180 packed floats of normals and also 60 vertices"},
      {"packed bytes with a stride",
       [](Mesh& mesh, const float*, const Meshes& n) {
         mesh.colors = n.bytes;
         mesh.colors.stride_bytes = 4096;
       },
       "240 packed bytes of colors and also 0 vertices with a stride of 4096 bytes"},
      {"stride of no bytes",
       [](Mesh& mesh, const float*, const Meshes& n) {
         mesh.colors = n.colors;
         mesh.colors.stride_bytes = 32;
       },
       "a stride of 32 bytes for colors, but no bytes of colors"},
      {"bits", [](Mesh& mesh, const float*, const Meshes&) { mesh.indices.bits = 8; },
       "indices of 8 bits, must be 16 or 32"},
  };
  for (const auto& row : rows) {
    FrameBuffer buffer(kFormat);
    Frame frame(buffer);
    Mesh mesh = m.packed();
    row.change(mesh, floats, m);
    EXPECT_THAT(error_of([&] { frame.draw(mesh, {}); }).value_or("(none)"), testing::HasSubstr(row.says))
        << row.what;
    EXPECT_EQ(frame.draw_count(), 0u);
  }
}

// The caller's thread checks short index arrays, all workers check long ones; the error names the first
// invalid index, and earlier recordings remain.
TEST(MeshIndices, InvalidOnesAreNamed) {
  const std::vector<float> triangle{-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const auto indices = [](auto first, std::size_t count, std::size_t wrong_at, auto wrong) {
    std::vector<decltype(first)> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(static_cast<decltype(first)>(i % 3));
    if (wrong_at < all.size()) all[wrong_at] = wrong, all.back() = wrong;
    return all;
  };
  const auto good = indices(std::uint32_t{}, 90'000, 90'000, std::uint32_t{});
  const auto last = indices(std::uint32_t{}, 90'000, 89'999, std::uint32_t{3});
  const auto middle = indices(std::uint32_t{}, 90'000, 50'000, 0xffff'ffffu);
  const auto first = indices(std::uint16_t{}, 90'000, 0, std::uint16_t{0xffff});
  const auto few = indices(std::uint16_t{}, 300, 155, std::uint16_t{4});
  const struct {
    IndexArray indices;
    const char* says;
  } rows[] = {
      {last, "Frame::draw: index 89999 of the mesh is 3, must be below the number of vertices, 3"},
      {middle, "Frame::draw: index 50000 of the mesh is 4294967295, must be below"},
      {first, "Frame::draw: index 0 of the mesh is 65535, must be below"},
      {few, "Frame::draw: index 155 of the mesh is 4, must be below"},
  };
  ThreadLimit limit(3);
  for (const auto& row : rows)
    for (const int helpers : {0, 1, 3}) {
      SCOPED_TRACE(row.says + std::string(", threads that help: ") + std::to_string(helpers));
      FrameBuffer buffer(kFormat);
      Renderer renderer({.threads = std::max(1, helpers)});
      Frame frame = helpers == 0 ? Frame(buffer) : Frame(buffer, renderer);
      frame.draw({.positions = triangle, .indices = good}, {.lighting = false});
      EXPECT_THAT(
          error_of([&] { frame.draw({.positions = triangle, .indices = row.indices}); }).value_or("(none)"),
          testing::StartsWith(row.says));
      EXPECT_EQ(frame.draw_count(), 1u);
      EXPECT_EQ(renderer.finish(frame).triangles_in, 30'000u);
    }
}

/// Counts its calls and keeps the largest number of tasks.
struct CountingExecutor : Executor {
  int calls = 0;
  int max_count = 0;
  bool fails = false;
  int workers() const noexcept override { return 3; }
  void run(int count, void (*work)(void*, int), void* context) override {
    if (fails) throw std::runtime_error("no workers today");
    ++calls;
    max_count = std::max(max_count, count);
    for (int k = 0; k < count; ++k) work(context, k);
  }
};

TEST(MeshIndices, LongArraysAreCheckedByTheRenderersWorkers) {
  const std::vector<float> triangle{-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const std::vector<std::uint32_t> many(90'000, 1);
  const std::vector<std::uint32_t> few(300, 1);
  const auto executor = std::make_shared<CountingExecutor>();
  Renderer renderer({.executor = executor});
  FrameBuffer buffer(kFormat);
  Frame alone(buffer);
  Frame helped(buffer, renderer);
  alone.draw({.positions = triangle, .indices = many});
  helped.draw({.positions = triangle, .indices = few});
  EXPECT_EQ(executor->calls, 0);
  Renderer moved(std::move(renderer));
  EXPECT_THAT(error_of([&] { Frame frame(buffer, renderer); }).value_or("(none)"),
              testing::HasSubstr("the renderer was moved from"));
  helped.draw({.positions = triangle, .indices = many});
  EXPECT_EQ(executor->calls, 1);
  EXPECT_EQ(executor->max_count, 3);
  executor->fails = true;
  EXPECT_THROW(helped.draw({.positions = triangle, .indices = many}), std::runtime_error);
  EXPECT_EQ(helped.draw_count(), 2u);
}

}  // namespace
}  // namespace tessera::mesh_arrays_test
