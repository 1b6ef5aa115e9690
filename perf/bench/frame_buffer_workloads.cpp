// What the frame buffer itself costs: clears, planes that are stored and loaded, scan-out, accumulation.
#include "perf/bench/bench_meshes.h"
#include "perf/bench/drawn_workload.h"
#include "perf/bench/mesh_workloads.h"

namespace tessera::bench {
namespace {

std::string not_all_of(const Picture& picture, int r, int g, int b) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] != r || picture.rgba[i + 1] != g || picture.rgba[i + 2] != b)
      return "a pixel is not " + std::to_string(r) + " " + std::to_string(g) + " " + std::to_string(b);
  return {};
}

/// Colour, depth and stencil. Planes of one value are but noted: what is moved is the image.
Drawing cleared(int width, int height) {
  Drawing drawing;
  drawing.format = {.width = width, .height = height};
  drawing.roofline = Roofline::memory_stores;
  drawing.record = [](const Drawing&, Frame& frame) {
    frame.clear({.color = Color{1, 0, 0.2f, 1}, .depth = 1.0, .stencil = 0x5au});
  };
  drawing.fault = [](const Picture& picture) { return not_all_of(picture, 255, 0, 51); };
  return drawing;
}

void draw_colors(const Drawing& d, Frame& frame) {
  DrawState state;
  state.lighting = false;
  state.shading = Shading::flat;
  state.depth.enabled = false;
  frame.draw(d.meshes.front().view(), state);
}

/// Two triangles over the whole window, each in one colour.
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
    frame.clear({.color = Color{0, 0, 0, 1}});  // else planes are loaded before
    draw_colors(d, frame);
  };
  return drawing;
}

Drawing scanned_out(int width, int height) {
  Drawing drawing = two_flat_triangles({.width = width, .height = height});
  drawing.before = draw_colors;
  drawing.roofline = Roofline::memory_copies;
  drawing.record = [](const Drawing&, Frame&) {};
  return drawing;
}

/// Two exposures, of what stands in the colour planes, and their mean.
Drawing accumulated(int width, int height) {
  Drawing drawing = two_flat_triangles({.width = width, .height = height, .accumulation_bits = 16});
  drawing.before = draw_colors;
  drawing.stores_planes = true;
  drawing.record = [](const Drawing&, Frame& frame) {
    frame.accumulate({.op = AccumOp::load, .value = 0.5});
    frame.accumulate({.op = AccumOp::accum, .value = 0.5});
    frame.accumulate({.op = AccumOp::return_color});
  };
  return drawing;
}

WorkloadEntry entry(const std::string& name, const std::string& what,
                    std::function<Drawing(int width, int height)> make) {
  return drawn_outside_mean(name, what, [make = std::move(make)](int width, int height, std::uint32_t) {
    return make(width, height);
  });
}

}  // namespace

std::vector<WorkloadEntry> frame_buffer_workloads() {
  std::vector<WorkloadEntry> list{entry("clear", "colour, depth and stencil cleared, and shown", cleared)};
  for (const int bits : {1, 4, 8, 16, 24})
    list.push_back(entry("planes-" + std::to_string(bits),
                         "two triangles over the whole window, kept in " + std::to_string(bits) +
                             (bits > 1 ? " planes" : " plane"),
                         [bits](int w, int h) { return stored_planes(w, h, bits); }));
  list.push_back(entry("scan-out", "24 planes into an image", scanned_out));
  list.push_back(
      entry("accumulation", "24 planes loaded, added and returned by 64 of accumulation", accumulated));
  return list;
}

}  // namespace tessera::bench
