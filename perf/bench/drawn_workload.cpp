#include "perf/bench/drawn_workload.h"

#include <algorithm>
#include <cstddef>

namespace tessera::bench {
namespace {

std::size_t pixels_of(const FrameBufferFormat& format) {
  return static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height);
}

RendererOptions options_for(const Drawing& drawing, RendererOptions options) {
  if (drawing.immediate_shading) options.debug.defer_shading = false;
  if (drawing.runs_in_full) options.elide = false;
  return options;
}

/// Renderer, frame buffer and image of one drawing.
class DrawingRenderer {
 public:
  DrawingRenderer(const Drawing& drawing, const RendererOptions& options)
      : drawing_(drawing),
        renderer_(options_for(drawing, options)),
        buffer_(drawing.format),
        frame_(buffer_, renderer_),
        picture_(drawing.format.width, drawing.format.height) {
    if (!drawing.initial_frame) return;
    drawing.initial_frame(drawing, frame_);
    renderer_.finish(frame_);
  }

  FrameStats draw() {
    drawing_.record(drawing_, frame_);
    return finish();
  }
  FrameStats draw_for_validation() {
    drawing_.record(drawing_, frame_);
    if (drawing_.reveal) drawing_.reveal(drawing_, frame_);
    return finish();
  }
  const Picture& picture() {
    if (drawing_.stores_planes) buffer_.read_color(picture_.target());
    return picture_;
  }
  /// Bytes of planes and image that a frame loads or stores.
  std::uint64_t traffic_bytes() const {
    const bool uses_planes = drawing_.stores_planes || drawing_.initial_frame;
    return (uses_planes ? plane_bytes() : 0) + (drawing_.stores_planes ? 0 : picture_.rgba.size());
  }
  std::uint64_t frame_buffer_bytes() const { return plane_bytes() + picture_.rgba.size(); }

 private:
  FrameStats finish() {
    return drawing_.stores_planes ? renderer_.finish(frame_) : renderer_.finish(frame_, picture_.target());
  }
  std::uint64_t plane_bytes() const {
    std::uint64_t bytes = 0;
    for (const Buffer buffer : {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation})
      bytes += buffer_.allocated_bytes(buffer);
    return bytes;
  }

  const Drawing& drawing_;
  Renderer renderer_;
  FrameBuffer buffer_;
  Frame frame_;
  Picture picture_;
};

class DrawnWorkload : public Workload {
 public:
  DrawnWorkload(Drawing drawing, const RendererOptions& options)
      : drawing_(std::move(drawing)), options_(options) {}

  FrameStats draw() override { return drawing_renderer().draw(); }

  std::string fault() override {
    const FrameStats stats = drawing_renderer().draw_for_validation();
    if (drawing_.fragments != 0 && stats.shaded_pixels != drawing_.fragments)
      return "shaded " + std::to_string(stats.shaded_pixels) + " pixels, expected " +
             std::to_string(drawing_.fragments);
    const Picture& picture = drawing_renderer_->picture();
    if (drawing_.fault)
      if (std::string fault = drawing_.fault(picture); !fault.empty()) return fault;
    // Compare with the scalar kernels, and scalar kernels with those of the best instruction set.
    const bool is_scalar = options_.instruction_set == InstructionSet::scalar;
    RendererOptions reference_options = options_;
    reference_options.instruction_set = is_scalar ? InstructionSet::automatic : InstructionSet::scalar;
    DrawingRenderer reference(drawing_, reference_options);
    reference.draw_for_validation();
    const Picture& expected = reference.picture();
    const auto found = std::mismatch(picture.rgba.begin(), picture.rgba.end(), expected.rgba.begin()).first;
    if (found == picture.rgba.end()) return {};
    const auto pixel = static_cast<std::size_t>(found - picture.rgba.begin()) / 4;
    const auto width = static_cast<std::size_t>(picture.width);
    return "pixel " + std::to_string(pixel % width) + " of row " + std::to_string(pixel / width) +
           " differs from that of another instruction set";
  }

  const Picture& picture() override { return drawing_renderer_->picture(); }

  FrameWork work(const FrameStats& stats) const override {
    FrameWork work;
    work.pixels = pixels_of(drawing_.format);
    work.triangles = stats.triangles_in;
    work.vertices = stats.vertices;
    work.fragments = drawing_.tested_fragments != 0 ? drawing_.tested_fragments : stats.shaded_pixels;
    work.bytes = drawing_renderer_->traffic_bytes();
    for (const MeshData& mesh : drawing_.meshes)  // read once per frame
      work.bytes += 4 * (mesh.positions.size() + mesh.normals.size() + mesh.colors.size() +
                         mesh.texcoords.size() + mesh.indices.size());
    work.roofline = drawing_.roofline;
    work.roofline_bytes =
        drawing_.roofline_bytes != 0 ? drawing_.roofline_bytes : drawing_renderer_->traffic_bytes();
    const auto in_tile = [&](int pixels) {
      return static_cast<std::uint64_t>(std::min(pixels, stats.tile_size));
    };
    work.tile_bytes = drawing_.pixel_bytes * in_tile(drawing_.format.width) * in_tile(drawing_.format.height);
    work.frame_buffer_bytes = drawing_renderer_->frame_buffer_bytes();
    return work;
  }

 private:
  DrawingRenderer& drawing_renderer() {
    // Made by the first frame: set-up is part of the cold time.
    if (!drawing_renderer_) drawing_renderer_.emplace(drawing_, options_);
    return *drawing_renderer_;
  }

  Drawing drawing_;
  RendererOptions options_;
  std::optional<DrawingRenderer> drawing_renderer_;
};

}  // namespace

WorkloadEntry drawn(const std::string& name, const std::string& description, MakeDrawing make) {
  WorkloadEntry entry{.name = name, .description = description};
  entry.make = [make](const WorkloadSetup& setup) {
    return std::make_unique<DrawnWorkload>(make(setup.width, setup.height, setup.seed), setup.options);
  };
  entry.gl_workload = [make = std::move(make)](const WorkloadSetup& setup) {
    const Drawing drawing = make(setup.width, setup.height, setup.seed);
    return drawing.gl_workload ? std::optional(drawing.gl_workload(drawing)) : std::nullopt;
  };
  return entry;
}

WorkloadEntry drawn_outside_mean(const std::string& name, const std::string& description, MakeDrawing make) {
  WorkloadEntry entry = drawn(name, description, std::move(make));
  entry.is_in_mean = false;
  return entry;
}

}  // namespace tessera::bench
