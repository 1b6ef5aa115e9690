#include "named_stages.h"

#include <algorithm>
#include <cmath>

#include "lighting.h"

namespace tessera::reference {
namespace {

using Kind = Stage::Kind;

Vec4 gradient(const std::vector<Vec4>& colors, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const auto first = static_cast<std::size_t>(std::min(place, static_cast<double>(colors.size() - 2)));
  const double rest = place - static_cast<double>(first);
  return (1 - rest) * colors[first] + rest * colors[first + 1];
}

double height_in_mesh(const Mesh& mesh, double y) {
  const auto [low, high] = std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                                               [](const Vec4& a, const Vec4& b) { return a.y < b.y; });
  return high->y > low->y ? (y - low->y) / (high->y - low->y) : 0;
}

}  // namespace

bool makes_vertex_colors(const Draw& draw) {
  return std::any_of(draw.stages.begin(), draw.stages.end(),
                     [](const Stage& stage) { return stage.kind == Kind::kGradientObjectY; });
}

void run_stages(const Draw& draw, const Mesh& mesh, Vec4 object, Corner& corner) {
  for (const Stage& stage : draw.stages) {
    switch (stage.kind) {
      case Kind::kGradientObjectY:
        corner.color = gradient(stage.colors, height_in_mesh(mesh, object.y));
        break;
      case Kind::kReverseClipZ: corner.position_clip.z = -corner.position_clip.z; break;
      case Kind::kZoom:
        corner.position_clip.x *= stage.value;
        corner.position_clip.y *= stage.value;
        break;
      default: break;
    }
  }
}

Shade staged_color(const Draw& draw, const FrameBufferFormat& format, const Fragment& fragment, Vec3 world,
                   Shade shade) {
  for (const Stage& stage : draw.stages) {
    Vec4& c = shade.color;
    if (stage.kind == Kind::kGradientScreenY) {
      const Vec4 g = gradient(stage.colors, (fragment.y + 0.5) / format.height_px);
      c = {c.x * g.x, c.y * g.y, c.z * g.z, c.w * g.w};
    } else if (stage.kind == Kind::kFalloff) {
      const double factor = std::min(std::pow(length(world - stage.from), -stage.value), 1e6);
      c = {c.x * factor, c.y * factor, c.z * factor, c.w};
    }
  }
  shade.color = clamp01(shade.color);
  return shade;
}

std::optional<Fragment> staged_fragment(const Draw& draw, const FrameBufferFormat& format,
                                        Fragment fragment) {
  for (const Stage& stage : draw.stages) {
    if (stage.kind == Kind::kUncover && fragment.x + 0.5 > stage.value * format.width_px) return std::nullopt;
    if (stage.kind == Kind::kReverseWindowZ) fragment.depth.fill(1 - fragment.depth[0]);
  }
  return fragment;
}

}  // namespace tessera::reference
