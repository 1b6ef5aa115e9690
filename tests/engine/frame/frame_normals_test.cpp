// Generated normals of meshes without normals, provoking vertices, mirrored transforms and two-sided
// lighting.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "engine/program/threads/thread_limit.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::frame_normals_test {
using namespace detail;
using namespace program;
namespace {

using namespace test;

const FrameBufferFormat kFormat{.width = 96, .height = 80};
constexpr Shading kShadings[] = {Shading::flat, Shading::gouraud, Shading::phong};

std::vector<std::uint32_t> words_of(const MeshData& mesh, const DrawState& state,
                                    const LightModel& model = {}) {
  FrameBuffer buffer(kFormat);
  Frame frame(buffer);
  Camera camera;
  camera.view = look_at({1, 1.5, 5}, {0, 0, 0}, {0, 1, 0});
  camera.projection = perspective(45, 96.0 / 80, 1, 20);
  frame.set_camera(camera);
  Light lights[2];
  lights[0].position = {2, 3, 4, 1};
  lights[1].position = {-1, 0.5f, 0.2f, 0};
  lights[1].diffuse = {0.2f, 0.3f, 0.6f, 1};
  frame.set_lights(lights);
  frame.set_light_model(model);
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1}).finish(frame);
  return packed_colors(buffer);
}
std::uint32_t corner(const MeshData& mesh, std::size_t i) {
  return mesh.indices.empty() ? static_cast<std::uint32_t>(i) : mesh.indices[i];
}
std::size_t corner_count(const MeshData& mesh) {
  return mesh.indices.empty() ? mesh.vertex_count() : mesh.indices.size();
}

// A bumpy sheet with triangles of very different sizes.
MeshData sheet(std::uint32_t side = 6) {
  MeshData mesh;
  const auto last = static_cast<float>(side - 1);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const float u = 2 * static_cast<float>(x * x) / (last * last) - 1;
      const float v = 2 * static_cast<float>(y) / last - 1;
      mesh.positions.insert(mesh.positions.end(),
                            {1.4f * u, 1.4f * v, 0.3f * std::sin(2 * u) * static_cast<float>(y % 3)});
    }
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + side + 1, a, a + side + 1, a + side});
    }
  return mesh;
}
// Separate vertices for every corner.
MeshData split_up(const MeshData& mesh) {
  MeshData result;
  for (std::size_t i = 0; i < corner_count(mesh); ++i) {
    const std::size_t v = corner(mesh, i);
    result.positions.insert(result.positions.end(),
                            mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * v),
                            mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * v + 3));
  }
  return result;
}

using Vector = std::array<double, 3>;
Vector doubled_area(const MeshData& mesh, std::size_t triangle) {
  Vector p[3];
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) p[k][c] = mesh.positions[3 * corner(mesh, 3 * triangle + k) + c];
  const Vector u{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]},
      v{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
void append_unit(const Vector& n, std::vector<float>& out) {
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (const double c : n) out.push_back(static_cast<float>(length > 0 ? c / length : 0));
}
// The definitions of the two kinds of generated normals, implemented directly.
MeshData with_face_normals(const MeshData& mesh) {
  MeshData result = split_up(mesh);
  for (std::size_t i = 0; i < corner_count(mesh); ++i) append_unit(doubled_area(mesh, i / 3), result.normals);
  return result;
}
MeshData with_smooth_normals(const MeshData& mesh) {
  MeshData result = mesh;
  const auto position = [&](std::size_t v) {
    return Vector{mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
  };
  std::map<Vector, Vector> sums;  // 0 and -0 compare equal
  for (std::size_t i = 0; i < corner_count(mesh); ++i) {
    Vector& sum = sums[position(corner(mesh, i))];
    const Vector n = doubled_area(mesh, i / 3);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += n[c];
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) append_unit(sums.at(position(v)), result.normals);
  return result;
}
DrawState shaded(Shading shading) {
  DrawState state;
  state.shading = shading;
  state.material.specular = {0.3f, 0.3f, 0.3f, 1};
  state.material.shininess = 9;
  return state;
}

TEST(GeneratedNormals, FlatMeshesUseFaceNormals) {
  for (const MeshData& mesh : {sheet(), split_up(sheet())})
    for (const ProvokingVertex provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
      DrawState state = shaded(Shading::flat);
      state.provoking_vertex = provoking;
      EXPECT_EQ(words_of(mesh, state), words_of(with_face_normals(mesh), state));
    }
}

TEST(GeneratedNormals, SmoothMeshesUseAreaWeightedMeans) {
  for (const Shading shading : {Shading::gouraud, Shading::phong})
    for (const MeshData& mesh : {sheet(), split_up(sheet())}) {
      EXPECT_EQ(words_of(mesh, shaded(shading)), words_of(with_smooth_normals(mesh), shaded(shading)));
      EXPECT_NE(words_of(mesh, shaded(shading)), words_of(with_face_normals(mesh), shaded(shading)));
    }
}

// Large enough for a vertex search in several parts: 12,100 vertices, and 71,286 at the same positions.
TEST(GeneratedNormals, LargeSmoothMeshesUseTheSameMeans) {
  const MeshData mesh = sheet(110);
  const MeshData split = split_up(mesh);
  const std::vector<std::uint32_t> expected = words_of(with_smooth_normals(mesh), shaded(Shading::gouraud));
  EXPECT_EQ(words_of(mesh, shaded(Shading::gouraud)), expected);
  EXPECT_EQ(words_of(split, shaded(Shading::gouraud)), expected);
}

// Large meshes, some processed in several parts, and small ones, between draws that change nothing.
TEST(GeneratedNormals, ManyMeshesInAFrameUseTheSameMeans) {
  std::vector<MeshData> meshes;
  std::vector<MeshData> given;
  for (const std::uint32_t side : {3u, 60u, 4u, 40u, 5u, 90u, 7u, 25u, 33u, 6u, 45u, 2u}) {
    meshes.push_back(sheet(side));
    given.push_back(with_smooth_normals(meshes.back()));
  }
  const auto words = [](const std::vector<MeshData>& all, int threads) {
    FrameBuffer buffer(kFormat);
    Frame frame(buffer);
    for (int round = 0; round < 10; ++round)
      for (std::size_t i = 0; i < all.size(); ++i) {
        DrawState state = shaded(round % 2 == 0 ? Shading::gouraud : Shading::phong);
        state.transform = translate(0.18 * round - 0.9, 0.15 * static_cast<double>(i) - 0.8, 0) *
                          scale(0.08, 0.08, 0.5) * rotate(7.0 * round, 1, 1, 0);
        if ((static_cast<std::size_t>(round) + i) % 5 == 0) state.color_mask = {false, false, false, false};
        state.depth.enabled = state.color_mask[0];
        frame.draw(all[i].view(), state);
      }
    Renderer({.threads = threads}).finish(frame);
    return packed_colors(buffer);
  };
  const ThreadLimit limit(5);
  const std::vector<std::uint32_t> expected = words(given, 1);
  for (const int threads : {1, 2, 5}) EXPECT_EQ(words(meshes, threads), expected) << threads << " threads";
}

TEST(GeneratedNormals, BelongToPositionsNotToVertices) {
  for (const Shading shading : kShadings)
    EXPECT_EQ(words_of(sheet(), shaded(shading)), words_of(split_up(sheet()), shaded(shading)));
}

// A quad with two corners at one position equals the remaining triangle.
TEST(GeneratedNormals, CountAFaceOncePerPosition) {
  const MeshData triangles = sheet();
  for (std::size_t twice = 0; twice < 3; ++twice) {
    MeshData quads = triangles;
    quads.primitive = Primitive::quads;
    quads.indices.clear();
    for (std::size_t t = 0; t < triangles.indices.size(); t += 3)
      for (std::size_t k = 0; k < 4; ++k)
        quads.indices.push_back(triangles.indices[t + (k > twice ? k - 1 : k)]);
    for (const Shading shading : kShadings)
      EXPECT_EQ(words_of(quads, shaded(shading)), words_of(triangles, shaded(shading))) << twice;
  }
}

TEST(GeneratedNormals, CountZeroAndMinusZeroAsOnePosition) {
  MeshData roof;  // two triangles that meet at x = 0
  roof.positions = {-1, 0, 0, 0, -1, 0.5f, 0, 1, 0.5f, 1, 0, 0, 0, 1, 0.5f, 0, -1, 0.5f};
  MeshData signed_roof = roof;
  signed_roof.positions[3] = signed_roof.positions[6] = -0.0f;
  EXPECT_EQ(words_of(signed_roof, shaded(Shading::gouraud)), words_of(roof, shaded(Shading::gouraud)));
  EXPECT_EQ(words_of(roof, shaded(Shading::gouraud)),
            words_of(with_smooth_normals(roof), shaded(Shading::gouraud)));
}

TEST(GeneratedNormals, IgnoreDroppedTriangles) {
  MeshData mesh = split_up(sheet());
  const MeshData whole = mesh;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.positions.insert(mesh.positions.end(), mesh.positions.begin(), mesh.positions.begin() + 6);
  mesh.positions.insert(mesh.positions.end(), {nan, 0, 0});
  for (const Shading shading : kShadings)
    EXPECT_EQ(words_of(mesh, shaded(shading)), words_of(whole, shaded(shading)));
}

TEST(GeneratedNormals, FollowTheTransform) {
  DrawState state = shaded(Shading::flat);
  state.transform = rotate(35, 1, 2, 0.5) * scale(0.7, 1.6, 0.9);
  EXPECT_EQ(words_of(sheet(), state), words_of(with_face_normals(sheet()), state));
  state.shading = Shading::phong;
  EXPECT_EQ(words_of(sheet(), state), words_of(with_smooth_normals(sheet()), state));
}

TEST(ProvokingVertex, ColorsAFlatTriangle) {
  MeshData mesh = split_up(rectangle(-1, -1, 1, 1));
  for (const float c : {0.f, 1.f, 0.2f, 0.4f, 0.6f, 0.8f})
    mesh.colors.insert(mesh.colors.end(), {c, 0, 0, 1});
  const auto reds = [&](const DrawState& state) {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t word : words_of(mesh, state))
      if (std::find(found.begin(), found.end(), word >> 16) == found.end()) found.push_back(word >> 16);
    std::sort(found.begin(), found.end());
    return found;
  };
  DrawState state;
  state.shading = Shading::flat;
  state.lighting = false;
  state.provoking_vertex = ProvokingVertex::last;
  EXPECT_EQ(reds(state), (std::vector<std::uint32_t>{0, 51, 204}));
  state.provoking_vertex = ProvokingVertex::first;
  EXPECT_EQ(reds(state), (std::vector<std::uint32_t>{0, 102}));
  state.transform = translate(0, 0, 1) * scale(9, 9, 9) * rotate(80, 1, 0, 0);  // cut by the near plane
  EXPECT_EQ(reds(state), (std::vector<std::uint32_t>{0, 102}));
  state.provoking_vertex = ProvokingVertex::last;
  EXPECT_EQ(reds(state), (std::vector<std::uint32_t>{0, 51, 204}));
}

// A sheet that faces the viewer and a light in that direction: its brightness is 0.04 + 0.8 if lit, 0.04 if
// facing away.
constexpr std::uint32_t kLit = 0xd6d6d6;
constexpr std::uint32_t kDark = 0x0a0a0a;
std::uint32_t middle(const MeshData& mesh, const DrawState& state, const LightModel& model) {
  FrameBuffer buffer({.width = 9, .height = 9});
  Frame frame(buffer);
  frame.clear({.color = Color{0, 0, 1, 1}});
  frame.set_light_model(model);
  frame.draw(mesh.view(), state);
  Renderer({.threads = 1}).finish(frame);
  return packed_colors(buffer)[4 * 9 + 3];
}

TEST(FrameMirroredTransforms, FlipTheWindingAndKeepTheNormal) {
  const MeshData mesh = rectangle(-1, -1, 1, 1);
  const MeshData given = with_smooth_normals(mesh);
  for (const MeshData& m : {mesh, given})
    for (const Shading shading : kShadings) {
      DrawState state;
      state.shading = shading;
      for (const bool mirrored : {false, true}) {
        if (mirrored) state.transform = scale(-1, 1, 1);
        EXPECT_EQ(middle(m, state, {}), kLit) << "one-sided: the normal decides";
        state.front_face = mirrored ? FrontFace::cw : FrontFace::ccw;
        EXPECT_EQ(middle(m, state, {.two_sided = true}), kLit);
        state.front_face = mirrored ? FrontFace::ccw : FrontFace::cw;
        EXPECT_EQ(middle(m, state, {.two_sided = true}), kDark) << "classified as a back face";
        state.cull = Cull::back;
        EXPECT_EQ(middle(m, state, {}), 0x0000ffu) << "and culled as a back face";
        state.cull = Cull::front;
        EXPECT_EQ(middle(m, state, {}), kLit);
        state.cull = Cull::none;
      }
    }
}

TEST(TwoSidedLighting, LightsBacksWithTheirMaterialAndTheNegatedNormal) {
  const MeshData mesh = rectangle(-1, -1, 1, 1);
  for (const MeshData& m : {mesh, with_smooth_normals(mesh)})
    for (const Shading shading : kShadings) {
      DrawState state;
      state.shading = shading;
      state.back_material = Material{.diffuse = {0, 0.5f, 0, 1}};
      EXPECT_EQ(middle(m, state, {.two_sided = true}), kLit);
      state.transform = rotate(180, 0, 1, 0);
      EXPECT_EQ(middle(m, state, {}), kDark) << "one-sided: facing away, with the front material";
      EXPECT_EQ(middle(m, state, {.two_sided = true}), 0x0a8a0au);
      state.back_material.reset();
      EXPECT_EQ(middle(m, state, {.two_sided = true}), kLit) << "without a back material: as the front";
    }
}

}  // namespace
}  // namespace tessera::frame_normals_test
