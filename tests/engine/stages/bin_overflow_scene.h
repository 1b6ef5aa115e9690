// A scene whose bins overflow.
#pragma once

#include "tests/engine/frame/pixel_support.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {

/// Triangles, lines and points whose entries in a single tile exceed kMinBinMemory; many are clipped, some
/// draws blend, and a clear lies in between.
struct BinOverflowScene {
  FrameBufferFormat format;
  MeshData triangles;
  MeshData lines;
  MeshData points;
  explicit BinOverflowScene(FrameBufferFormat f, int count = 9000) : format(std::move(f)) {
    lines.primitive = Primitive::lines;
    points.primitive = Primitive::points;
    Random random(3);
    for (MeshData* mesh : {&triangles, &lines, &points}) {
      for (int i = 0; i < count; ++i) {
        for (int c = 0; c < 3; ++c) mesh->positions.push_back(random.between(-1.2f, 1.2f));
        for (int c = 0; c < 4; ++c) mesh->colors.push_back(random.between(0, 1));
      }
    }
  }
  void record(Frame& frame) const {
    frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
    DrawState state;
    state.lighting = false;
    frame.draw(triangles.view(), state);
    state.shading = Shading::flat;
    frame.draw(lines.view(), state);
    frame.clear({.depth = 0.9, .scissor = Rect{10, 10, 20, 20}});
    state.blend = BlendState{};
    frame.draw(points.view(), state);
    state.front_mode = PolygonMode::line;
    frame.draw(triangles.view(), state);
  }
};

}  // namespace tessera::test
