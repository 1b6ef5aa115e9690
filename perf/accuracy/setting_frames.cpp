#include "perf/accuracy/setting_frames.h"

#include <span>

#include "perf/accuracy/enlarge.h"

namespace tessera::accuracy {
namespace {

using program::Scene;
using program::SceneCamera;
using program::SceneCommand;

/// Offset of a pass in 1/16 pixel.
struct Jitter {
  double x, y;
};

// The standard sample positions of Direct3D 11 [D3D11_STANDARD_MULTISAMPLE_PATTERN]. Those of 16 samples are
// moved by 1/32 pixel, so that their mean is the pixel's centre, too.
constexpr Jitter kFour[] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
constexpr Jitter kEight[] = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
constexpr Jitter kSixteen[] = {{1.5, 1.5},  {-0.5, -2.5}, {-2.5, 2.5}, {4.5, -0.5}, {-4.5, -1.5}, {2.5, 5.5},
                               {5.5, 3.5},  {3.5, -4.5},  {-1.5, 6.5}, {0.5, -6.5}, {-3.5, -5.5}, {-5.5, 4.5},
                               {-7.5, 0.5}, {7.5, -3.5},  {6.5, 7.5},  {-6.5, -7.5}};

std::span<const Jitter> jitters(int passes) {
  if (passes == 4) return kFour;
  if (passes == 8) return kEight;
  return kSixteen;
}

/// Moves the picture by the offset against the pixels, in clip space.
SceneCamera shifted(const SceneCamera& camera, Jitter jitter, const FrameBufferFormat& format) {
  const double aspect = static_cast<double>(format.width) / format.height;
  SceneCamera result = camera;
  result.projection = translate(jitter.x / 8 / format.width, jitter.y / 8 / format.height, 0) *
                      camera.at_aspect(aspect).projection;
  return result;
}

FrameBufferFormat varied_format(FrameBufferFormat format, const Variation& variation) {
  if (variation.samples) format.samples = *variation.samples;
  if (variation.depth) format.depth = *variation.depth;
  if (variation.color_bits) format.color_bits = *variation.color_bits;
  if (variation.dither) format.dither = *variation.dither;
  if (variation.passes > 1) format.accumulation_bits = 16;
  format.width /= variation.divisor;
  format.height /= variation.divisor;
  return format;
}

/// The frame once, or at `passes` shifted positions, accumulated.
std::vector<SceneCommand> varied_commands(const Scene& scene, int passes) {
  if (passes == 1) return scene.frame;
  std::vector<SceneCommand> frame;
  const std::span<const Jitter> offsets = jitters(passes);
  for (const Jitter& jitter : offsets) {
    frame.push_back({.value = shifted(scene.camera, jitter, scene.framebuffer), .pointer = {}});
    frame.push_back({.value = scene.lights, .pointer = {}});
    for (const SceneCommand& command : scene.frame) {
      frame.push_back(command);
      if (auto* camera = std::get_if<SceneCamera>(&frame.back().value))
        *camera = shifted(*camera, jitter, scene.framebuffer);
    }
    const AccumOp op = &jitter == &offsets.front() ? AccumOp::load : AccumOp::accum;
    frame.push_back({.value = Accum{.op = op, .value = 1.0 / passes}, .pointer = {}});
  }
  frame.push_back({.value = Accum{.op = AccumOp::return_color}, .pointer = {}});
  return frame;
}

}  // namespace

SettingFrames::SettingFrames(Scene& scene, const Variation& variation, Renderer& renderer)
    : scene_(scene),
      format_(varied_format(scene.framebuffer, variation)),
      quality_(variation.quality),
      commands_(varied_commands(scene, variation.passes)),
      divisor_(variation.divisor),
      buffer_(format_),
      frame_(buffer_, renderer),
      renderer_(renderer),
      small_(format_.width, format_.height),
      picture_(scene.framebuffer.width, scene.framebuffer.height) {}

void SettingFrames::draw() {
  exchange();
  try {
    record(scene_, frame_);
  } catch (...) {
    exchange();
    throw;
  }
  exchange();
  renderer_.finish(frame_, divisor_ == 1 ? picture_.target() : small_.target());
  if (divisor_ != 1) enlarge(small_, divisor_, picture_);
}

void SettingFrames::exchange() {
  std::swap(scene_.framebuffer, format_);
  std::swap(scene_.quality, quality_);
  std::swap(scene_.frame, commands_);
}

}  // namespace tessera::accuracy
