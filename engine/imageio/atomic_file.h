// Files that appear as a whole: written under another name in the same folder, then renamed. A failure leaves what was there.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace tessera {

/// @throws Error, naming the path and the reason.
void write_file_atomically(const std::string& path, std::string_view content);

/// Calls write(temporary path) with the same ending as `path`, and puts the result in the place of `path`. A path that is a
/// device or a pipe is handed to write() as it is.
void replace_file_atomically(const std::string& path, const std::function<void(const std::string&)>& write);

}  // namespace tessera
