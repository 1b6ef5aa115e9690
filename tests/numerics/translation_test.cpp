// A viewport that moves by whole pixels keeps every bit of its scene, up to the far corner of the largest
// buffer, wherever tile borders fall; and nothing is drawn outside the viewport.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/counted_mesh.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::translation_test {
namespace {

// Size of the moving window. Buffers have the maximum size in one direction and kAcross pixels in the other.
constexpr int kWidth = 61;
constexpr int kHeight = 45;
constexpr int kAcross = 80;

// Triangles of all sizes, many of them clipped, lines and points, coloured and textured.
std::vector<CaseDraw> random_scene(MeshRandom& random) {
  std::vector<CaseDraw> draws;
  for (const Primitive primitive : {Primitive::triangles, Primitive::triangles, Primitive::lines,
                                    Primitive::points, Primitive::triangle_strip}) {
    CaseDraw& draw = draws.emplace_back();
    draw.primitive = primitive;
    draw.test_depth = true;
    draw.textured = draws.size() == 2;
    for (int vertex = 0; vertex < 60; ++vertex) {
      const auto any = [&](double reach) { return static_cast<float>(reach * (2 * random.unit() - 1)); };
      const float w = any(1) + 0.8f;
      const float size = random.between(0, 7) == 0 ? 40.0f : 1.2f;
      draw.positions.insert(draw.positions.end(), {any(size), any(size), any(1.2), w});
      for (int c = 0; c < 4; ++c) draw.colors.push_back(static_cast<float>(random.unit()));
      draw.texcoords.insert(draw.texcoords.end(), {any(3), any(3)});
    }
  }
  return draws;
}

std::vector<Rect> places(MeshRandom& random, const CaseFormat& buffer) {
  const int far_x = buffer.width - kWidth;
  const int far_y = buffer.height - kHeight;
  return {{far_x, far_y, kWidth, kHeight},
          {random.between(0, far_x), random.between(0, far_y), kWidth, kHeight}};
}

CaseFormat format_of(int width, int height, DepthFormat depth) {
  CaseFormat format{
      .width = width, .height = height, .depth = depth, .texture_width = 16, .texture_height = 16};
  MeshRandom random(0);
  for (int i = 0; i < 256; ++i) format.texture.push_back(static_cast<std::uint8_t>(random.random()));
  return format;
}

struct Changes {
  long double colors = 0;
  long double depths = 0;
  long drawn_pixels = 0;
};
std::array<long, 3> levels(const std::array<float, 3>& color) {
  return {std::lround(color[0] * 255), std::lround(color[1] * 255), std::lround(color[2] * 255)};
}

// Compares all pixels of the buffer: the window with the picture of a separate buffer, the rest with the
// clear values.
void compare(const CasePicture& alone, const CasePicture& moved, const CaseFormat& buffer, const Rect& place,
             std::uint32_t cleared_depth, Changes& changes) {
  for (int row = 0; row < buffer.height; ++row)
    for (int column = 0; column < buffer.width; ++column) {
      const int x = column - place.x, y = row - (buffer.height - place.y - kHeight);
      const bool inside = x >= 0 && y >= 0 && x < kWidth && y < kHeight;
      const auto there = static_cast<std::size_t>(row) * static_cast<std::size_t>(buffer.width) +
                         static_cast<std::size_t>(column);
      const auto here = inside ? static_cast<std::size_t>(y * kWidth + x) : 0;
      changes.drawn_pixels +=
          inside && levels(alone.colors[here]) != std::array<long, 3>{} && alone.depth[here] != cleared_depth;
      changes.colors +=
          levels(moved.colors[there]) != levels(inside ? alone.colors[here] : std::array<float, 3>{});
      changes.depths += moved.depth[there] != (inside ? alone.depth[here] : cleared_depth);
    }
}

Changes changes_of(const MakeRenderer& make, bool is_tessera, DepthFormat depth,
                   std::uint32_t cleared_depth) {
  Changes changes;
  const int scenes = is_tessera && long_tests() ? 40 : 3;
  std::vector<CasePicture> alone;  // One renderer at a time: only one of Mesa's contexts can be current.
  {
    const std::unique_ptr<CaseRenderer> renderer = make(format_of(kWidth, kHeight, depth));
    for (int n = 0; n < scenes; ++n) {
      MeshRandom random(n);
      alone.push_back(renderer->draw(random_scene(random)));
    }
  }
  for (const auto& [width, height] :
       {std::pair{kMaxFrameBufferSize, kAcross}, std::pair{kAcross, kMaxFrameBufferSize}}) {
    const CaseFormat buffer = format_of(width, height, depth);
    const std::unique_ptr<CaseRenderer> renderer = make(buffer);
    for (int n = 0; n < scenes; ++n) {
      MeshRandom random(n);
      std::vector<CaseDraw> scene = random_scene(random);
      for (const Rect& place : places(random, buffer)) {
        for (CaseDraw& draw : scene) draw.viewport = place;
        const Changes before = changes;
        compare(alone[static_cast<std::size_t>(n)], renderer->draw(scene), buffer, place, cleared_depth,
                changes);
        if (is_tessera && (changes.colors != before.colors || changes.depths != before.depths))
          ADD_FAILURE() << "scene " << n << " at " << place.x << ", " << place.y << " of " << width << " x "
                        << height << ": " << changes.colors - before.colors << " colours, "
                        << changes.depths - before.depths << " depths change";
      }
    }
  }
  return changes;
}

TEST(ViewportTranslation, ChangesNeitherColorsNorDepths) {
  struct Depth {
    DepthFormat format;
    std::string name;
    std::uint32_t cleared;
  };
  for (const Depth& depth :
       {Depth{DepthFormat::unorm16, "unorm16", 0xffffu}, Depth{DepthFormat::unorm24, "unorm24", 0xffffffu},
        Depth{DepthFormat::unorm32, "unorm32", 0xffffffffu},
        Depth{DepthFormat::float32, "float32", 0x3f800000u}}) {
    Changes ours;
    Changes mesas;
    bool has_mesa = false;
    expect_figure("moved by whole pixels: colours change, " + depth.name, 0, "pixels",
                  [&](const MakeRenderer& make, bool is_tessera) {
                    has_mesa |= !is_tessera;
                    Changes& changes = is_tessera ? ours : mesas;
                    changes = changes_of(make, is_tessera, depth.format, depth.cleared);
                    EXPECT_GT(changes.drawn_pixels, 10000);
                    return changes.colors;
                  });
    expect_within("moved by whole pixels: depths change, " + depth.name, ours.depths, 0, "pixels");
    if (has_mesa) report_mesa_figure("moved by whole pixels: depths change, " + depth.name, mesas.depths);
  }
}

// Lights, mipmaps, wide lines, large points, polygon offset and stencil, which only Tessera draws. Everything
// is inside the window.
class RichScene {
 public:
  RichScene() {
    MeshRandom random(7);
    for (int i = 0; i < 300; ++i) {
      for (int c = 0; c < 3; ++c) positions_.push_back(static_cast<float>(4 * random.unit() - 2));
      for (int c = 0; c < 3; ++c) normals_.push_back(static_cast<float>(2 * random.unit() - 1));
      for (int c = 0; c < 2; ++c) texcoords_.push_back(static_cast<float>(20 * random.unit()));
    }
    std::vector<std::uint8_t> texels(64 * 64);
    for (std::uint8_t& t : texels) t = static_cast<std::uint8_t>(random.random());
    texture_.emplace(TextureImage{.pixels = texels.data(), .width = 64, .height = 64, .channels = 1});
  }
  void record(Frame& frame, const Rect& place) const {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0, .stencil = 0});
    frame.set_camera({.view = look_at({0, 0, 2.5}, {0, 0, 0}, {0, 1, 0}),
                      .projection = perspective(60, 4.0 / 3, 0.5, 20)});
    frame.set_lights({Light{.position = {1, 2, 3, 1}, .spot_cutoff = 60}, Light{}});
    for (const Primitive primitive :
         {Primitive::triangles, Primitive::line_strip, Primitive::points, Primitive::polygon}) {
      DrawState state{.material = *named_material("gold"),
                      .shading = primitive == Primitive::points ? Shading::gouraud : Shading::phong,
                      .texture = &*texture_,
                      .point_size = 5,
                      .line_width = 3};
      state.viewport = place;
      state.polygon_offset = {1, 1};
      state.stencil = StencilState{.front = {.zfail = StencilOp::incr, .zpass = StencilOp::invert}};
      const std::size_t used = primitive == Primitive::triangles ? 300 : 40;
      frame.draw({.primitive = primitive,
                  .positions = FloatArray(positions_.data(), used, 12),
                  .normals = FloatArray(normals_.data(), used, 12),
                  .texcoords = FloatArray(texcoords_.data(), used, 8)},
                 state);
    }
  }

 private:
  std::vector<float> positions_;
  std::vector<float> normals_;
  std::vector<float> texcoords_;
  std::optional<Texture> texture_;
};

/// All stored values of the window.
std::vector<std::uint32_t> stored(const FrameBuffer& buffer, const Rect& place) {
  const FrameBufferFormat& format = buffer.format();
  const auto pixels = static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height);
  std::vector<std::uint32_t> colors(pixels);
  std::vector<std::uint32_t> depths(pixels);
  std::vector<std::uint32_t> all;
  std::vector<std::uint8_t> stencil(pixels);
  buffer.read_packed_colors(colors);
  buffer.read_stored_depths(depths);
  buffer.read_stencil(stencil);
  for (int y = format.height - place.y - kHeight; y < format.height - place.y; ++y)
    for (int x = place.x; x < place.x + kWidth; ++x) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(format.width) + static_cast<std::size_t>(x);
      all.insert(all.end(), {colors[i], depths[i], stencil[i]});
    }
  return all;
}

TEST(ViewportTranslation, ChangesNoLitTexturedStencilledOrSampledPixel) {
  const RichScene scene;
  Renderer renderer({.threads = 1});
  for (const int samples : {1, 4, 8}) {
    long double changes = 0;
    for (const DepthFormat depth :
         {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::unorm32, DepthFormat::float32}) {
      const auto drawn = [&](int width, int height, const Rect& place) {
        FrameBuffer buffer({.width = width, .height = height, .depth = depth, .samples = samples});
        Frame frame(buffer);
        scene.record(frame, place);
        renderer.finish(frame);
        return stored(buffer, place);
      };
      const std::vector<std::uint32_t> alone = drawn(kWidth, kHeight, {0, 0, kWidth, kHeight});
      EXPECT_GT(std::count_if(alone.begin(), alone.end(), [](std::uint32_t word) { return word != 0; }),
                kWidth * kHeight);
      for (const auto& [width, height] :
           {std::pair{kMaxFrameBufferSize, kAcross}, std::pair{kAcross, kMaxFrameBufferSize}}) {
        const std::vector<std::uint32_t> moved =
            drawn(width, height, {width - kWidth, height - kHeight, kWidth, kHeight});
        for (std::size_t i = 0; i < alone.size(); ++i) changes += alone[i] != moved[i];
      }
    }
    expect_within("moved by whole pixels, lit, textured and stencilled, samples " + std::to_string(samples) +
                      ": words change",
                  changes, 0, "");
  }
}

// 16,384 pixels on both sides. With a partial image target no plane is stored, and only the window's tiles
// are drawn.
TEST(ViewportTranslation, ReachesTheFarCornerOfTheLargestBuffer) {
  const RichScene scene;
  Renderer renderer({.threads = 1});
  constexpr int kFar = kMaxFrameBufferSize;
  const auto shown = [&](int width, int height, const Rect& place) {
    FrameBuffer buffer({.width = width, .height = height});
    Frame frame(buffer);
    scene.record(frame, place);
    // Allocates address space for the whole image; only the window's memory is touched.
    const auto image = std::make_unique_for_overwrite<std::uint32_t[]>(static_cast<std::size_t>(width) *
                                                                       static_cast<std::size_t>(height));
    renderer.finish(frame, {.pixels = image.get(),
                            .width = width,
                            .height = height,
                            .stride_bytes = std::ptrdiff_t{4} * width,
                            .region = place});
    EXPECT_EQ(buffer.allocated_bytes(Buffer::color) + buffer.allocated_bytes(Buffer::depth) +
                  buffer.allocated_bytes(Buffer::stencil),
              0u);
    std::vector<std::uint32_t> window;
    for (int y = height - place.y - kHeight; y < height - place.y; ++y) {
      const std::uint32_t* const row = image.get() +
                                       static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                       static_cast<std::size_t>(place.x);
      window.insert(window.end(), row, row + kWidth);
    }
    return window;
  };
  const std::vector<std::uint32_t> alone = shown(kWidth, kHeight, {0, 0, kWidth, kHeight});
  EXPECT_GT(
      std::count_if(alone.begin(), alone.end(), [](std::uint32_t word) { return (word & 0xffffff) != 0; }),
      kWidth * kHeight / 2);
  long double changes = 0;
  for (const Rect& place :
       {Rect{kFar - kWidth, kFar - kHeight, kWidth, kHeight}, Rect{kFar - kWidth, 0, kWidth, kHeight},
        Rect{0, kFar - kHeight, kWidth, kHeight}, Rect{8189, 8161, kWidth, kHeight}}) {
    const std::vector<std::uint32_t> moved = shown(kFar, kFar, place);
    for (std::size_t i = 0; i < alone.size(); ++i) changes += alone[i] != moved[i];
  }
  expect_within("moved to the corners of 16,384 x 16,384: colours change", changes, 0, "pixels");
}

}  // namespace
}  // namespace tessera::test::translation_test
