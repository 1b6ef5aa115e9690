#include "shading/pixel_path.h"

#include "framebuffer/check.h"
#include "shading/tile_renderer.h"

namespace tessera::detail {
namespace {

using Kind = PixelPath::Kind;

bool has_packed_color(const TileDraw& draw) {
  if (draw.texture != nullptr || draw.stage != nullptr) return false;
  return draw.source == ColorSource::constant || draw.source == ColorSource::per_vertex_packed ||
         draw.source == ColorSource::per_triangle_packed;
}

bool has_offset(const TileDraw& draw) {
  return draw.offset_factor != 0 || draw.offset_units != 0 || draw.depth_offsets != nullptr;
}

bool is_rgb8(const ColorLayout& layout) {
  const bool has_8_bits = layout.r_bits == 8 && layout.g_bits == 8 && layout.b_bits == 8;
  const bool is_rgb = !layout.luminance && !layout.takes_indices();
  return has_8_bits && is_rgb && layout.alpha_bits == 0;
}

/// ColorWrite of a draw without operations.
ColorWrite plain_color_write(const TileDraw& draw) {
  if (draw.source == ColorSource::none) return ColorWrite::none;
  if (draw.source == ColorSource::per_pixel || draw.deferred) return ColorWrite::deferred;
  return draw.source == ColorSource::interpolated ? ColorWrite::interpolated : ColorWrite::constant;
}

/// ColorWrite of a draw in blocks of fragments.
ColorWrite fragment_color_write(const TileDraw& draw) {
  if (draw.source == ColorSource::none || draw.write_mask == 0) return ColorWrite::none;
  if (draw.deferred) return ColorWrite::deferred;
  const bool is_packed =
      draw.id_output != TileDraw::IdOutput::none || (draw.ops == nullptr && has_packed_color(draw));
  return is_packed ? ColorWrite::constant : ColorWrite::evaluated;
}

/// Whether the draw blends by source * alpha + destination * (1 - alpha) into 8-bit RGB without alpha, with
/// interpolated or constant colours, and without texture, dithering or logic operation.
bool is_plain_blend(const PixelPathFrame& frame, const TileDraw& draw) {
  const FragmentOps& ops = *draw.ops;
  if (!is_rgb8(frame.layout) || draw.texture != nullptr) return false;
  if (ops.dither || ops.logic != LogicOp::copy) return false;
  if (draw.source != ColorSource::interpolated && draw.source != ColorSource::constant) return false;
  if (draw.stage != nullptr) return false;
  if (!ops.blend || ops.equation != BlendEquation::add) return false;
  return ops.src_color == BlendFactor::src_alpha && ops.dst_color == BlendFactor::one_minus_src_alpha;
}

/// Whether Kind::triangles supports the operations of a draw: a stencil test, and a plain blend. If so,
/// `color_write` receives the draw's ColorWrite.
bool triangles_take_operations(const PixelPathFrame& frame, const TileDraw& draw, ColorWrite& color_write) {
  if (frame.samples > 1 || draw.ops->alpha_test) return false;
  if (draw.id_output != TileDraw::IdOutput::none || has_offset(draw)) return false;
  if (draw.stage != nullptr && (draw.stage->runs_before_tests || draw.stage->stage.reads.depth)) return false;
  if (draw.source == ColorSource::none || draw.deferred || draw.plain_colors) {
    color_write = plain_color_write(draw);
    return true;
  }
  color_write = ColorWrite::blended;
  return is_plain_blend(frame, draw);
}

/// Whether the draw has a texture, no operations, and RGB colours without lighting. One lane gains nothing.
bool can_texture_immediately(const PixelPathFrame& frame, const TileDraw& draw) {
  if (frame.isa == InstructionSet::scalar || !frame.shade_immediately || frame.samples > 1) return false;
  if (draw.ops != nullptr || draw.dither != nullptr || draw.stage != nullptr) return false;
  if (draw.texture == nullptr || draw.texture->levels == nullptr) return false;
  if (frame.layout.index || frame.layout.luminance || frame.layout.alpha_bits != 0) return false;
  if (draw.index[0] || draw.index[1]) return false;
  return draw.source == ColorSource::constant || draw.source == ColorSource::interpolated;
}

/// Without fragment operations and with one sample, points and lines of packed colours are stored pixel by
/// pixel, and so are lines of interpolated colours that are neither deferred nor colour indices. All others
/// become blocks of fragments.
PixelPath choose_point_or_line_path(const PixelPathFrame& frame, const TileDraw& draw, PixelPath path) {
  const bool is_line = draw.topology == Topology::lines;
  const bool has_plain_colors = !draw.deferred && !draw.index[0];
  const bool is_interpolated = is_line && has_plain_colors && draw.source == ColorSource::interpolated;
  const bool is_plain = draw.ops == nullptr && frame.samples == 1;
  if (is_plain && (is_interpolated || has_packed_color(draw))) {
    path.kind = is_line ? Kind::lines : Kind::points;
    path.color_write = is_interpolated ? ColorWrite::interpolated : ColorWrite::constant;
  } else {
    path.kind = is_line ? Kind::line_fragments : Kind::point_fragments;
    path.color_write = fragment_color_write(draw);
  }
  return path;
}

/// Whether Kind::triangles_msaa supports the colours of a draw: without deferred shading neither lit pixels
/// nor interpolated colours other than unmasked RGB 0..1.
[[maybe_unused]] bool triangles_msaa_take_colors(const PixelPathFrame& frame, const TileDraw& draw) {
  if (draw.deferred) return true;
  if (draw.source == ColorSource::per_pixel) return false;
  if (draw.source != ColorSource::interpolated) return true;
  if (frame.layout.index || frame.layout.luminance) return false;
  return draw.write_mask == 0xffffffffu && !draw.scaled_colors;
}

PixelPath choose_triangle_path(const PixelPathFrame& frame, const TileDraw& draw, PixelPath path) {
  const bool has_samples = frame.samples > 1;
  if (can_texture_immediately(frame, draw)) {
    path.kind = Kind::textured_triangles;
    path.color_write = ColorWrite::evaluated;
    return path;
  }
  path.color_write = plain_color_write(draw);
  if (draw.ops != nullptr && !triangles_take_operations(frame, draw, path.color_write)) {
    path.kind = has_samples ? Kind::fragments_msaa : Kind::fragments;
    path.color_write = fragment_color_write(draw);
    return path;
  }
  path.kind = has_samples ? Kind::triangles_msaa : Kind::triangles;
  const bool is_less_write = draw.depth_test == Compare::less && draw.depth_write && draw.ops == nullptr;
  // unorm32 depth is rare: one function for all tests.
  if (is_less_write && path.uses_depth() && path.depth_format != DepthFormat::unorm32)
    path.depth_test = DepthTestPath::less_write;
  TESSERA_ASSERT(!has_samples || triangles_msaa_take_colors(frame, draw));
  return path;
}

}  // namespace

PixelPathFrame pixel_path_frame(const TileFrame& frame, InstructionSet isa) {
  return {.layout = frame.layout,
          .depth_format = frame.depth_format,
          .samples = frame.samples,
          .shade_immediately = frame.shade_immediately,
          .isa = isa};
}

PixelPath choose_pixel_path(const PixelPathFrame& frame, const TileDraw& draw) {
  PixelPath path;
  const bool is_read_by_stage = draw.stage != nullptr && draw.stage->stage.reads.depth;
  if (draw.uses_depth || is_read_by_stage) path.depth_format = frame.depth_format;
  if (draw.texels != nullptr) {
    path.kind = Kind::pixel_rectangle;
    path.color_write = fragment_color_write(draw);
    return path;
  }
  if (draw.topology != Topology::triangles) return choose_point_or_line_path(frame, draw, path);
  return choose_triangle_path(frame, draw, path);
}

const char* name(PixelPath::Kind kind) {
  switch (kind) {
    case Kind::triangles: return "triangles";
    case Kind::triangles_msaa: return "triangles with several samples";
    case Kind::textured_triangles: return "textured triangles";
    case Kind::fragments: return "fragments of triangles";
    case Kind::fragments_msaa: return "fragments of triangles with several samples";
    case Kind::points: return "points";
    case Kind::lines: return "lines";
    case Kind::point_fragments: return "fragments of points";
    case Kind::line_fragments: return "fragments of lines";
    case Kind::pixel_rectangle: return "pixel rectangle";
  }
  return "";
}

const char* name(ColorWrite color_write) {
  switch (color_write) {
    case ColorWrite::none: return "none";
    case ColorWrite::constant: return "constant";
    case ColorWrite::interpolated: return "interpolated";
    case ColorWrite::blended: return "blended";
    case ColorWrite::evaluated: return "evaluated";
    case ColorWrite::deferred: return "deferred";
  }
  return "";
}

std::string describe(const PixelPath& path) {
  static constexpr const char* kDepthNames[] = {"none", "unorm16", "unorm24", "unorm32", "float32"};
  std::string text = std::string(name(path.kind)) + ", colour " + name(path.color_write) + ", depth " +
                     kDepthNames[static_cast<int>(path.depth_format)];
  if (path.depth_test == DepthTestPath::less_write) text += ", less and write";
  return text;
}

}  // namespace tessera::detail
