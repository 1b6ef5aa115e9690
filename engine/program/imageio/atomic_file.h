// Writes files as a whole: to a temporary file in the same folder, which is then renamed. A failure leaves
// the old file as it was.
#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tessera::program {

/// A file that appears when it is complete. Without commit() nothing is left behind.
/// - Devices, pipes and open files (/dev/stdout) are written to directly.
/// - Errors name the path and the reason.
class AtomicFile {
 public:
  /// @throws Error if the file cannot be written
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @throws Error
  void write(std::string_view content);
  /// Closes the file and gives it its name.
  /// @throws Error
  void commit();

 private:
  std::string path_;
  std::optional<std::filesystem::path> target_;  ///< file that is replaced or created
  std::filesystem::path temporary_;              ///< empty: written to directly
  std::FILE* file_ = nullptr;
};

/// Replaces or creates a file.
/// - A symbolic link stays; the file it leads to is replaced, with default permissions.
/// - Devices, pipes and open files (/dev/stdout) are written to directly.
/// @throws Error, naming the path and the reason
void write_file_atomically(const std::string& path, std::string_view content);

/// Checks, before expensive work, that write_file_atomically() can succeed. Creates nothing.
/// @return the canonical path of the file that would be replaced or created; nothing if the path would be
///   written to directly
/// @throws Error for a folder, a missing folder or missing permission
std::optional<std::filesystem::path> require_writable(const std::string& path);

}  // namespace tessera::program
