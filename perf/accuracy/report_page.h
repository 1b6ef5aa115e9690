// report.html: one file that opens from disk without network.
#pragma once

#include <functional>
#include <string>

#include "perf/accuracy/results.h"

namespace tessera::accuracy {

/// The page with its scripts, the rows of results.csv and all pictures.
/// - Pictures are PNG data URIs. Those that are smaller as a difference from the default's picture, modulo
/// 256, are
///   stored as such, which is exact.
/// - Without scripts the table and the notes remain.
/// @param progress  called with the done share, 0 to 1; false cancels
/// @throws Cancelled if `progress` returns false
std::string report_page(const RunResult& run, int threads, const std::function<bool(double)>& progress);

}  // namespace tessera::accuracy
