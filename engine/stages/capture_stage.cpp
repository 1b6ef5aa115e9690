#include "engine/stages/capture_stage.h"

#include <algorithm>
#include <numeric>

#include "engine/plan/draw_plan.h"
#include "shading/lighting.h"

namespace tessera::detail {

CaptureStage::CaptureStage(const FrameCommands& commands, const TileFrame& frame, const Capture& capture,
                           bool count_fragments, InstructionSet isa)
    : capture_(capture),
      grid_(frame.grid),
      region_{0, 0, grid_.width_px, grid_.height_px},
      render_(detail::render_tile(isa)) {
  if (capture.region) region_ = raster_rect(*capture.region, grid_.height_px);
  normal_program_.needs_normal = normal_program_.renormalize = true;
  const bool captures_ids = !capture.draw_ids.empty() || !capture.primitive_ids.empty();
  const bool has_passes = captures_ids || !capture.normals.empty() || count_fragments;
  if (!has_passes) return;
  if (!capture.primitive_ids.empty()) number_primitives(commands.geometry);
  passes_.reserve(4);  // frames of passes point into them
  if (!capture.draw_ids.empty()) add_pass(PassKind::draw_ids, commands, frame, isa);
  if (!capture.primitive_ids.empty()) add_pass(PassKind::primitive_ids, commands, frame, isa);
  if (!capture.normals.empty()) add_pass(PassKind::normals, commands, frame, isa);
  if (count_fragments) add_pass(PassKind::fragments, commands, frame, isa);
}

void CaptureStage::number_primitives(std::span<const GeometryDraw> draws) {
  std::size_t max_elements = 0;
  for (const GeometryDraw& draw : draws) max_elements = std::max(max_elements, draw.mesh->elements);
  triangle_ids_.resize(max_elements);
  std::iota(triangle_ids_.begin(), triangle_ids_.end(), 0u);
  for (const GeometryDraw& draw : draws) {
    std::vector<std::uint32_t>& numbers = polygon_ids_.emplace_back();
    const std::size_t each = draw.mesh->triangles_per_polygon();
    if (each < 2) continue;
    numbers.resize(draw.mesh->elements);
    for (std::size_t t = 0; t < numbers.size(); ++t) numbers[t] = static_cast<std::uint32_t>(t / each);
  }
}

void CaptureStage::add_pass(PassKind kind, const FrameCommands& commands, const TileFrame& frame,
                            InstructionSet isa) {
  Pass& pass = passes_.emplace_back(Pass{kind, frame, commands.tile_draws, commands.clears, {}});
  pass.ops.reserve(pass.draws.size());  // draws refer to it
  for (std::size_t i = 0; i < pass.draws.size(); ++i) change_output(pass, pass.draws[i], commands, i);
  for (TileClear& clear : pass.clears) {
    clear.packed_color = Capture::kNothing;
    clear.dithered = false;
    clear.accumulation = false;
  }
  pass.frame.layout = rgb_layout(24);
  pass.frame.palette_search = nullptr;
  pass.frame.samples = 1;  // visibility at the pixel centre
  const bool is_measured = kind == PassKind::fragments && frame.meter_pass != MeterPass::none;
  pass.frame.meter_pass = is_measured ? MeterPass::fragments : MeterPass::none;
  pass.frame.draws = pass.draws.data();
  pass.frame.clears = pass.clears.data();
  const PixelPathFrame path_frame = pixel_path_frame(pass.frame, isa);
  for (TileDraw& draw : pass.draws) draw.path = choose_pixel_path(path_frame, draw);
  pass.frame.accumulation_count = 0;  // colours from the accumulation buffer belong to no draw
}

void CaptureStage::change_output(Pass& pass, TileDraw& draw, const FrameCommands& commands,
                                 std::size_t tile_draw) const {
  const std::size_t plan = commands.tile_draw_plan[tile_draw];
  draw.skips_hidden = false;
  // A stage that decides which fragments pass runs in captures too, on the colours of the frame.
  const bool keeps_stage = draw.stage != nullptr && draw.stage->runs_before_tests;
  if (keeps_stage) draw.colors_of = &commands.tile_draws[tile_draw];
  else draw.stage = nullptr;
  if (pass.kind == PassKind::fragments) {
    draw.uses_depth = false;
    draw.ops = nullptr;
    draw.stage = nullptr;
  }
  if (draw.ops == nullptr) draw.texture = nullptr;                       // otherwise the alpha test needs it
  if (draw.write_mask == 0 && pass.kind != PassKind::fragments) return;  // changes depth or stencil alone
  draw.write_mask = 0xffffffffu;
  draw.deferred = pass.kind == PassKind::normals;
  draw.source = ColorSource::constant;
  draw.packed_color = static_cast<std::uint32_t>(commands.plan_draw[plan]);
  if (draw.ops != nullptr) {
    // Only tests decide visibility; operations on colours do not.
    FragmentOps& ops = pass.ops.emplace_back(*draw.ops);
    ops.blend = false;
    ops.dither = nullptr;
    ops.logic = LogicOp::copy;
    draw.ops = &ops;
    draw.deferred = false;
    draw.id_output =
        pass.kind == PassKind::primitive_ids ? TileDraw::IdOutput::primitive : TileDraw::IdOutput::draw;
  }
  if (pass.kind == PassKind::primitive_ids) {
    draw.source = ColorSource::per_triangle_packed;
    draw.packed_colors[0] = draw.packed_colors[1] =
        (polygon_ids_[plan].empty() ? triangle_ids_ : polygon_ids_[plan]).data();
  }
  if (pass.kind == PassKind::normals) {
    if (draw.texels != nullptr) {
      // Bitmaps and images have no normals: they count as background.
      draw.deferred = false;
      draw.id_output = TileDraw::IdOutput::draw;
      draw.packed_color = Capture::kNothing;
      return;
    }
    draw.source = ColorSource::per_pixel;
    draw.captures_normals = true;
    draw.cell_size = 0;
    draw.first_attribute = commands.plans[plan]->varyings.captured_normal;
    draw.attribute_count = 3;
    for (int c = 0; c < 3; ++c) draw.fields[c] = static_cast<std::uint8_t>(kNormalX + c);
    draw.programs[0] = draw.programs[1] = &normal_program_;
  }
}

std::uint64_t CaptureStage::render_pass(const Pass& pass, int row, int column,
                                        TileWorkspace& workspace) const {
  const PixelRect pixels = captured_pixels(row, column);
  std::fill_n(workspace.color(), grid_.tile_size * grid_.tile_size, Capture::kNothing);
  const TileCounts counts = render_(pass.frame, row * grid_.columns() + column, workspace);
  if (pass.kind == PassKind::draw_ids) write_ids(capture_.draw_ids, pixels, workspace);
  if (pass.kind == PassKind::primitive_ids) write_ids(capture_.primitive_ids, pixels, workspace);
  if (pass.kind == PassKind::normals) write_normals(pixels, workspace);
  return pass.kind == PassKind::fragments ? counts.shaded_pixels : 0;
}

void CaptureStage::write_ids(std::span<std::uint32_t> to, const PixelRect& pixels,
                             TileWorkspace& workspace) const {
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    std::uint32_t* out = to.data() + span_index(pixels.x0, y);
    for (int x = pixels.x0; x < pixels.x1; ++x) *out++ = workspace.color()[tile_index_of(x, y)];
  }
}

void CaptureStage::write_normals(const PixelRect& pixels, TileWorkspace& workspace) const {
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    float* out = capture_.normals.data() + 3 * span_index(pixels.x0, y);
    for (int x = pixels.x0; x < pixels.x1; ++x, out += 3) {
      const int at = tile_index_of(x, y);
      const bool drawn = workspace.color()[at] != Capture::kNothing;
      for (int c = 0; c < 3; ++c) out[c] = drawn ? workspace.normals(c)[at] : 0.0f;
    }
  }
}

}  // namespace tessera::detail
