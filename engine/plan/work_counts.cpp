#include "engine/plan/work_counts.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tessera::detail {
namespace {

/// Items of a light and of its effects.
struct LightItems {
  PriceItem directional, point, attenuation, spot, highlight, local_viewer;
};
constexpr LightItems kAtVertices{PriceItem::vertex_directional_light, PriceItem::vertex_point_light,
                                 PriceItem::vertex_attenuation,       PriceItem::vertex_spot,
                                 PriceItem::vertex_highlight,         PriceItem::vertex_local_viewer};
constexpr LightItems kAtPixels{PriceItem::pixel_directional_light, PriceItem::pixel_point_light,
                               PriceItem::pixel_attenuation,       PriceItem::pixel_spot,
                               PriceItem::pixel_highlight,         PriceItem::pixel_local_viewer};

/// Counts the lights of a program at a number of points.
void add_lights(WorkCounts& counts, const LightingProgram& program, const LightItems& items, double points) {
  for (const LightTerm& term : program.terms) {
    counts[term.kind == LightKind::directional ? items.directional : items.point] += points;
    const bool is_attenuated =
        term.kind == LightKind::attenuated_point || term.kind == LightKind::attenuated_spot;
    if (is_attenuated) counts[items.attenuation] += points;
    if (is_spot(term.kind)) counts[items.spot] += points;
    if (term.highlight == HighlightKind::none) continue;
    counts[items.highlight] += points;
    const bool is_local =
        term.highlight == HighlightKind::blinn_local || term.highlight == HighlightKind::phong_local;
    if (is_local) counts[items.local_viewer] += points;
  }
}

PriceItem depth_item(DepthFormat format) {
  switch (format) {
    case DepthFormat::unorm16: return PriceItem::depth_unorm16_pixel;
    case DepthFormat::unorm32: return PriceItem::depth_unorm32_pixel;
    case DepthFormat::float32: return PriceItem::depth_float32_pixel;
    default: return PriceItem::depth_unorm24_pixel;
  }
}

PriceItem texture_item(TextureFilter filter) {
  constexpr PriceItem kItems[] = {
      PriceItem::texture_nearest,
      PriceItem::texture_linear,
      PriceItem::texture_nearest_mipmap_nearest,
      PriceItem::texture_linear_mipmap_nearest,
      PriceItem::texture_nearest_mipmap_linear,
      PriceItem::texture_linear_mipmap_linear,
  };
  return kItems[static_cast<std::size_t>(filter)];
}

/// Counts pixels stored in a number of colour planes, as a mixture of the two nearest numbers with a price.
void add_stored_colors(WorkCounts& counts, int planes, double pixels) {
  struct Stored {
    int planes;
    PriceItem item;
  };
  constexpr Stored kStored[] = {{1, PriceItem::stored_1},   {2, PriceItem::stored_2},
                                {4, PriceItem::stored_4},   {8, PriceItem::stored_8},
                                {16, PriceItem::stored_16}, {24, PriceItem::stored_24}};
  std::size_t more = 1;
  while (more + 1 < std::size(kStored) && kStored[more].planes < planes) ++more;
  const Stored &below = kStored[more - 1], &above = kStored[more];
  const double share = static_cast<double>(planes - below.planes) / (above.planes - below.planes);
  counts[below.item] += (1 - share) * pixels;
  counts[above.item] += share * pixels;
}

constexpr double kLinePixels = 16;  // pixels of PriceItem::line_16

/// Items of samples: in the code paths without and with fragment operations.
struct SampleItems {
  PriceItem triangle, pixel;
};
constexpr SampleItems kPlain4{PriceItem::samples_4_triangle, PriceItem::samples_4_pixel};
constexpr SampleItems kPlain8{PriceItem::samples_8_triangle, PriceItem::samples_8_pixel};
constexpr SampleItems kGeneral4{PriceItem::fragment_samples_4_triangle, PriceItem::fragment_samples_4_pixel};
constexpr SampleItems kGeneral8{PriceItem::fragment_samples_8_triangle, PriceItem::fragment_samples_8_pixel};

/// Counts one draw.
class DrawCounter {
 public:
  DrawCounter(WorkCounts& counts, const FinishedFrame& frame, std::size_t plan)
      : counts_(counts),
        frame_(frame),
        plan_(*frame.commands.plans[plan]),
        draw_(frame.recording.draws[frame.commands.plan_draw[plan]]),
        path_(frame.commands.tile_draws[frame.commands.first_tile_draw[plan]].path),
        work_(frame.draws[frame.commands.plan_draw[plan]]) {}

  void count() {
    counts_[PriceItem::draw] += 1;
    if (plan_.pixel_rectangle) {
      counts_[PriceItem::texel_pixel] += fragments();
      return;
    }
    count_vertices();
    count_elements();
    count_depth_and_samples();
    count_operations();
    count_colors();
  }

 private:
  double fragments() const { return static_cast<double>(work_.fragments); }
  double shaded() const { return static_cast<double>(work_.shaded_pixels); }
  double binned() const { return static_cast<double>(work_.binned); }
  double kept_triangles() const {
    const std::uint64_t dropped = work_.trivially_rejected + work_.culled;
    return static_cast<double>(work_.triangles_in - std::min(dropped, work_.triangles_in));
  }

  /// Points for which colours are evaluated, per pixel that needs it. Immediate evaluation works on blocks of
  /// 4x4 pixels. A line of n pixels touches about 1 + n/4 blocks; a right triangle with legs of a blocks
  /// covers a^2/2 blocks, and its three edges touch about 1.5 a + 1 more.
  double evaluated_points() const {
    if (path_.color_write != ColorWrite::evaluated || !(fragments() > 0)) return 1;
    constexpr double kBlockPixels = 16, kBlockSide = 4;
    const bool is_line = plan_.outlines || plan_.topology == Topology::lines;
    const double elements = std::max(plan_.outlines ? 3 * kept_triangles() : binned(), 1.0);
    const double pixels = std::max(fragments() / elements, 1.0);
    const double side = std::sqrt(2 * pixels) / kBlockSide;
    const double blocks = is_line ? 1 + pixels / kBlockSide : 1 + 1.5 * side + side * side / 2;
    return std::max(1.0, kBlockPixels * blocks / pixels);
  }

  /// Points that are lit, per shaded pixel: 1 without coarse shading. Cells of s x s pixels are lit once per
  /// triangle that is visible in them; see evaluated_points() for their number.
  double lit_points_per_pixel() const {
    if (plan_.cell_size == 0 || path_.color_write != ColorWrite::deferred || !(shaded() > 0)) return 1;
    const double visible_share = std::min(1.0, shaded() / std::max(fragments(), 1.0));
    const double pixels = std::max(shaded() / std::max(visible_share * binned(), 1.0), 1.0);
    const double side = std::sqrt(2 * pixels) / plan_.cell_size;
    return std::min(1.0, (1 + 1.5 * side + side * side / 2) / pixels);
  }

  void count_vertices() {
    const auto vertices = static_cast<double>(work_.vertices);
    counts_[PriceItem::vertex] += vertices;
    if (plan_.smooth_normals) counts_[PriceItem::generated_normal] += vertices;
    if (plan_.face_normals) counts_[PriceItem::face_normal] += static_cast<double>(work_.triangles_in);
    if (plan_.source == ColorSource::per_pixel) {
      counts_[PriceItem::vertex_normals] += vertices;
    } else if (plan_.lit) {
      const double points =
          plan_.has_per_triangle_colors() ? static_cast<double>(work_.triangles_in) : vertices;
      counts_[PriceItem::vertex_lighting] += points;
      if (draw_.state.normalize) counts_[PriceItem::vertex_normalization] += points;
      add_lights(counts_, plan_.front, kAtVertices, points);
      if (plan_.two_sided) counts_[PriceItem::vertex_second_side] += points;
    } else if (plan_.uses_vertex_colors || plan_.uses_color_indices) {
      counts_[PriceItem::vertex_colors] += vertices;
    }
  }

  void count_elements() {
    counts_[PriceItem::triangle_outside] += static_cast<double>(work_.trivially_rejected);
    counts_[PriceItem::triangle_culled] += static_cast<double>(work_.culled);
    counts_[PriceItem::triangle_clipped] += static_cast<double>(work_.clipped);
    if (plan_.outlines) {
      counts_[PriceItem::outlined_triangle] += kept_triangles();
      counts_[PriceItem::outlined_pixel] += fragments();
    } else if (plan_.topology == Topology::points) {
      const bool has_operations = path_.kind == PixelPath::Kind::point_fragments;
      counts_[has_operations ? PriceItem::point_fragments : PriceItem::point] += binned();
    } else if (plan_.topology == Topology::lines) {
      const bool has_operations = path_.kind == PixelPath::Kind::line_fragments;
      counts_[has_operations ? PriceItem::line_16_fragments : PriceItem::line_16] +=
          std::max(binned(), fragments() / kLinePixels);
    } else {
      add_triangles(counts_, binned(), fragments());
    }
  }

  void count_depth_and_samples() {
    const int samples = frame_.target.format.samples;
    if (plan_.uses_depth) {
      counts_[PriceItem::depth_triangle] += binned();
      counts_[depth_item(frame_.target.depth_format)] += fragments();
    }
    if (samples == 1) return;
    const SampleItems& plain = samples == 4 ? kPlain4 : kPlain8;
    const SampleItems& general = samples == 4 ? kGeneral4 : kGeneral8;
    const SampleItems& items = path_.kind == PixelPath::Kind::fragments_msaa ? general : plain;
    counts_[items.triangle] += binned();
    counts_[items.pixel] += fragments();
  }

  void count_operations() {
    if (path_.color_write == ColorWrite::blended) {
      counts_[PriceItem::source_alpha_blend_triangle] += binned();
      counts_[PriceItem::source_alpha_blend_pixel] += fragments();
    }
    if (plan_.uses_stencil) counts_[PriceItem::stencil_test] += fragments();
    // Prices of points, lines and outlines include their code path.
    const bool is_general =
        path_.kind == PixelPath::Kind::fragments || path_.kind == PixelPath::Kind::fragments_msaa;
    if (is_general && !plan_.outlines) {
      counts_[PriceItem::fragment_operations_triangle] += binned();
      counts_[PriceItem::fragment_operations_pixel] += fragments();
      counts_[PriceItem::fragment_passed] += shaded();
    }
    const FragmentOps& ops = plan_.ops;
    if (plan_.defers_dither) counts_[PriceItem::dither] += shaded();
    if (!plan_.has_ops) return;
    if (ops.alpha_test) counts_[PriceItem::alpha_test] += fragments();
    if (ops.blend) counts_[PriceItem::blending] += shaded();
    if (ops.logic != LogicOp::copy) counts_[PriceItem::logic_op] += shaded();
    if (ops.dither) counts_[PriceItem::dither] += shaded();
    if (plan_.write_mask != 0xffffffffu) counts_[PriceItem::write_masks] += shaded();
    if (plan_.has_offset()) counts_[PriceItem::polygon_offset] += fragments();
  }

  void count_colors() {
    const bool is_deferred = path_.color_write == ColorWrite::deferred;
    const bool is_interpolated = plan_.source == ColorSource::interpolated && !plan_.flat;
    if (is_deferred) {
      const double visible_share = fragments() > 0 ? std::min(1.0, shaded() / fragments()) : 0;
      counts_[PriceItem::deferred_triangle] += visible_share * std::min(binned(), shaded());
      counts_[PriceItem::deferred_pixel] += shaded();
      if (is_interpolated) counts_[PriceItem::interpolated_deferred_pixel] += shaded();
    } else if (is_interpolated) {
      counts_[PriceItem::interpolated_triangle] += binned();
      counts_[PriceItem::interpolated_pixel] += fragments();
    }
    const double points = shaded() * evaluated_points();
    if (plan_.source == ColorSource::per_pixel) {
      counts_[PriceItem::shaded_pixel] += points;
      add_lights(counts_, plan_.front, kAtPixels, points * lit_points_per_pixel());
      if (plan_.two_sided) counts_[PriceItem::pixel_second_side] += points;
    }
    const bool samples_texels = plan_.textures_per_pixel && plan_.texture.use == TexturePlan::Use::texels;
    if (samples_texels)
      counts_[texture_item(draw_.texture->under(draw_.scene_state->quality.texture).sampler.min)] += points;
    const bool varies = is_interpolated || plan_.source == ColorSource::per_pixel || samples_texels;
    if (plan_.uses_palette() && frame_.target.layout.index && varies) count_palette_search();
  }

  /// A mixture of the searches of 16 and of 256 entries.
  void count_palette_search() {
    const auto entries = static_cast<double>(frame_.target.format.palette.size());
    const double share = (entries - 16) / (256 - 16);
    counts_[PriceItem::palette_search_16] += (1 - share) * shaded();
    counts_[PriceItem::palette_search_256] += share * shaded();
  }

  WorkCounts& counts_;
  const FinishedFrame& frame_;
  const DrawPlan& plan_;
  const RecordedDraw& draw_;
  const PixelPath& path_;
  const DrawMeasurement& work_;
};

double area(const PixelRect& rect) {
  return static_cast<double>(rect.x1 - rect.x0) * static_cast<double>(rect.y1 - rect.y0);
}

void count_stores(WorkCounts& counts, const FinishedFrame& frame, double pixels) {
  const FrameBufferFormat& format = frame.target.format;
  const FrameAttachments& attachments = frame.commands.attachments;
  const double color_planes = format.color_bits + format.alpha_bits;
  if (attachments.color.stores()) add_stored_colors(counts, format.color_bits + format.alpha_bits, pixels);
  // Cleared planes are not read.
  const auto loads = [](const AttachmentOps& ops, const Attachment& stored) {
    return ops.loads() && stored.content == Attachment::Content::planes;
  };
  if (loads(attachments.color, frame.target.color))
    counts[PriceItem::loaded_24] += pixels * color_planes / 24;
  if (attachments.depth.stores()) {
    const int bits = depth_bits(frame.target.depth_format);
    if (bits == 16) counts[PriceItem::stored_depth_16] += pixels;
    else counts[bits == 24 ? PriceItem::stored_depth_24 : PriceItem::stored_depth_32] += pixels;
  }
  if (loads(attachments.depth, frame.target.depth)) counts[PriceItem::loaded_24] += pixels;
  if (attachments.stencil.stores()) counts[PriceItem::stored_stencil_8] += pixels;
  const double accumulation_planes = 4.0 * format.accumulation_bits;
  if (attachments.accumulation.stores())
    counts[PriceItem::stored_depth_32] += pixels * accumulation_planes / 32;
  if (loads(attachments.accumulation, frame.target.accumulation[0]))
    counts[PriceItem::loaded_24] += pixels * accumulation_planes / 24;
}

/// Counts the frame itself: its tiles, stores and accumulations.
void count_buffers(WorkCounts& counts, const FinishedFrame& frame) {
  const FrameBufferFormat& format = frame.target.format;
  const double pixels = static_cast<double>(format.width) * format.height;
  const double pixels_per_tile = frame.stats.tiles > 0 ? pixels / static_cast<double>(frame.stats.tiles) : 0;
  const double rendered = pixels_per_tile * static_cast<double>(frame.stats.tiles_rendered);
  const double touched = pixels_per_tile * static_cast<double>(frame.stats.tiles_touched);
  counts[PriceItem::frame] += 1;
  if (frame.presented) {
    counts[PriceItem::shown_tile_pixel] += rendered;
    counts[PriceItem::shown_pixel] += pixels - rendered;
    if (frame.target.stored_layout.index) counts[PriceItem::shown_index_pixel] += rendered;
  }
  if (frame.commands.attachments.depth.used()) counts[PriceItem::depth_tile_pixel] += rendered;
  if (format.samples > 1)
    counts[format.samples == 4 ? PriceItem::resolved_4 : PriceItem::resolved_8] += touched;
  count_stores(counts, frame, pixels);
  if (frame.target.diffusion && (frame.presented || frame.commands.attachments.color.stores())) {
    counts[PriceItem::diffused_pixel] += pixels;
    if (frame.target.stored_layout.index) counts[PriceItem::diffused_index_pixel] += pixels;
  }
  for (const TileClear& clear : frame.commands.clears)
    if (clear.dithered) counts[PriceItem::dithered_clear] += area(clear.rect);
  for (const TileAccumulation& accumulation : frame.commands.accumulations) {
    const bool returns = accumulation.arithmetic.op() == AccumOp::return_color;
    counts[returns ? PriceItem::returned : PriceItem::accumulated] += area(accumulation.rect);
  }
}

}  // namespace

WorkCounts count_work(const FinishedFrame& frame) {
  WorkCounts counts;
  count_buffers(counts, frame);
  for (std::size_t plan = 0; plan < frame.commands.plans.size(); ++plan)
    DrawCounter(counts, frame, plan).count();
  return counts;
}

}  // namespace tessera::detail
