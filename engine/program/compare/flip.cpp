#include "engine/program/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "engine/program/compare/flip_tile.h"
#include "engine/program/threads/parallel_for.h"

namespace tessera::program {
namespace {

void set_statistics(FlipErrors& errors) {
  double sum = 0;
  for (const float error : errors.map) sum += static_cast<double>(error);
  errors.mean = sum / static_cast<double>(errors.map.size());
  std::vector<float> sorted = errors.map;
  // Nearest rank: ceil(0.99 n), counted from 1.
  const std::uint64_t rank = (99 * std::uint64_t{sorted.size()} + 99) / 100;
  const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(sorted.begin(), nth, sorted.end());
  errors.percentile_99 = static_cast<double>(*nth);
  errors.largest = static_cast<double>(*std::max_element(nth, sorted.end()));
}

}  // namespace

FlipErrors flip_errors(const PixelView& picture, const PixelView& reference, const FlipOptions& options) {
  require_same_size(picture, reference);
  const double ppd = options.pixels_per_degree;
  if (!(ppd >= kMinPixelsPerDegree && ppd <= kMaxPixelsPerDegree)) {
    std::ostringstream message;
    message << "pixels_per_degree is " << ppd << ", must be " << kMinPixelsPerDegree << " to "
            << kMaxPixelsPerDegree;
    throw Error(message.str());
  }
  FlipErrors errors;
  errors.map.resize(picture.pixel_count());
  const FlipConstants constants(ppd);
  const int tile_columns = (picture.width + constants.tile_side - 1) / constants.tile_side;
  const int tile_rows = (picture.height + constants.tile_side - 1) / constants.tile_side;
  parallel_for(tile_columns * tile_rows, options.threads, [&] {
    return [&, tile = FlipTile(constants)](int i) mutable {
      tile.compute(picture, reference, i % tile_columns * constants.tile_side,
                   i / tile_columns * constants.tile_side, errors.map.data());
    };
  });
  set_statistics(errors);
  return errors;
}

}  // namespace tessera::program
