// Reads whole files.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

namespace tessera::program {

/// @throws Error, naming the file and the reason, if it is missing, a folder, unreadable, or larger than
///   `max_bytes`
std::string read_text_file(const std::string& path,
                           std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

/// For files that another file names. Files on the command line may be pipes.
/// @throws Error for devices and pipes, which may be endless
void refuse_device_or_pipe(const std::string& path);

}  // namespace tessera::program
