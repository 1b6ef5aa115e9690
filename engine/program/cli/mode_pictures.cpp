#include "engine/program/cli/mode_pictures.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "engine/program/cli/indexed_frame.h"
#include "engine/program/cli/scene_buffers.h"
#include "engine/program/cli/scene_input.h"
#include "engine/program/scene/chosen_palette.h"
#include "engine/program/scene/scene_mode.h"

namespace tessera::program::cli {
namespace {

/// Frames are timed until both limits are reached, or the greatest number.
constexpr std::size_t kMinFrames = 3, kMaxFrames = 7;
constexpr double kMinMilliseconds = 100;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// @param stores_colors  whether the buffer that is drawn keeps its colours; the picture is the same
/// @return milliseconds, recording and reduction included
double draw_frame(const Scene& scene, Renderer& renderer, bool stores_colors, SceneBuffers& buffers,
                  Picture& picture) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Frame frame(buffers.drawn, renderer);
  record(scene, frame);
  if (stores_colors) frame.keep({Buffer::color});
  renderer.finish(frame, picture.target());
  if (buffers.reduced) reduce_picture(renderer, picture, *buffers.reduced);
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Returns whether a scene clears what it draws on, so that it looks the same in buffers that hold a picture.
bool clears_all(const Scene& scene, SceneBuffers& buffers) {
  Frame frame(buffers.drawn);
  record(scene, frame);
  try {
    return std::ranges::none_of(frame.buffers(), &BufferNote::loaded);
  } catch (const Error&) {
    return false;  // it loads a buffer that was not kept
  }
}

/// Times frames after the first, which fills the caches. Scenes that do not clear all get new buffers for
/// each frame; their times then include the allocation.
double median_frame_ms(const Scene& scene, Renderer& renderer, SceneBuffers& buffers, Picture& picture) {
  const bool reuses_buffers = clears_all(scene, buffers);
  std::vector<double> times;
  double total_ms = 0;
  while (times.size() < kMinFrames || (total_ms < kMinMilliseconds && times.size() < kMaxFrames)) {
    if (!reuses_buffers) buffers = SceneBuffers(scene);
    times.push_back(draw_frame(scene, renderer, false, buffers, picture));
    total_ms += times.back();
  }
  return median(std::move(times));
}

ModePicture drawn(const Scene& scene, Renderer& renderer, FrameTimes times) {
  SceneBuffers buffers(scene);
  ModePicture result{.picture = Picture(scene.framebuffer.width, scene.framebuffer.height),
                     .indexed = {},
                     .reduced = scene.reduced.has_value(),
                     .buffer_bytes = FrameBuffer::memory_bytes(scene.framebuffer)};
  if (scene.reduced) result.buffer_bytes += FrameBuffer::memory_bytes(*scene.reduced);
  draw_frame(scene, renderer, !scene.reduced, buffers, result.picture);
  if (is_indexed(buffers.shown().format())) result.indexed = indexed_picture(buffers.shown());
  if (times == FrameTimes::measured)
    result.frame_ms = median_frame_ms(scene, renderer, buffers, result.picture);
  return result;
}

/// The changes that a comparison makes to a scene.
SceneOverrides compared(const DisplayMode& mode, Dither dither, DitherSpace dither_in) {
  SceneOverrides overrides{.mode = mode, .dither = dither, .dither_in = dither_in};
  if (mode.palette_component_bits > 0) overrides.palette = "adaptive";
  return overrides;
}

/// Chooses the palette of the scene's picture. A scene of palette indices keeps that of the mode.
void set_chosen_palette(Scene& scene, Renderer& renderer) {
  if (scene.palette_source == PaletteSource::given) return;
  try {
    check_stores_colors(scene);
  } catch (const Error&) {
    scene.palette_source = PaletteSource::given;
    return;
  }
  set_mode_palette(choose_palette(scene, renderer), scene);
}

/// Returns whether an error may be due to the format of the frame buffer, not to the scene.
bool concerns_format(const Error& error) {
  return error.code() == ErrorCode::incompatible_format || error.code() == ErrorCode::invalid_argument;
}

}  // namespace

Scene ModeScenes::in_mode(const DisplayMode& mode, Dither dither, DitherSpace dither_in) {
  auto found = scenes_.find(mode.screen_aspect());
  if (found == scenes_.end()) {
    const SceneInput input(input_, {.mode = mode}, import_);
    if (scenes_.empty()) input.print_warnings();
    found = scenes_.emplace(mode.screen_aspect(), input.scene()).first;
  }
  Scene scene = found->second;
  apply(compared(mode, dither, dither_in), scene);
  return scene;
}

ModePicture draw_in_mode(Scene scene, Renderer& renderer, FrameTimes times) {
  set_chosen_palette(scene, renderer);
  try {
    return drawn(scene, renderer, times);
  } catch (const Error& error) {
    const bool may_reduce = scene.mode->color_mode == ColorMode::index && !scene.reduced;
    if (!may_reduce || !concerns_format(error)) throw;
  }
  reduce_to_mode(scene);
  return drawn(scene, renderer, times);
}

DisplayMode reference_mode(const DisplayMode& mode) {
  DisplayMode reference = mode;
  reference.color_mode = ColorMode::rgb;
  reference.color_bits = 24;
  reference.palette.clear();
  reference.palette_component_bits = 0;
  reference.layout = MemoryLayout::bytes;
  return reference;
}

}  // namespace tessera::program::cli
