// Odd numbers in a mesh's arrays, for every primitive. A non-finite value drops exactly the primitives that
// use it, and they are counted. Finite values of any size are drawn identically on every instruction set.
// Invalid sizes and indices are rejected by `Frame::draw`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

#include "tests/numerics/interface_case.h"
#include "tests/numerics/odd_values.h"

namespace tessera::test::odd_data_test {
namespace {

constexpr int kVertices = 24;  // whole primitives of all kinds
constexpr Primitive kPrimitives[] = {Primitive::points,       Primitive::lines,     Primitive::line_strip,
                                     Primitive::line_loop,    Primitive::triangles, Primitive::triangle_strip,
                                     Primitive::triangle_fan, Primitive::quads,     Primitive::quad_strip,
                                     Primitive::polygon};

using Element = std::vector<std::uint32_t>;

// [GL 2.1, 2.6.1]; quads of strips in outline order.
std::vector<Element> elements_of(Primitive primitive, std::uint32_t n) {
  std::vector<Element> elements;
  switch (primitive) {
    case Primitive::points:
      for (std::uint32_t i = 0; i < n; ++i) elements.push_back({i});
      break;
    case Primitive::lines:
      for (std::uint32_t i = 0; i + 1 < n; i += 2) elements.push_back({i, i + 1});
      break;
    case Primitive::line_strip:
    case Primitive::line_loop:
      for (std::uint32_t i = 0; i + 1 < n; ++i) elements.push_back({i, i + 1});
      if (primitive == Primitive::line_loop) elements.push_back({n - 1, 0});
      break;
    case Primitive::triangles:
      for (std::uint32_t i = 0; i + 2 < n; i += 3) elements.push_back({i, i + 1, i + 2});
      break;
    case Primitive::triangle_strip:
      for (std::uint32_t i = 0; i + 2 < n; ++i) elements.push_back({i + i % 2, i + 1 - i % 2, i + 2});
      break;
    case Primitive::triangle_fan:
      for (std::uint32_t i = 0; i + 2 < n; ++i) elements.push_back({0, i + 1, i + 2});
      break;
    case Primitive::quads:
      for (std::uint32_t i = 0; i + 3 < n; i += 4) elements.push_back({i, i + 1, i + 2, i + 3});
      break;
    case Primitive::quad_strip:
      for (std::uint32_t i = 0; i + 3 < n; i += 2) elements.push_back({i, i + 1, i + 3, i + 2});
      break;
    case Primitive::polygon:
      elements.emplace_back();
      for (std::uint32_t i = 0; i < n; ++i) elements.back().push_back(i);
      break;
  }
  return elements;
}
// As counted in FrameStats.
std::uint64_t counted(const Element& e) { return e.size() < 3 ? 1 : e.size() - 2; }

// Vertices all over the window. All attributes but the positions are equal, so that the order of the
// remaining primitives does not matter.
MeshData mesh_of(Primitive primitive) {
  MeshData mesh;
  mesh.primitive = primitive;
  Random random(23);
  for (int i = 0; i < kVertices; ++i) {
    const double angle = 6.2831853 * i / kVertices;  // on a circle, so that the polygon is convex
    const bool round = primitive == Primitive::polygon || primitive == Primitive::triangle_fan;
    for (const double c : {round ? std::cos(angle) * 0.9 : random.between(-0.9f, 0.9f),
                           round ? std::sin(angle) * 0.8 : random.between(-0.9f, 0.9f), 0.3})
      mesh.positions.push_back(static_cast<float>(c));
    mesh.normals.insert(mesh.normals.end(), {0.3f, 0.1f, 0.9f});
    mesh.colors.insert(mesh.colors.end(), {0.2f, 0.5f, 0.9f, 1});
    mesh.texcoords.insert(mesh.texcoords.end(), {0.3f, 0.6f});
    mesh.color_indices.push_back(17);
  }
  return mesh;
}

struct Drawn {
  Fingerprint fingerprint;
  FrameStats stats;
};
Drawn draw(const MeshData& mesh, const DrawState& state, const FrameBufferFormat& format,
           InstructionSet set = InstructionSet::automatic) {
  FrameBuffer buffer(format);
  Frame frame(buffer);
  frame.clear({.color = Color{0.1f, 0.1f, 0.1f, 1}});
  frame.draw(mesh.view(), state);
  const FrameStats stats = Renderer({.threads = 1, .instruction_set = set}).finish(frame);
  return {fingerprint(buffer), stats};
}

/// The same elements as separate primitives, without those that use the vertex.
MeshData without(const MeshData& mesh, std::uint32_t vertex, std::uint64_t& dropped) {
  MeshData rest = mesh;
  const std::vector<Element> elements = elements_of(mesh.primitive, kVertices);
  const std::size_t corners = elements.front().size();
  switch (corners) {
    case 1: rest.primitive = Primitive::points; break;
    case 2: rest.primitive = Primitive::lines; break;
    case 3: rest.primitive = Primitive::triangles; break;
    default: rest.primitive = Primitive::quads; break;
  }
  dropped = 0;
  rest.indices.clear();
  for (const Element& e : elements) {
    const bool has = std::find(e.begin(), e.end(), vertex) != e.end();
    if (has) dropped += counted(e);
    else rest.indices.insert(rest.indices.end(), e.begin(), e.end());
  }
  if (rest.indices.empty()) rest = {};
  return rest;
}

struct Array {
  const char* name;
  std::vector<float> MeshData::*values;
  std::size_t each;
  std::function<bool(const DrawState&, const FrameBufferFormat&)> matters;
};
std::vector<Array> arrays() {
  const auto index = [](const FrameBufferFormat& f) { return f.color_mode == ColorMode::index; };
  return {
      {"positions", &MeshData::positions, 3, [](const DrawState&, const FrameBufferFormat&) { return true; }},
      {"normals", &MeshData::normals, 3,
       [](const DrawState& s, const FrameBufferFormat&) { return s.lighting; }},
      {"colors", &MeshData::colors, 4,
       [=](const DrawState& s, const FrameBufferFormat& f) {
         return !index(f) && (!s.lighting || s.color_material != ColorMaterial::none);
       }},
      {"texcoords", &MeshData::texcoords, 2,
       [=](const DrawState& s, const FrameBufferFormat& f) { return s.texture != nullptr && !index(f); }},
      {"color_indices", &MeshData::color_indices, 1,
       [=](const DrawState& s, const FrameBufferFormat& f) { return index(f) && !s.lighting; }}};
}

const Texture& some_texture() {
  static const std::uint8_t texels[] = {255, 0, 90, 255, 10, 200, 40, 255, 30, 60, 90, 255, 120, 250, 7, 255};
  static const Texture texture({.pixels = texels, .width = 2, .height = 2});
  return texture;
}

/// Calls check(state, format) for shadings, textures, polygon modes, samples and formats in turn.
template <class Check>
void for_each_way(const Check& check) {
  int turn = 0;
  for (const bool lighting : {true, false})
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong})
      for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point})
        for (const int samples : {1, 4, 8}) {
          DrawState state;
          state.lighting = lighting;
          state.shading = shading;
          state.front_mode = state.back_mode = mode;
          state.line_width = state.point_size = 3;
          if (turn % 2 == 0) state.texture = &some_texture();
          if (turn % 3 == 1) state.color_material = ColorMaterial::diffuse;
          if (turn % 5 == 4) state.cull = Cull::back;
          FrameBufferFormat format{.width = 61, .height = 47, .samples = samples};
          if (samples == 1 && turn % 4 == 3) {
            format.color_mode = ColorMode::index;
            format.color_bits = 8;
          }
          ++turn;
          check(state, format);
          if (testing::Test::HasFailure()) return;
        }
}

TEST(OddMeshArrays, NonFiniteValuesDropExactlyTheirPrimitives) {
  constexpr float kOdd[] = {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::signaling_NaN(),
                            std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  Random random(24);
  for (const Primitive primitive : kPrimitives)
    for_each_way([&](const DrawState& state, const FrameBufferFormat& format) {
      const MeshData good = mesh_of(primitive);
      for (const Array& array : arrays()) {
        MeshData bad = good;
        const std::uint32_t vertex = random.next() % kVertices;
        (bad.*array.values)[array.each * vertex + random.next() % array.each] =
            kOdd[random.next() % std::size(kOdd)];
        std::uint64_t dropped = 0;
        const MeshData rest = array.matters(state, format) ? without(good, vertex, dropped) : good;
        const Drawn found = draw(bad, state, format);
        const Drawn expected = draw(rest, state, format);
        EXPECT_EQ(found.fingerprint, expected.fingerprint) << "remaining primitives";
        EXPECT_EQ(found.stats.dropped_non_finite, dropped);
        if (testing::Test::HasFailure()) {
          ADD_FAILURE() << "primitive " << static_cast<int>(primitive) << ", " << array.name << " of vertex "
                        << vertex << ", " << (state.lighting ? "lit" : "unlit") << ", shading "
                        << static_cast<int>(state.shading) << ", mode " << static_cast<int>(state.front_mode)
                        << ", cull " << static_cast<int>(state.cull) << ", " << describe(format);
          return;
        }
      }
    });
}

TEST(OddMeshArrays, FiniteValuesAreDrawnIdenticallyOnEveryInstructionSet) {
  std::vector<float> values = odd_values<float>();
  std::erase_if(values, [](float v) { return !std::isfinite(v); });
  Random random(25);
  for (const Primitive primitive : kPrimitives)
    for_each_way([&](DrawState state, const FrameBufferFormat& format) {
      state.viewport = Rect{3, 5, 50, 37};
      state.scissor = Rect{7, 6, 43, 33};
      for (const Array& array : arrays()) {
        MeshData odd = mesh_of(primitive);
        for (int k = 0; k < 4; ++k) {
          auto& numbers = odd.*array.values;
          numbers[random.next() % numbers.size()] = values[random.next() % values.size()];
        }
        if (random.next() % 4 == 0) odd.normals.clear();
        std::optional<Fingerprint> first;
        for (const InstructionSet set : available_instruction_sets()) {
          const Drawn found = draw(odd, state, format, set);
          EXPECT_EQ(found.stats.dropped_non_finite, 0u) << array.name;
          if (!first) first = found.fingerprint;
          EXPECT_EQ(found.fingerprint, *first)
              << array.name << " of primitive " << static_cast<int>(primitive) << " on " << name(set);
        }
      }
      // Outside the area that it may write, only the clear value remains.
      MeshData odd = mesh_of(primitive);
      for (int k = 0; k < 9; ++k)
        odd.positions[random.next() % odd.positions.size()] = values[random.next() % values.size()];
      FrameBuffer buffer(format);
      Frame frame(buffer);
      frame.draw(odd.view(), state);
      Renderer({.threads = 1}).finish(frame);
      const auto words = packed_colors(buffer);
      for (int y = 0; y < format.height; ++y)
        for (int x = 0; x < format.width; ++x)
          if (!contains(state.viewport, x, y) || !contains(state.scissor, x, y)) {
            ASSERT_EQ(words[static_cast<std::size_t>((format.height - 1 - y) * format.width + x)], 0u)
                << x << ", " << y;
          }
    });
}

// Vertices at equal positions share a normal. NaN positions equal none, and must not cost a search through
// all other NaN positions each.
TEST(OddMeshArrays, ManyNanVerticesTakeNoLonger) {
  const std::vector<float> positions(3 * 300000, std::numeric_limits<float>::quiet_NaN());
  FrameBuffer buffer({.width = 40, .height = 30});
  Frame frame(buffer);
  frame.draw({.positions = positions});
  const std::clock_t begin = std::clock();
  const FrameStats stats = Renderer({.threads = 1}).finish(frame);
  EXPECT_EQ(stats.dropped_non_finite, 100000u);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 10)
      << "quadratic search over NaN positions";
}

TEST(OddMeshArrays, IndicesOutOfRangeAreRefusedForEveryPrimitive) {
  FrameBuffer buffer({.width = 8, .height = 8});
  for (const Primitive primitive : kPrimitives) {
    MeshData data = mesh_of(primitive);
    std::vector<std::uint16_t> narrow;
    for (std::uint32_t i = 0; i < kVertices; ++i) {
      data.indices.push_back(i);
      narrow.push_back(static_cast<std::uint16_t>(i));
    }
    Frame frame(buffer);
    const auto error = [&](const Mesh& mesh) { return error_of([&] { frame.draw(mesh); }).value_or(""); };
    for (const std::size_t place :
         {std::size_t{0}, std::size_t{1}, std::size_t{13}, std::size_t{kVertices - 1}})
      for (const std::uint32_t wrong :
           {std::uint32_t{kVertices}, 0x7fffu, 0xffffu, 0x80000000u, 0xffffffffu}) {
        std::vector<std::uint32_t> wide = data.indices;
        wide[place] = wrong;
        Mesh mesh = data.view();
        mesh.indices = wide;
        EXPECT_THAT(error(mesh),
                    testing::AllOf(testing::HasSubstr("index " + std::to_string(place) + " "),
                                   testing::HasSubstr(std::to_string(wrong)), testing::HasSubstr("24")));
        if (wrong > 0xffff) continue;
        std::vector<std::uint16_t> half = narrow;
        half[place] = static_cast<std::uint16_t>(wrong);
        mesh.indices = half;
        EXPECT_THAT(error(mesh), testing::HasSubstr(std::to_string(wrong)));
      }
  }
}

// Vertex counts whose number of floats or bytes overflows 64 bits.
TEST(OddMeshArrays, SizesThatWrapAreRefused) {
  const std::vector<float> floats(64, 0.5f);
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  constexpr std::size_t kQuarter = std::size_t{1} << 62;
  constexpr std::size_t kMax = std::numeric_limits<std::size_t>::max();
  for (const std::size_t wrong : {kQuarter, kQuarter + 3, kMax, kMax / 4, kMax / 3 + 1, std::size_t{1} << 32})
    for (const int components : {3, 4}) {
      Mesh mesh{.positions = FloatArray(floats.data(), wrong, 0), .position_components = components};
      EXPECT_TRUE(error_of([&] { frame.draw(mesh); })) << wrong << " positions of " << components;
      mesh.positions = FloatArray(floats.data(), 6, 0);
      for (int which = 0; which < 4; ++which) {
        Mesh other = mesh;
        const FloatArray array(floats.data(), wrong, 0);
        const FloatArray more(floats.data(), wrong + 6, 0);
        for (const FloatArray& odd : {array, more}) {
          if (which == 0) other.normals = odd;
          if (which == 1) other.colors.floats = odd;
          if (which == 2) other.texcoords = odd;
          if (which == 3) other.color_indices = odd;
          EXPECT_TRUE(error_of([&] { frame.draw(other); })) << wrong << " in array " << which;
        }
      }
      mesh.colors = ColorArray(reinterpret_cast<const std::uint8_t*>(floats.data()), wrong, 0);
      EXPECT_TRUE(error_of([&] { frame.draw(mesh); })) << wrong << " colours of bytes";
      mesh.colors = {};
      mesh.indices = std::span<const std::uint32_t>(reinterpret_cast<const std::uint32_t*>(floats.data()), 6);
      mesh.indices.count = wrong;
      EXPECT_TRUE(error_of([&] { frame.draw(mesh); })) << wrong << " indices";
      for (const int bits : {0, -32, 8, 31, 64}) {
        mesh.indices.count = 6;
        mesh.indices.bits = bits;
        EXPECT_THAT(error_of([&] { frame.draw(mesh); }).value_or(""),
                    testing::HasSubstr(std::to_string(bits) + " bits"));
      }
    }
  EXPECT_EQ(frame.draw_count(), 0u);
}

}  // namespace
}  // namespace tessera::test::odd_data_test
