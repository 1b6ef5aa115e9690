// Cost of the frame buffer itself: clears, stores and loads of planes, scan-out, accumulation.
#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"

namespace tessera::bench {
namespace {

/// Returns an empty string if all pixels have this colour.
std::string other_color(const Picture& picture, int r, int g, int b) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] != r || picture.rgba[i + 1] != g || picture.rgba[i + 2] != b)
      return "a pixel is not " + std::to_string(r) + " " + std::to_string(g) + " " + std::to_string(b);
  return {};
}

/// Clears colour, depth and stencil. A plane of one value is not stored, only flagged: just the image is
/// written.
Drawing cleared(int width, int height) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height};
  drawing.roofline = Roofline::memory_stores;
  drawing.record = [](const Drawing&, Frame& frame) {
    frame.clear({.color = Color{1, 0, 0.2f, 1}, .depth = 1.0, .stencil = 0x5au});
  };
  drawing.fault = [](const Picture& picture) { return other_color(picture, 255, 0, 51); };
  return drawing;
}

void draw_colors(const Drawing& d, Frame& frame) {
  DrawState state;
  state.lighting = false;
  state.shading = Shading::flat;
  state.depth.enabled = false;
  frame.draw(d.meshes.front().view(), state);
}

/// Two flat-shaded triangles over the whole window.
Drawing two_flat_triangles(const FrameBufferFormat& format) {
  Drawing drawing;
  drawing.format = format;
  drawing.format.depth = DepthFormat::none;
  drawing.format.stencil_bits = 0;
  drawing.meshes.push_back(window_grid(1, 1));
  return drawing;
}

Drawing stored_planes(int width, int height, int bits) {
  Drawing drawing = two_flat_triangles({.width = width, .height = height, .color_bits = bits});
  drawing.stores_planes = true;
  drawing.roofline = Roofline::memory_stores;
  drawing.record = [](const Drawing& d, Frame& frame) {
    frame.clear({.color = Color{0, 0, 0, 1}});  // avoids loading the planes
    draw_colors(d, frame);
  };
  return drawing;
}

Drawing scanned_out(int width, int height) {
  Drawing drawing = two_flat_triangles({.width = width, .height = height});
  drawing.initial_frame = draw_colors;
  drawing.roofline = Roofline::memory_copies;
  drawing.record = [](const Drawing&, Frame&) {};
  return drawing;
}

/// Mean of two exposures, both of the stored colour planes.
Drawing accumulated(int width, int height) {
  Drawing drawing = two_flat_triangles({.width = width, .height = height, .accumulation_bits = 16});
  drawing.initial_frame = draw_colors;
  drawing.stores_planes = true;
  drawing.record = [](const Drawing&, Frame& frame) {
    frame.accumulate({.op = AccumOp::load, .value = 0.5});
    frame.accumulate({.op = AccumOp::accum, .value = 0.5});
    frame.accumulate({.op = AccumOp::return_color});
  };
  return drawing;
}

WorkloadEntry frame_buffer_entry(const std::string& name, const std::string& description,
                                 std::function<Drawing(int width, int height)> make) {
  return drawn_outside_mean(
      name, description,
      [make = std::move(make)](int width, int height, std::uint32_t) { return make(width, height); });
}

}  // namespace

std::vector<WorkloadEntry> frame_buffer_workloads() {
  std::vector<WorkloadEntry> list{
      frame_buffer_entry("clear", "colour, depth and stencil cleared, image written", cleared)};
  for (const int bits : {1, 4, 8, 16, 24})
    list.push_back(frame_buffer_entry("planes-" + std::to_string(bits),
                                      "two triangles over the whole window, stored in " +
                                          std::to_string(bits) + (bits > 1 ? " planes" : " plane"),
                                      [bits](int w, int h) { return stored_planes(w, h, bits); }));
  list.push_back(frame_buffer_entry("scan-out", "24 stored planes written to an image", scanned_out));
  list.push_back(frame_buffer_entry("accumulation", "24 planes loaded, accumulated in 64 planes and returned",
                                    accumulated));
  return list;
}

}  // namespace tessera::bench
