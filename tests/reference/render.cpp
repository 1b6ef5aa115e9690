#include "render.h"

#include "draw_mesh.h"
#include "draw_raster.h"
#include "fragment_ops.h"
#include "lighting.h"
#include "sample_buffers.h"
#include "window.h"

namespace tessera::reference {
namespace {

class Renderer {
 public:
  Renderer(const Scene& scene, Point sample_shift)
      : scene_(scene),
        sample_shift_(sample_shift),
        format_(scene.framebuffer),
        buffers_(format_),
        camera_(scene.camera),
        lights_(scene.lights) {}

  Picture run() {
    for (command_ = 0; command_ < scene_.frame.size(); ++command_)
      std::visit([this](const auto& command) { execute(command); }, scene_.frame[command_]);
    return buffers_.picture();
  }

 private:
  void execute(const CameraChange& change) { camera_ = change.camera; }
  void execute(const LightsChange& change) { lights_ = change.lights; }

  template <class Take>
  void for_each_pixel(const std::optional<Rect>& scissor, const Take& take) {
    const Rect area = intersection(scissor.value_or(buffers_.rect()), buffers_.rect());
    for (int y = area.y; y < area.y + area.height; ++y)
      for (int x = area.x; x < area.x + area.width; ++x) take(x, y);
  }

  // Colours are dithered like every colour write; an index is stored unchanged.
  void execute(const Clear& clear) {
    constexpr std::uint32_t kAllPlanes = ~std::uint32_t{0};
    for_each_pixel(clear.scissor, [&](int x, int y) {
      if (clear.color || clear.index) {
        const double dither = dither_threshold(format_.dither, x, y);
        buffers_.write_word(x, y, clear.index ? *clear.index : buffers_.colors().word(*clear.color, dither),
                            kAllPlanes);
        if (clear.color) buffers_.write_unrounded(x, y, clamp01(*clear.color), {true, true, true, true});
        buffers_.record_writer(x, y, -1, -1);
      }
      for (int s = 0; s < format_.samples; ++s) {
        SampleBuffers::Sample& sample = buffers_.sample(x, y, s);
        if (clear.depth) {
          sample.depth = *clear.depth;
          sample.depth_level = depth_level(format_.depth, *clear.depth);
        }
        if (clear.stencil) sample.stencil = *clear.stencil;
      }
      if (clear.accumulation)
        buffers_.accumulation(x, y) = accum_levels(*clear.accumulation, format_.accumulation_bits);
    });
  }

  void execute(const Accum& accum) {
    const int bits = format_.accumulation_bits;
    const ColorFormat& colors = buffers_.colors();
    const std::uint32_t planes = colors.writable_planes(accum.color_mask, ~std::uint32_t{0});
    for_each_pixel(accum.scissor, [&](int x, int y) {
      AccumPixel& stored = buffers_.accumulation(x, y);
      if (accum.op == AccumOp::kReturn) {
        const Vec4 color = returned(accum.value, stored, bits);
        buffers_.write_word(x, y, colors.word(color, dither_threshold(format_.dither, x, y)), planes);
        buffers_.write_unrounded(x, y, color, accum.color_mask);
      } else stored = accumulated(accum.op, accum.value, stored, colors.color(buffers_.resolved(x, y)), bits);
    });
  }

  void execute(const Bitmap& bitmap) { draw_bitmap(bitmap, static_cast<std::int32_t>(command_), buffers_); }
  void execute(const ImageDrawing& drawing) {
    draw_image(drawing, static_cast<std::int32_t>(command_), buffers_);
  }

  void execute(const Draw& draw) {
    draw_mesh(draw, {scene_, camera_, lights_, static_cast<std::int32_t>(command_), sample_shift_}, buffers_);
  }

  const Scene& scene_;
  Point sample_shift_;
  const FrameBufferFormat& format_;
  SampleBuffers buffers_;
  Camera camera_;
  std::vector<Light> lights_;
  std::size_t command_ = 0;
};

}  // namespace

Picture render(const Scene& scene, Point sample_shift) { return Renderer(scene, sample_shift).run(); }

}  // namespace tessera::reference
