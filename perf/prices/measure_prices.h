// Measures prices: each from a pair of frames, drawn in turns on one thread.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::bench {

/// All items whose code is one of these names or starts with it, in the order of PriceItem; all for no names.
/// @throws CLI::ValidationError  if a name selects nothing
std::vector<PriceItem> select_prices(const std::vector<std::string>& names);

/// Progress of measure_prices(): pairs that were measured, of this number.
using PriceProgress = std::function<void(std::size_t measured, std::size_t pairs)>;

/// Measures the prices of these items and of the items that they are measured against.
/// - All pairs are measured in each of several passes, so that a clock that changes affects all of them
/// alike.
/// - A pair is drawn in blocks of two frames, in random order. A price is the median of the differences
/// within
///   the blocks.
///
/// @param list     receives the prices; the others stay
/// @param seconds  per pair
/// @return  the measured items, in the order of PriceItem
/// @throws Error  if a picture is wrong or a frame cannot be drawn
std::vector<PriceItem> measure_prices(PriceList& list, const std::vector<PriceItem>& items,
                                      InstructionSet instruction_set, double seconds,
                                      const PriceProgress& progress);

}  // namespace tessera::bench
