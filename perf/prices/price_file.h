// Price lists as JSON, and their place in the user's cache folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::bench {

/// A list without prices for this machine and library.
PriceList empty_price_list(InstructionSet instruction_set);

/// Whether a list has this price. Lists may lack some.
bool is_measured(const Price& price);

/// The prices that were measured.
std::string price_json(const PriceList& list);
/// @throws Error  for text that is no price list, naming `source`
PriceList parse_prices(const std::string& text, const std::string& source);

/// File of a list: $XDG_CACHE_HOME/tessera/prices-PROCESSOR-SET-VERSION.json, in ~/.cache without that
/// variable (XDG Base Directory Specification 0.8). Empty if neither variable names a folder.
std::filesystem::path cached_price_file(const PriceList& list);
/// The cached list of this machine and library, if there is one.
/// @throws Error  for a file that is no price list
std::optional<PriceList> cached_prices(InstructionSet instruction_set);
/// Stores a list in the cache. Returns its file; empty if there is no cache folder.
/// @throws Error  if the file cannot be written
std::filesystem::path cache_prices(const PriceList& list);

}  // namespace tessera::bench
