// A whole file as text.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

namespace tessera::program {

/// @throws Error, naming the file and the reason, for one that is missing, is a folder, cannot be read, or
/// holds more than `max_bytes`.
std::string read_text_file(const std::string& path,
                           std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

/// @throws Error for a device or a pipe, which may have no end. For files that other files name: what people
/// type may be a pipe.
void refuse_device_or_pipe(const std::string& path);

}  // namespace tessera::program
