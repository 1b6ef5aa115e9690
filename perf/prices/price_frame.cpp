#include "perf/prices/price_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>

namespace tessera::bench {
namespace {

constexpr double kFieldOfView = 90;  // degrees
constexpr double kNear = 0.5, kFar = 50;
constexpr int kTextureSize = 512;

struct Squares {
  int columns, rows;
};
Squares squares_of(const PriceFrame& frame) {
  const double side = std::sqrt(2 * frame.triangle_pixels);  // two triangles per square
  const auto count = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels / side))); };
  if (frame.placement == Placement::across_near) return {count(frame.format.width), 1};
  return {count(frame.format.width), count(frame.format.height)};
}

/// Distance of a point of the grid from the eye: a wave, so that depth, normals and perspective vary.
double distance_at(double u, double v) { return 3 + 0.3 * std::sin(4 * u) * std::cos(3 * v); }

/// @param u, v  position in the window, -1 to 1
void add_vertex(MeshData& mesh, const PriceFrame& frame, double u, double v) {
  const double aspect = static_cast<double>(frame.format.width) / frame.format.height;
  // With a field of view of 90 degrees, the window is 2 * distance high.
  double distance = distance_at(u, v);
  if (frame.placement == Placement::across_near) distance = v < 0 ? 0.25 : 3;
  const double x = u * distance * aspect + (frame.placement == Placement::outside ? 40 : 0);
  for (const double c : {x, v * distance, -distance}) mesh.positions.push_back(static_cast<float>(c));
  const double tilt[3] = {0.4 * std::sin(5 * u), 0.4 * std::cos(4 * v), 1};
  const double length = std::hypot(tilt[0], tilt[1], tilt[2]);
  for (const double c : tilt) mesh.normals.push_back(static_cast<float>(c / length));
  for (const double c : {(1 + u) / 2, (1 + v) / 2, (1 - u) / 2, 0.6 + 0.3 * u * v})
    mesh.colors.push_back(static_cast<float>(c));
  // About 1.4 texels per pixel at 1280 x 960, so that mipmap filters use two levels.
  mesh.texcoords.push_back(static_cast<float>(1.75 * (1 + u)));
  mesh.texcoords.push_back(static_cast<float>(1.3 * (1 + v)));
}

void add_square(std::vector<std::uint32_t>& indices, std::uint32_t corner, std::uint32_t row) {
  indices.insert(indices.end(),
                 {corner, corner + 1, corner + row + 1, corner, corner + row + 1, corner + row});
}

std::vector<std::uint32_t> grid_indices(const Squares& squares) {
  std::vector<std::uint32_t> indices;
  const auto row = static_cast<std::uint32_t>(squares.columns + 1);
  for (int y = 0; y < squares.rows; ++y)
    for (int x = 0; x < squares.columns; ++x)
      add_square(indices, static_cast<std::uint32_t>(y) * row + static_cast<std::uint32_t>(x), row);
  return indices;
}

MeshData grid_of(const PriceFrame& frame) {
  MeshData mesh;
  const Squares squares = squares_of(frame);
  for (int y = 0; y <= squares.rows; ++y)
    for (int x = 0; x <= squares.columns; ++x)
      add_vertex(mesh, frame, 2.0 * x / squares.columns - 1, 2.0 * y / squares.rows - 1);
  mesh.indices = grid_indices(squares);
  return mesh;
}

/// A vertical line of 16 pixels down from each vertex of the grid.
MeshData lines_of(const PriceFrame& frame) {
  MeshData mesh;
  const Squares squares = squares_of(frame);
  for (int y = 1; y <= squares.rows; ++y)
    for (int x = 0; x <= squares.columns; ++x)
      for (const double below : {0.0, 32.0 / frame.format.height})
        add_vertex(mesh, frame, 2.0 * x / squares.columns - 1, 2.0 * y / squares.rows - 1 - below);
  mesh.primitive = Primitive::lines;
  mesh.indices.resize(mesh.vertex_count());
  std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
  return mesh;
}

/// Positions of the corners in the order of the indices, which are dropped with all other attributes.
MeshData without_shared_vertices(const MeshData& mesh) {
  MeshData separate;
  for (const std::uint32_t index : mesh.indices)
    for (std::size_t c = 0; c < 3; ++c)
      separate.positions.push_back(mesh.positions[3 * std::size_t{index} + c]);
  return separate;
}
std::vector<MeshData> separate_triangles(const MeshData& mesh) {
  constexpr std::ptrdiff_t kTriangleFloats = 9;
  std::vector<MeshData> triangles;
  for (auto at = mesh.positions.begin(); at != mesh.positions.end(); at += kTriangleFloats) {
    triangles.emplace_back();
    triangles.back().positions.assign(at, at + kTriangleFloats);
  }
  return triangles;
}

MeshData mesh_of(const PriceFrame& frame) {
  MeshData mesh = frame.subject == Subject::lines ? lines_of(frame) : grid_of(frame);
  if (frame.subject == Subject::triangles || frame.subject == Subject::small_draws)
    return without_shared_vertices(mesh);
  if (frame.subject == Subject::corners) {
    mesh.indices = {0, 1, 2};
    const auto last = static_cast<std::uint32_t>(mesh.vertex_count() - 1);
    mesh.indices.insert(mesh.indices.end(), {last - 2, last - 1, last});
  }
  if (frame.subject == Subject::points || frame.subject == Subject::one_point) {
    mesh.primitive = Primitive::points;
    mesh.indices.assign(mesh.vertex_count(), 0);
    if (frame.subject == Subject::points)
      for (std::uint32_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = i;
  }
  if (!frame.has_colors) mesh.colors.clear();
  if (!frame.has_normals) mesh.normals.clear();
  if (!frame.texture) mesh.texcoords.clear();
  const std::vector<std::uint32_t> once = mesh.indices;
  for (int k = 1; k < frame.copies; ++k) mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
  return mesh;
}

std::vector<std::uint8_t> texels(int size) {
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const int c : {x ^ y, x + y, x * y / 64, 160}) bytes.push_back(static_cast<std::uint8_t>(c));
  return bytes;
}

void draw_subject(const PriceFrame& frame, const DrawState& state, const Drawing& drawing, Frame& target,
                  const std::vector<std::uint8_t>& pixels) {
  const Mesh mesh = drawing.meshes.front().view();
  switch (frame.subject) {
    case Subject::nothing: return;
    case Subject::image:
      for (int k = 0; k < frame.copies; ++k)
        target.draw_image({.pixels = pixels.data(),
                           .width = kTextureSize,
                           .height = kTextureSize,
                           .zoom_x = static_cast<double>(frame.format.width) / kTextureSize,
                           .zoom_y = static_cast<double>(frame.format.height) / kTextureSize},
                          fragment_state(state));
      return;
    case Subject::small_draws:
      for (const MeshData& triangle : drawing.meshes) target.draw(triangle.view(), state);
      return;
    default: target.draw(mesh, state);
  }
}

void record_frame(const PriceFrame& frame, const Drawing& drawing, Frame& target,
                  const std::vector<std::uint8_t>& pixels) {
  if (!frame.loads) {
    Clear clear{.color = Color{0.1f, 0.2f, 0.3f, 1}};
    if (frame.format.color_mode == ColorMode::index) clear = {.index = 3};
    if (frame.format.depth != DepthFormat::none) clear.depth = 1.0;
    if (frame.format.stencil_bits > 0) clear.stencil = 0;
    target.clear(clear);
  }
  const double aspect = static_cast<double>(frame.format.width) / frame.format.height;
  target.set_camera({.projection = perspective(kFieldOfView, aspect, kNear, kFar)});
  target.set_lights(frame.lights);
  target.set_light_model(frame.light_model);
  DrawState state = frame.state;
  if (!drawing.textures.empty()) state.texture = &drawing.textures.front();
  draw_subject(frame, state, drawing, target, pixels);
  for (int k = 0; k < frame.accumulations; ++k)
    target.accumulate({.op = k == 0 ? AccumOp::load : AccumOp::accum, .value = 0.125});
  for (int k = 0; k < frame.returns; ++k) target.accumulate({.op = AccumOp::return_color});
  if (frame.kept) target.keep({*frame.kept});
}

}  // namespace

PriceFrame::PriceFrame() {
  state.lighting = false;
  state.shading = Shading::flat;
  state.depth.test = Compare::lequal;  // copies of a triangle pass
  state.material.diffuse = {0.8f, 0.5f, 0.3f, 0.6f};
}

Drawing price_drawing(const PriceFrame& frame) {
  Drawing drawing;
  drawing.format = frame.format;
  drawing.meshes.push_back(mesh_of(frame));
  if (frame.subject == Subject::small_draws) drawing.meshes = separate_triangles(drawing.meshes.front());
  drawing.runs_in_full = true;
  auto pixels = std::make_shared<std::vector<std::uint8_t>>(texels(kTextureSize));
  if (frame.texture)
    drawing.textures.emplace_back(
        TextureImage{.pixels = pixels->data(), .width = kTextureSize, .height = kTextureSize},
        *frame.texture);
  drawing.record = [frame, pixels](const Drawing& d, Frame& target) {
    record_frame(frame, d, target, *pixels);
  };
  if (frame.loads)
    drawing.initial_frame = [pixels](const Drawing& d, Frame& target) {
      PriceFrame stored;
      stored.format = d.format;
      record_frame(stored, d, target, *pixels);
    };
  return drawing;
}

UnitCounts units_of(const PriceFrame& frame) {
  const Drawing drawing = price_drawing(frame);
  FrameBuffer buffer(drawing.format);
  Frame target(buffer);
  Renderer renderer({.elide = false, .debug = {.count_fragments = true}});
  if (drawing.initial_frame) {
    drawing.initial_frame(drawing, target);
    renderer.finish(target);
  }
  drawing.record(drawing, target);
  const auto draws = static_cast<double>(target.draw_count());
  const FrameStats stats = renderer.finish(target);
  const double pixels = static_cast<double>(frame.format.width) * frame.format.height;
  const double operations = std::max(1, frame.accumulations + frame.returns);
  return {1,
          draws,
          pixels * operations,
          static_cast<double>(stats.vertices),
          static_cast<double>(stats.triangles_in),
          static_cast<double>(stats.fragments),
          static_cast<double>(stats.shaded_pixels)};
}

}  // namespace tessera::bench
