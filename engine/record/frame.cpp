// Recording of frames. All arguments are checked here.
#include "engine/tessera/tessera.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/buffers/image_target.h"
#include "engine/plan/draw_plan.h"
#include "engine/record/checks.h"
#include "engine/record/planar_shadow.h"
#include "engine/record/quality_caps.h"
#include "engine/record/recording.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/runtime/renderer_state.h"
#include "engine/runtime/worker_pool.h"
#include "raster/fixed_point.h"

namespace tessera {
using namespace detail;
namespace {

static_assert(kMaxFrameBufferSize == kMaxViewportPixels,
              "the limits of fixed_point.h are those of every viewport");

void check_material(const char* what, const Material& m) {
  require_finite({what, ".ambient"}, m.ambient);
  require_finite({what, ".diffuse"}, m.diffuse);
  require_finite({what, ".specular"}, m.specular);
  require_finite({what, ".emission"}, m.emission);
  require_range({what, ".shininess"}, m.shininess, 0, 16384);
  if (m.index_ramp)
    require_finite({what, ".index_ramp"}, {(*m.index_ramp)[0], (*m.index_ramp)[1], (*m.index_ramp)[2]});
}

void check_light(std::size_t number, const Light& l) {
  const auto check = [&] {
    require_finite({"", "ambient"}, l.ambient);
    require_finite({"", "diffuse"}, l.diffuse);
    require_finite({"", "specular"}, l.specular);
    require_finite({"", "position"}, {l.position[0], l.position[1], l.position[2], l.position[3]});
    require_finite({"", "spot_direction"}, {l.spot_direction[0], l.spot_direction[1], l.spot_direction[2]});
    require_finite({"", "attenuation"},
                   {l.attenuation_constant, l.attenuation_linear, l.attenuation_quadratic});
    require_range({"", "spot_exponent"}, l.spot_exponent, 0, 16384);
    if (l.spot_cutoff != 180 && !(l.spot_cutoff >= 0 && l.spot_cutoff <= 90))
      throw Error(ErrorCode::invalid_argument,
                  "spot_cutoff is " + format_number(l.spot_cutoff) + ", must be 0 to 90, or 180");
  };
  try {
    check();
  } catch (const Error& error) {
    throw Error(error.code(), "Frame::set_lights: light " + std::to_string(number) + "." + error.what());
  }
}

void check_state(const DrawState& s) {
  check_material("Frame::draw: material", s.material);
  if (s.back_material) check_material("Frame::draw: back_material", *s.back_material);
  require_finite({"Frame::draw: transform"}, s.transform);
  require_enum({"Frame::draw: shading"}, s.shading, Shading::phong);
  require_enum({"Frame::draw: color_material"}, s.color_material, ColorMaterial::specular);
  require_enum({"Frame::draw: provoking_vertex"}, s.provoking_vertex, ProvokingVertex::first);
  require_enum({"Frame::draw: cull"}, s.cull, Cull::front);
  require_enum({"Frame::draw: front_face"}, s.front_face, FrontFace::cw);
  for (const PolygonMode mode : {s.front_mode, s.back_mode})
    require_enum({"Frame::draw: a polygon mode"}, mode, PolygonMode::point);
  require_range({"Frame::draw: depth_near"}, s.depth_near, 0, 1);
  require_range({"Frame::draw: depth_far"}, s.depth_far, 0, 1);
  if (s.viewport) {
    check_rect({"Frame::draw: viewport"}, *s.viewport);
    require_range({"Frame::draw: viewport width"}, s.viewport->width, 1, kMaxFrameBufferSize);
    require_range({"Frame::draw: viewport height"}, s.viewport->height, 1, kMaxFrameBufferSize);
    require_range({"Frame::draw: viewport x"}, s.viewport->x, -kMaxViewportOffset / 2,
                  kMaxViewportOffset / 2);
    require_range({"Frame::draw: viewport y"}, s.viewport->y, -kMaxViewportOffset / 2,
                  kMaxViewportOffset / 2);
  }
}

void check_size(const char* name, float size) {
  if (std::isfinite(size) && size > 0) return;
  throw Error(ErrorCode::invalid_argument, "Frame::draw: " + std::string(name) + " is " +
                                               format_number(size) + ", must be a finite number above 0");
}

/// Checks sizes of points and lines, and the polygon offset.
void check_shape(const DrawState& s, const FrameBufferState& target) {
  check_size("point_size", s.point_size);
  check_size("line_width", s.line_width);
  require_finite({"Frame::draw: polygon_offset"}, {s.polygon_offset.factor, s.polygon_offset.units});
  if ((s.polygon_offset.factor != 0 || s.polygon_offset.units != 0) &&
      target.depth_format == DepthFormat::none)
    throw Error(ErrorCode::incompatible_format,
                "Frame::draw: a polygon offset is asked for, but the frame buffer has no depth buffer");
}

/// Checks the user stages against the draw and the frame buffer.
void check_stages(const RecordedDraw& draw, const FrameBufferState& target) {
  const DrawState& s = draw.state;
  const auto fail = [](ErrorCode code, const std::string& text) {
    throw Error(code, "Frame::draw: " + text);
  };
  if (s.shadow_on && (s.vertex_stage || s.fragment_stage))
    fail(ErrorCode::invalid_argument, "shadow_on and a user stage exclude each other");
  if (s.vertex_stage) {
    if (s.vertex_stage->run == nullptr)
      fail(ErrorCode::invalid_argument, "vertex_stage.run is null, must be a function");
    if (s.vertex_stage->writes.object)
      fail(ErrorCode::invalid_argument,
           "vertex_stage.writes.object is true, but object positions are inputs");
    require_range({"Frame::draw: vertex_stage.extras"}, s.vertex_stage->extras, 0, kMaxExtras);
  }
  if (!s.fragment_stage) return;
  if (s.fragment_stage->run == nullptr)
    fail(ErrorCode::invalid_argument, "fragment_stage.run is null, must be a function");
  const int extras = s.vertex_stage ? s.vertex_stage->extras : 0;
  if (s.fragment_stage->reads.extras < 0 || s.fragment_stage->reads.extras > extras)
    fail(ErrorCode::invalid_argument,
         "fragment_stage.reads.extras is " + std::to_string(s.fragment_stage->reads.extras) +
             ", must be 0 to the " + std::to_string(extras) + " extras that the vertex stage writes");
  const bool has_indices = s.lighting ? s.material.index_ramp.has_value() : bool(draw.mesh.color_indices);
  if (target.layout.takes_indices() && has_indices)
    fail(ErrorCode::incompatible_format,
         "a fragment stage works on RGB colours, but the colours of this draw are indices");
  if ((s.fragment_stage->reads.depth || s.fragment_stage->writes_depth) &&
      target.depth_format == DepthFormat::none)
    fail(ErrorCode::incompatible_format,
         "the fragment stage uses depth, but the frame buffer has no depth buffer");
}

const TextureState* check_texture(const DrawState& s, const TextureState* state) {
  require_enum({"Frame::draw: texture_env"}, s.texture_env, TextureEnv::add);
  require_finite({"Frame::draw: texture_env_color"}, s.texture_env_color);
  if (s.texture != nullptr && state == nullptr)
    throw Error(ErrorCode::invalid_state, "Frame::draw: the texture was moved from");
  return state;
}

template <class Change>
void change(FrameRecording& recording, const char* function, const Change& edit) {
  translate_bad_alloc(function, [&] { edit(recording.mutable_scene_state()); });
}

}  // namespace

Frame::Frame(FrameBuffer& target)
    : recording_(translate_bad_alloc("Frame", [] { return std::make_unique<FrameRecording>(); })) {
  if (!target.state_) throw Error(ErrorCode::invalid_state, "Frame: the frame buffer was moved from");
  recording_->target = target.state_.get();
}
Frame::Frame(FrameBuffer& target, Renderer& helper) : Frame(target) {
  if (!helper.state_) throw Error(ErrorCode::invalid_state, "Frame: the renderer was moved from");
  recording_->workers = &helper.state_->worker_pool;
}
Frame::~Frame() = default;
Frame::Frame(Frame&&) noexcept = default;
Frame& Frame::operator=(Frame&&) noexcept = default;

void Frame::set_camera(const Camera& camera) {
  const FloatingPointMode mode;
  require_finite({"Frame::set_camera: view"}, camera.view);
  require_finite({"Frame::set_camera: projection"}, camera.projection);
  change(*recording_, "Frame::set_camera", [&](SceneState& changed) { changed.camera = camera; });
}

void Frame::set_lights(std::span<const Light> lights) {
  const FloatingPointMode mode;
  for (std::size_t i = 0; i < lights.size(); ++i) check_light(i, lights[i]);
  change(*recording_, "Frame::set_lights",
         [&](SceneState& changed) { changed.lights.assign(lights.begin(), lights.end()); });
}

void Frame::set_light_model(const LightModel& model) {
  const FloatingPointMode mode;
  require_finite({"Frame::set_light_model: ambient"}, model.ambient);
  require_enum({"Frame::set_light_model: specular"}, model.specular, SpecularModel::phong);
  change(*recording_, "Frame::set_light_model", [&](SceneState& changed) { changed.light_model = model; });
}

void Frame::set_quality(const Quality& quality) {
  const FloatingPointMode mode;
  require_enum({"Frame::set_quality: shading"}, quality.shading, ShadingCap::flat);
  require_enum({"Frame::set_quality: viewer"}, quality.viewer, ViewerCap::infinite);
  require_enum({"Frame::set_quality: interpolation"}, quality.interpolation, InterpolationCap::affine);
  require_enum({"Frame::set_quality: texture"}, quality.texture, TextureCap::nearest);
  require_range({"Frame::set_quality: light_threshold"}, quality.light_threshold, 0, 1);
  change(*recording_, "Frame::set_quality", [&](SceneState& changed) { changed.quality = quality; });
}

void Frame::clear(const Clear& clear) {
  const FloatingPointMode mode;
  const FrameBufferState& target = *recording_->target;
  if (clear.color)
    for (const float c : {clear.color->r, clear.color->g, clear.color->b, clear.color->a})
      require_range({"Frame::clear: a component of color"}, c, 0, 1);
  if (clear.index) {
    if (!target.layout.takes_indices())
      throw Error(ErrorCode::incompatible_format,
                  "Frame::clear: an index is given, but the frame buffer's colour mode is rgb");
    if (*clear.index > target.layout.index_mask())
      throw Error(ErrorCode::invalid_argument, "Frame::clear: the index is " + std::to_string(*clear.index) +
                                                   ", must be at most " +
                                                   std::to_string(target.layout.index_mask()));
  }
  if (clear.depth) {
    if (target.depth_format == DepthFormat::none)
      throw Error(ErrorCode::incompatible_format,
                  "Frame::clear: a depth is given, but the frame buffer has no depth buffer");
    require_range({"Frame::clear: depth"}, *clear.depth, 0, 1);
  }
  if (clear.stencil) {
    const int bits = target.format.stencil_bits;
    if (bits == 0)
      throw Error(ErrorCode::incompatible_format,
                  "Frame::clear: a stencil value is given, but the frame buffer has no stencil buffer");
    if (*clear.stencil >= 1u << bits)
      throw Error(ErrorCode::invalid_argument, "Frame::clear: the stencil value is " +
                                                   std::to_string(*clear.stencil) + ", must be at most " +
                                                   std::to_string((1u << bits) - 1));
  }
  if (clear.accumulation) {
    if (target.format.accumulation_bits == 0)
      throw Error(
          ErrorCode::incompatible_format,
          "Frame::clear: an accumulation colour is given, but the frame buffer has no accumulation buffer");
    const Color& c = *clear.accumulation;
    for (const float component : {c.r, c.g, c.b, c.a})
      require_range({"Frame::clear: a component of accumulation"}, component, -1, 1);
  }
  if (clear.scissor) check_rect({"Frame::clear: scissor"}, *clear.scissor);
  translate_bad_alloc("Frame::clear", [&] {
    recording_->clears.push_back({clear, recording_->draws.size()});
  });
}

void Frame::accumulate(const Accum& accum) {
  const FloatingPointMode mode;
  const FrameBufferState& target = *recording_->target;
  if (target.layout.takes_indices())
    throw Error(ErrorCode::incompatible_format,
                "Frame::accumulate: the frame buffer holds indices, which do not accumulate");
  if (target.format.accumulation_bits == 0)
    throw Error(ErrorCode::incompatible_format,
                "Frame::accumulate: the frame buffer has no accumulation buffer");
  require_enum({"Frame::accumulate: op"}, accum.op, AccumOp::return_color);
  require_finite({"Frame::accumulate: value"}, {accum.value});
  if (accum.scissor) check_rect({"Frame::accumulate: scissor"}, *accum.scissor);
  check_color_mask("Frame::accumulate", accum.color_mask, target);
  translate_bad_alloc("Frame::accumulate", [&] {
    recording_->accumulations.push_back({accum, recording_->draws.size(), recording_->clears.size()});
  });
}

void Frame::draw(const Mesh& mesh, const DrawState& state) {
  const FloatingPointMode mode;
  translate_bad_alloc("Frame::draw", [&] {
    RecordedDraw draw{.mesh = check_mesh(mesh), .state = state, .scene_state = &recording_->scene_state()};
    check_state(state);
    check_shape(state, *recording_->target);
    check_fragment_state("Frame::draw", state, *recording_->target);
    draw.texture = check_texture(state, state.texture != nullptr ? state.texture->state_.get() : nullptr);
    draw.state.shading = capped(state.shading, draw.scene_state->quality.shading);
    draw.shading_is_capped = draw.state.shading != state.shading;
    check_stages(draw, *recording_->target);
    if (state.vertex_stage) {
      draw.mesh.stage_makes_normals = state.vertex_stage->writes.normal;
      draw.mesh.stage_makes_colors = state.vertex_stage->writes.color;
      draw.mesh.stage_makes_texcoords = state.vertex_stage->writes.texcoord;
    }
    if (state.shadow_on) apply_planar_shadow(draw);
    check_indices(draw.mesh, recording_->workers);
    recording_->draws.push_back(std::move(draw));
  });
}

void Frame::keep(std::initializer_list<Buffer> buffers) {
  for (const Buffer buffer : buffers) require_enum({"Frame::keep: a buffer"}, buffer, Buffer::accumulation);
  recording_->has_keep_list = true;
  recording_->kept = {};
  for (const Buffer buffer : buffers) recording_->kept[static_cast<std::size_t>(buffer)] = true;
}

void Frame::capture(const Capture& capture) {
  const PixelRect region = pixels_of_region(capture.region, recording_->target->format, "Frame::capture");
  const std::size_t pixels =
      static_cast<std::size_t>(region.x1 - region.x0) * static_cast<std::size_t>(region.y1 - region.y0);
  const auto require_size = [&](const char* what, std::size_t found, std::size_t needed) {
    if (found != 0 && found != needed)
      throw Error(ErrorCode::invalid_argument, std::string("Frame::capture: the span for ") + what +
                                                   " holds " + std::to_string(found) + " elements, " +
                                                   (capture.region ? "the region" : "the frame buffer") +
                                                   " needs " + std::to_string(needed));
  };
  require_size("draw_ids", capture.draw_ids.size(), pixels);
  require_size("primitive_ids", capture.primitive_ids.size(), pixels);
  require_size("normals", capture.normals.size(), 3 * pixels);
  recording_->capture = capture;
}

void Frame::reset() noexcept { recording_->clear(); }

std::size_t Frame::draw_count() const noexcept { return recording_->draws.size(); }

}  // namespace tessera
