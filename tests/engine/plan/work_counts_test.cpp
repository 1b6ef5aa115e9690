// Renderer::work_counts against counts that are known from the scene.
#include <gtest/gtest.h>

#include "tests/engine/frame/api_support.h"

namespace tessera::work_counts_test {
namespace {

using namespace test;

constexpr int kWidth = 128, kHeight = 64;
constexpr double kPixels = double{kWidth} * kHeight;

/// A frame with one draw, and the options that it is finished with.
struct CountedFrame {
  FrameBufferFormat format{.width = kWidth, .height = kHeight};
  MeshData mesh = whole_window();
  DrawState state{};
  std::vector<Light> lights{Light{}};
  LightModel model{};
  bool elide = false;
  int threads = 1;

  WorkCounts counts() const {
    FrameBuffer buffer(format);
    Frame frame(buffer);
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    frame.set_lights(lights);
    frame.set_light_model(model);
    frame.draw(mesh.view(), state);
    Image image(buffer);
    Renderer renderer(
        {.threads = threads, .elide = elide, .debug = {.count_fragments = true, .measure_draws = true}});
    renderer.finish(frame, image.target());
    return renderer.work_counts();
  }
};

/// The window with normals that differ, so that pixels are lit.
CountedFrame lit_window(Shading shading) {
  CountedFrame frame;
  frame.mesh.normals = {0, 0, 1, 0.1f, 0, 1, 0, 0.1f, 1, 0, 0, 1};
  frame.state.shading = shading;
  frame.state.normalize = false;
  return frame;
}

TEST(WorkCountsOfFrames, AreZeroUnlessAskedFor) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  const MeshData mesh = whole_window();
  Renderer renderer({.threads = 1});
  frame.draw(mesh.view(), unlit({1, 1, 1, 1}));
  renderer.finish(frame);
  EXPECT_EQ(renderer.work_counts().units, WorkCounts{}.units);
}

TEST(WorkCountsOfFrames, HaveThePixelsOfTheWindow) {
  CountedFrame frame;
  frame.state = unlit({1, 0, 0, 1});
  const WorkCounts counts = frame.counts();
  EXPECT_EQ(counts[PriceItem::frame], 1);
  EXPECT_EQ(counts[PriceItem::draw], 1);
  EXPECT_EQ(counts[PriceItem::vertex], 4);
  EXPECT_EQ(counts[PriceItem::depth_unorm24_pixel], kPixels);
  EXPECT_EQ(counts[PriceItem::depth_triangle], 2);
  EXPECT_EQ(counts[PriceItem::shown_tile_pixel], kPixels);
  EXPECT_EQ(counts[PriceItem::shown_pixel], 0);
  EXPECT_NEAR(counts[PriceItem::triangle_1024] * 1024 + counts[PriceItem::triangle_4096] * 4096, kPixels,
              1e-6);
  EXPECT_EQ(counts[PriceItem::deferred_pixel], 0);
}

TEST(WorkCountsOfFrames, HaveTheLightsOfPixelsAndOfVertices) {
  CountedFrame frame = lit_window(Shading::phong);
  frame.lights.resize(3);
  frame.lights[1].position = {0, 0, 5, 1};
  frame.lights[1].attenuation_linear = 0.5f;
  frame.lights[2] = {.position = {0, 0, 5, 1}, .spot_exponent = 2, .spot_cutoff = 30};
  frame.state.material.specular = {1, 1, 1, 1};
  const WorkCounts pixels = frame.counts();
  EXPECT_EQ(pixels[PriceItem::shaded_pixel], kPixels);
  EXPECT_EQ(pixels[PriceItem::pixel_directional_light], kPixels);
  EXPECT_EQ(pixels[PriceItem::pixel_point_light], 2 * kPixels);
  EXPECT_EQ(pixels[PriceItem::pixel_attenuation], kPixels);
  EXPECT_EQ(pixels[PriceItem::pixel_spot], kPixels);
  EXPECT_EQ(pixels[PriceItem::pixel_highlight], 3 * kPixels);
  EXPECT_EQ(pixels[PriceItem::pixel_local_viewer], 0);
  EXPECT_EQ(pixels[PriceItem::vertex_lighting], 0);
  frame.state.shading = Shading::gouraud;
  frame.model.local_viewer = true;
  const WorkCounts vertices = frame.counts();
  EXPECT_EQ(vertices[PriceItem::vertex_lighting], 4);
  EXPECT_EQ(vertices[PriceItem::vertex_point_light], 8);
  EXPECT_EQ(vertices[PriceItem::vertex_spot], 4);
  EXPECT_EQ(vertices[PriceItem::vertex_local_viewer], 12);
  EXPECT_EQ(vertices[PriceItem::interpolated_pixel], kPixels);
  EXPECT_EQ(vertices[PriceItem::shaded_pixel], 0);
}

TEST(WorkCountsOfFrames, LackWhatIsLeftOut) {
  CountedFrame frame = lit_window(Shading::phong);
  frame.lights.resize(2);
  frame.lights[1].position = {0, 0, -1, 0};  // behind
  frame.state.blend = BlendState{};          // alpha is 1
  // Blended colours are evaluated in blocks, which reach beyond the triangles.
  EXPECT_GE(frame.counts()[PriceItem::pixel_directional_light], 2 * kPixels);
  EXPECT_LE(frame.counts()[PriceItem::pixel_directional_light], 2.5 * kPixels);
  EXPECT_EQ(frame.counts()[PriceItem::blending], kPixels);
  frame.elide = true;
  EXPECT_EQ(frame.counts()[PriceItem::pixel_directional_light], kPixels);
  EXPECT_EQ(frame.counts()[PriceItem::blending], 0);
}

TEST(WorkCountsOfFrames, DoNotDependOnThreads) {
  CountedFrame frame = lit_window(Shading::phong);
  const WorkCounts one = frame.counts();
  frame.threads = 4;
  EXPECT_EQ(frame.counts().units, one.units);
}

TEST(WorkCountsOfFrames, HaveDroppedTrianglesAndOutlines) {
  CountedFrame frame;
  frame.state = unlit({1, 0, 0, 1});
  frame.state.cull = Cull::front;
  EXPECT_EQ(frame.counts()[PriceItem::triangle_culled], 2);
  EXPECT_EQ(frame.counts()[PriceItem::depth_triangle], 0);
  frame.state.cull = Cull::none;
  frame.state.front_mode = PolygonMode::line;
  const WorkCounts outlines = frame.counts();
  EXPECT_EQ(outlines[PriceItem::outlined_triangle], 2);
  EXPECT_GT(outlines[PriceItem::outlined_pixel], 2 * (kWidth + kHeight) - 8);
  EXPECT_LT(outlines[PriceItem::outlined_pixel], 4 * (kWidth + kHeight));
}

}  // namespace
}  // namespace tessera::work_counts_test
