#include "shading/pixel_path.h"

#include <gtest/gtest.h>

#include "shading/tile_renderer.h"

namespace tessera::test::pixel_path_test {
using namespace detail;
namespace {

using Kind = PixelPath::Kind;

// A frame of 24-bit RGB with 24-bit depth on AVX2, and a draw of Gouraud triangles with the test `less`.
struct PixelPathCase {
  PixelPathFrame frame{.layout = rgb_layout(24),
                       .depth_format = DepthFormat::unorm24,
                       .samples = 1,
                       .shade_immediately = true,
                       .isa = InstructionSet::avx2};
  TileDraw draw;
  FragmentOps ops;
  TextureLevels levels;
  DrawTexture texture{.levels = &levels};

  PixelPathCase() {
    draw.source = ColorSource::interpolated;
    draw.uses_depth = true;
  }
  PixelPath choose() const { return choose_pixel_path(frame, draw); }
};

TEST(PixelPath, PlainTrianglesTakeTheSpecializedDepthTest) {
  const PixelPathCase c;
  EXPECT_EQ(c.choose(), (PixelPath{.kind = Kind::triangles,
                                   .color_write = ColorWrite::interpolated,
                                   .depth_test = DepthTestPath::less_write,
                                   .depth_format = DepthFormat::unorm24}));
}

TEST(PixelPath, OtherDepthTestsAreGeneric) {
  PixelPathCase c;
  c.draw.depth_test = Compare::lequal;
  EXPECT_EQ(c.choose().depth_test, DepthTestPath::generic);
  c.draw.depth_test = Compare::less;
  c.draw.depth_write = false;
  EXPECT_EQ(c.choose().depth_test, DepthTestPath::generic);
  c.draw.depth_write = true;
  c.frame.depth_format = DepthFormat::unorm32;
  EXPECT_EQ(c.choose().depth_test, DepthTestPath::generic);
}

TEST(PixelPath, HasNoDepthWithoutDepthBufferOrTest) {
  PixelPathCase c;
  c.draw.uses_depth = false;
  EXPECT_FALSE(c.choose().uses_depth());
  c.draw.uses_depth = true;
  c.frame.depth_format = DepthFormat::none;
  EXPECT_FALSE(c.choose().uses_depth());
}

TEST(PixelPath, DeferredDrawsWriteTheVisibilityBuffer) {
  PixelPathCase c;
  c.draw.deferred = true;
  EXPECT_EQ(c.choose().color_write, ColorWrite::deferred);
  c.frame.samples = 4;
  EXPECT_EQ(c.choose().kind, Kind::triangles_msaa);
  EXPECT_EQ(c.choose().color_write, ColorWrite::deferred);
}

TEST(PixelPath, TrianglesTakeAStencilTestOrAPlainBlend) {
  PixelPathCase c;
  c.draw.ops = &c.ops;
  c.ops.stencil = c.draw.plain_colors = true;
  EXPECT_EQ(c.choose().kind, Kind::triangles);
  EXPECT_EQ(c.choose().color_write, ColorWrite::interpolated);
  EXPECT_EQ(c.choose().depth_test, DepthTestPath::generic);
  c.draw.plain_colors = false;
  c.ops.blend = true;
  EXPECT_EQ(c.choose().color_write, ColorWrite::blended);
}

TEST(PixelPath, OtherOperationsAreFragments) {
  const auto kind_with = [](auto change) {
    PixelPathCase c;
    c.draw.ops = &c.ops;
    c.ops.blend = true;
    change(c);
    EXPECT_EQ(c.choose().color_write, ColorWrite::evaluated);
    return c.choose().kind;
  };
  const ColorDither dither(Dither::bayer2, std::nullopt, rgb_layout(24), {}, 1);
  EXPECT_EQ(kind_with([&](PixelPathCase& c) { c.ops.dither = &dither; }), Kind::fragments);
  EXPECT_EQ(kind_with([](PixelPathCase& c) { c.ops.alpha_test = true; }), Kind::fragments);
  EXPECT_EQ(kind_with([](PixelPathCase& c) { c.ops.logic = LogicOp::bit_xor; }), Kind::fragments);
  EXPECT_EQ(kind_with([](PixelPathCase& c) { c.ops.equation = BlendEquation::max; }), Kind::fragments);
  EXPECT_EQ(kind_with([](PixelPathCase& c) { c.draw.offset_units = 1; }), Kind::fragments);
  EXPECT_EQ(kind_with([](PixelPathCase& c) { c.frame.layout = rgb_layout(16); }), Kind::fragments);
  EXPECT_EQ(kind_with([](PixelPathCase& c) { c.frame.samples = 8; }), Kind::fragments_msaa);
}

TEST(PixelPath, TexturedTrianglesAreShadedImmediatelyWithSeveralLanes) {
  PixelPathCase c;
  c.draw.texture = &c.texture;
  c.draw.deferred = true;
  EXPECT_EQ(c.choose().kind, Kind::textured_triangles);
  c.frame.isa = InstructionSet::scalar;
  EXPECT_EQ(c.choose().kind, Kind::triangles);
  EXPECT_EQ(c.choose().color_write, ColorWrite::deferred);
  c.frame.isa = InstructionSet::avx2;
  c.frame.shade_immediately = false;
  EXPECT_EQ(c.choose().kind, Kind::triangles);
}

TEST(PixelPath, PlainPointsAndLinesAreStoredAtOnce) {
  PixelPathCase c;
  c.draw.topology = Topology::lines;
  EXPECT_EQ(c.choose().kind, Kind::lines);
  EXPECT_EQ(c.choose().color_write, ColorWrite::interpolated);
  c.draw.ops = &c.ops;
  EXPECT_EQ(c.choose().kind, Kind::line_fragments);
  c.draw.ops = nullptr;
  c.draw.topology = Topology::points;
  c.draw.source = ColorSource::per_vertex_packed;
  EXPECT_EQ(c.choose().kind, Kind::points);
  EXPECT_EQ(c.choose().color_write, ColorWrite::constant);
  c.frame.samples = 4;
  EXPECT_EQ(c.choose().kind, Kind::point_fragments);
}

TEST(PixelPath, CapturedIdsArePackedColors) {
  PixelPathCase c;
  c.draw.ops = &c.ops;
  c.draw.id_output = TileDraw::IdOutput::draw;
  EXPECT_EQ(c.choose().kind, Kind::fragments);
  EXPECT_EQ(c.choose().color_write, ColorWrite::constant);
}

TEST(PixelPath, IsDescribedInOneLine) {
  EXPECT_EQ(describe(PixelPathCase().choose()),
            "triangles, colour interpolated, depth unorm24, less and write");
  PixelPathCase c;
  c.draw.source = ColorSource::none;
  c.frame.depth_format = DepthFormat::none;
  EXPECT_EQ(describe(c.choose()), "triangles, colour none, depth none");
}

}  // namespace
}  // namespace tessera::test::pixel_path_test
