#include "engine/program/imageio/area_resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "framebuffer/srgb.h"

namespace tessera::program {
namespace {

using LightTable = std::array<double, 256>;  ///< linear light of each sRGB level

LightTable light_of_levels() {
  LightTable table;
  for (std::size_t level = 0; level < table.size(); ++level)
    table[level] = detail::linear_from_srgb(static_cast<double>(level) / 255);
  return table;
}

std::uint8_t level_of_light(double light) {
  return static_cast<std::uint8_t>(detail::srgb_from_linear(std::clamp(light, 0.0, 1.0)) * 255 + 0.5);
}

/// A sample of the source and its share of a pixel of the result.
struct Tap {
  std::size_t position;
  double weight;
};

/// Shares of the source's samples in each of `to` equal parts of a line of `from` samples. A sample is `to`
/// units long, a part `from` units, so that overlaps are integers.
std::vector<std::vector<Tap>> taps_of(int from, int to) {
  std::vector<std::vector<Tap>> parts(static_cast<std::size_t>(to));
  for (long part = 0; part < to; ++part) {
    const long begin = part * from, end = begin + from;
    for (long sample = begin / to; sample * to < end; ++sample) {
      const long overlap = std::min(end, (sample + 1) * to) - std::max(begin, sample * to);
      parts[static_cast<std::size_t>(part)].push_back(
          {static_cast<std::size_t>(sample), static_cast<double>(overlap) / from});
    }
  }
  return parts;
}

}  // namespace

Picture area_resampled(const Picture& source, int width, int height) {
  const LightTable light = light_of_levels();
  const std::vector<std::vector<Tap>> columns = taps_of(source.width, width);
  const std::vector<std::vector<Tap>> rows = taps_of(source.height, height);
  const auto source_width = static_cast<std::size_t>(source.width);
  Picture result(width, height);
  std::vector<double> line(3 * source_width);  // light of a row of the result, before columns are averaged
  std::size_t at = 0;
  for (const std::vector<Tap>& row : rows) {
    std::fill(line.begin(), line.end(), 0.0);
    for (const Tap& tap : row)
      for (std::size_t x = 0; x < source_width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          line[3 * x + c] += tap.weight * light[source.rgba[4 * (tap.position * source_width + x) + c]];
    for (const std::vector<Tap>& column : columns) {
      std::array<double, 3> sum{};
      for (const Tap& tap : column)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += tap.weight * line[3 * tap.position + c];
      for (const double component : sum) result.rgba[at++] = level_of_light(component);
      result.rgba[at++] = 255;
    }
  }
  return result;
}

}  // namespace tessera::program
