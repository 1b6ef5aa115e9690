// Functions that carry bytes from one place to another.
#pragma once

#include <cstddef>
#include <functional>

namespace tessera::program {

using ByteWriter = std::function<void(const char* bytes, std::size_t count)>;
/// Fills all of `to`, or throws.
using ByteReader = std::function<void(char* to, std::size_t count)>;
/// Reports the share of the work that is done, 0 .. 1; empty: not reported.
using ReportProgress = std::function<void(double done)>;

/// Progress of a part of the work, which lies between two shares of the whole.
inline ReportProgress part_of(const ReportProgress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double done) { whole(from + (to - from) * done); };
}

}  // namespace tessera::program
