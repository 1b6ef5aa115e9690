#include "perf/accuracy/reference_pictures.h"

#include <cmath>
#include <cstdint>
#include <mutex>

#include "engine/program/threads/parallel_for.h"
#include "tests/reference/render.h"

namespace tessera::accuracy {
namespace {

constexpr int kSamples = kSamplesPerSide * kSamplesPerSide;
constexpr double kUnit = 1 << 30;  // fixed point of sums: 256 samples take 38 bits

/// Red, green and blue of all pixels, summed over samples. Integers: the order of summands does not matter.
using Sums = std::vector<std::uint64_t>;

void add_sample(const reference::Picture& picture, Sums& sums) {
  const auto fixed = [](double value) { return static_cast<std::uint64_t>(std::llround(value * kUnit)); };
  for (std::size_t i = 0; i < picture.unrounded.size(); ++i) {
    const reference::Vec4& color = picture.unrounded[i];
    sums[3 * i] += fixed(color.x);
    sums[3 * i + 1] += fixed(color.y);
    sums[3 * i + 2] += fixed(color.z);
  }
}

/// @param samples  in each sum
ReferencePicture picture_of(const Sums& sums, int samples, int width, int height) {
  ReferencePicture result{{}, program::Picture(width, height)};
  result.unrounded.reserve(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double value = static_cast<double>(sums[i]) / (samples * kUnit);
    result.unrounded.push_back(static_cast<float>(value));
    result.stored.rgba[i / 3 * 4 + i % 3] = static_cast<std::uint8_t>(std::floor(255 * value + 0.5));
  }
  for (std::size_t i = 3; i < result.stored.rgba.size(); i += 4) result.stored.rgba[i] = 255;
  return result;
}

}  // namespace

ReferencePicture render_point_reference(reference::Scene scene) {
  scene.framebuffer.samples = 1;
  const auto [width, height] = std::pair{scene.framebuffer.width_px, scene.framebuffer.height_px};
  Sums sums(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  add_sample(reference::render(scene), sums);
  return picture_of(sums, 1, width, height);
}

ReferencePicture render_area_reference(reference::Scene scene, int threads,
                                       const std::function<bool(double)>& progress) {
  scene.framebuffer.samples = 1;
  const auto [width, height] = std::pair{scene.framebuffer.width_px, scene.framebuffer.height_px};
  Sums sums(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::mutex mutex;
  int done = 0;
  const auto render_sample = [&](int number) {
    // The centre of sixteenth i is at (i + 1/2) / 16 - 1/2 pixels from the pixel's centre.
    constexpr int kStep = reference::kSubpixels / kSamplesPerSide;
    const auto shift = [](int i) {
      return kStep * i + kStep / 2 - static_cast<int>(reference::kSubpixels) / 2;
    };
    const reference::Picture picture =
        reference::render(scene, {shift(number % kSamplesPerSide), shift(number / kSamplesPerSide)});
    const std::lock_guard lock(mutex);
    add_sample(picture, sums);
    if (!progress(static_cast<double>(++done) / kSamples)) throw Cancelled("interrupted");
  };
  program::parallel_for(kSamples, threads, [&] { return render_sample; });
  return picture_of(sums, kSamples, width, height);
}

}  // namespace tessera::accuracy
