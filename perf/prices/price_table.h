// Price lists as text.
#pragma once

#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::bench {

/// The lines above the prices: machine, and headings of the columns.
std::string price_table_heading(const PriceList& list);
/// "pixel_spot   4.10 (4.02 .. 4.18)   shaded pixel"
std::string price_line(const PriceList& list, PriceItem item);

}  // namespace tessera::bench
