// Files that appear as a whole: written under another name in the same folder, then renamed. A failure leaves what was there.
#pragma once

#include <string>
#include <string_view>

namespace tessera {

/// A link stays one: what it points to is replaced. A device or a pipe is written to as it is.
/// @throws Error, naming the path and the reason.
void write_file_atomically(const std::string& path, std::string_view content);

}  // namespace tessera
