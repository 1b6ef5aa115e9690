#include "render.h"

#include <bit>
#include <utility>

#include "clip.h"
#include "pixel_format.h"
#include "rasterize.h"
#include "vertex_stage.h"

namespace tessera::reference {
namespace {

template <class T>
bool passes(Compare test, T incoming, T stored) {
  switch (test) {
    case Compare::kNever: return false;
    case Compare::kLess: return incoming < stored;
    case Compare::kEqual: return incoming == stored;
    case Compare::kLequal: return incoming <= stored;
    case Compare::kGreater: return incoming > stored;
    case Compare::kNotequal: return incoming != stored;
    case Compare::kGequal: return incoming >= stored;
    case Compare::kAlways: return true;
  }
  return false;
}

bool is_finite(const Triangle& triangle) {
  for (const Corner& corner : triangle) {
    const Vec4 p = corner.position_clip;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.w)) return false;
  }
  return true;
}

class Renderer {
 public:
  explicit Renderer(const Scene& scene)
      : scene_(scene),
        format_(scene.framebuffer),
        buffer_{0, 0, format_.width_px, format_.height_px},
        colors_(format_),
        camera_(scene.camera),
        lights_(scene.lights) {
    const auto pixels = static_cast<std::size_t>(format_.width_px) * static_cast<std::size_t>(format_.height_px);
    picture_.width_px = format_.width_px;
    picture_.height_px = format_.height_px;
    picture_.words.assign(pixels, 0);
    picture_.depth.assign(pixels, 1);
    picture_.depth_levels.assign(pixels, depth_level(format_.depth, 1));
    picture_.draws.assign(pixels, -1);
    picture_.triangles.assign(pixels, -1);
  }

  Picture run() {
    for (command_ = 0; command_ < scene_.frame.size(); ++command_)
      std::visit([this](const auto& command) { execute(command); }, scene_.frame[command_]);
    for (const std::uint32_t word : picture_.words)
      for (const std::uint8_t component : colors_.shown(word)) picture_.rgb.push_back(component);
    return std::move(picture_);
  }

 private:
  void execute(const CameraChange& change) { camera_ = change.camera; }
  void execute(const LightsChange& change) { lights_ = change.lights; }

  void execute(const Clear& clear) {
    const Rect area = clear.scissor ? intersection(*clear.scissor, buffer_) : buffer_;
    for (int y = area.y; y < area.y + area.height; ++y)
      for (int x = area.x; x < area.x + area.width; ++x) {
        const std::size_t at = pixel(x, y);
        if (clear.color || clear.index) {
          picture_.words[at] = clear.index ? *clear.index : colors_.word(*clear.color);
          picture_.draws[at] = picture_.triangles[at] = -1;
        }
        if (clear.depth) {
          picture_.depth[at] = *clear.depth;
          picture_.depth_levels[at] = depth_level(format_.depth, *clear.depth);
        }
      }
  }

  void execute(const Draw& draw) {
    const Mesh& mesh = scene_.meshes.at(draw.mesh);
    const Rect viewport = draw.viewport.value_or(buffer_);
    if (viewport.width == 0 || viewport.height == 0) return;
    const Rect visible = intersection(intersection(viewport, buffer_), draw.scissor.value_or(buffer_));
    const Window window{viewport, visible, draw.depth_range, camera_.reversed};
    const ClipVolume volume = clip_volume(camera_, viewport);
    const std::vector<EyeLight> lights = lights_in_eye_space(lights_, camera_.view_from_world);
    const VertexStage vertices(mesh, draw, camera_);

    for (std::size_t t = 0; t < vertices.triangle_count(); ++t) {
      const Triangle triangle = vertices.triangle(t);
      if (!is_finite(triangle)) continue;
      const WindowPolygon polygon(
          clip_triangle({triangle[0].position_clip, triangle[1].position_clip, triangle[2].position_clip}, volume), window);
      const std::int64_t area = polygon.signed_area();
      if (area == 0) continue;
      const bool is_back = (area < 0) == (draw.front_face == FrontFace::kCcw);
      if (draw.cull == (is_back ? Cull::kBack : Cull::kFront)) continue;
      const TriangleShader shader(triangle, is_back, !mesh.colors.empty(), draw, scene_.light_model, lights);
      polygon.for_each_fragment([&](const Fragment& fragment) { store(draw, static_cast<std::int32_t>(t), fragment, shader); });
    }
  }

  // Scissor (done), depth, masks.
  void store(const Draw& draw, std::int32_t triangle, const Fragment& fragment, const TriangleShader& shader) {
    const std::size_t at = pixel(fragment.x, fragment.y);
    if (draw.depth) {
      const std::uint32_t level = depth_level(format_.depth, fragment.depth);
      if (!passes_depth(draw.depth->test, level, picture_.depth_levels[at])) return;
      if (draw.depth->write) {
        picture_.depth_levels[at] = level;
        picture_.depth[at] = fragment.depth;
      }
    }
    const std::uint32_t planes = colors_.writable_planes(draw.color_mask, draw.plane_mask);
    if (planes == 0) return;
    picture_.words[at] = (picture_.words[at] & ~planes) | (colors_.word(shader.color(fragment.share)) & planes);
    picture_.draws[at] = static_cast<std::int32_t>(command_);
    picture_.triangles[at] = triangle;
  }

  bool passes_depth(Compare test, std::uint32_t incoming, std::uint32_t stored) const {
    if (format_.depth == DepthFormat::kFloat32) return passes(test, std::bit_cast<float>(incoming), std::bit_cast<float>(stored));
    return passes(test, incoming, stored);
  }

  std::size_t pixel(int x, int y_up) const { return picture_.pixel(x, format_.height_px - 1 - y_up); }

  const Scene& scene_;
  const FrameBufferFormat& format_;
  const Rect buffer_;
  const ColorFormat colors_;
  Camera camera_;
  std::vector<Light> lights_;
  std::size_t command_ = 0;
  Picture picture_;
};

}  // namespace

Picture render(const Scene& scene) { return Renderer(scene).run(); }

}  // namespace tessera::reference
