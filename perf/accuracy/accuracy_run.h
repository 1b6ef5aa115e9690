// A run of `tessera accuracy`.
#pragma once

#include <string>
#include <vector>

#include "perf/accuracy/accuracy_options.h"

namespace tessera::accuracy {

/// Measures errors, then times in separate processes, and writes all files. Shows progress on stderr.
/// @param arguments  of the command line, for the timing processes
/// @return a summary for the standard output
/// @throws Error for scenes that cannot be measured and files that cannot be written; Cancelled after Ctrl-C:
///     nothing is written then
std::string run_accuracy(const AccuracyOptions& options, const std::vector<std::string>& arguments);

/// Measures the rounds of one process and writes them to stdout. Returns false after Ctrl-C, which the
/// program that started this process reports.
bool run_timing(const AccuracyOptions& options);

}  // namespace tessera::accuracy
