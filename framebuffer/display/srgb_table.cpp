#include "framebuffer/display/srgb_table.h"

#include <bit>
#include <cstddef>

#include "framebuffer/srgb.h"

namespace tessera::detail {
namespace {

double light_of_segment(std::size_t segment) {
  const auto bits = static_cast<std::uint32_t>(SrgbTable::kFirstSegment + static_cast<int>(segment));
  return std::bit_cast<float>(bits << SrgbTable::kShift);
}

SrgbTable make_table() {
  SrgbTable table;
  for (std::size_t segment = 0; segment < SrgbTable::kSegments; ++segment) {
    const double left = light_of_segment(segment), right = light_of_segment(segment + 1);
    const double code = 255 * srgb_from_linear(left);
    const double slope = (255 * srgb_from_linear(right) - code) / (right - left);
    table.slope[segment] = static_cast<float>(slope);
    table.offset[segment] = static_cast<float>(code - slope * left + 0.5);  // rounds to nearest
  }
  return table;
}

}  // namespace

const SrgbTable& srgb_table() {
  static const SrgbTable table = make_table();
  return table;
}

}  // namespace tessera::detail
