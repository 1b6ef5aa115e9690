// Files that appear as a whole: written under another name in the same folder, then renamed. A failure leaves
// what was there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tessera::program {

/// A link stays one: what it points to is replaced, by a file with the usual permissions. A device, a pipe or
/// what is open elsewhere
/// (/dev/stdout) is written to as it is.
/// @throws Error, naming the path and the reason.
void write_file_atomically(const std::string& path, std::string_view content);

/// For who needs long to make the content. Nothing is made.
/// @return the file that would be replaced, by its one absolute name; nothing for what would be written to as
/// it is
/// @throws Error, as write_file_atomically() would before it writes: for a folder, a missing folder, a lack
/// of permission.
std::optional<std::filesystem::path> require_writable(const std::string& path);

}  // namespace tessera::program
