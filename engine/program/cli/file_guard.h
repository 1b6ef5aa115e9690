// What must not be replaced by the files that a run writes.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>

#include <sys/types.h>

namespace tessera::program::cli {

/// Keeps what a run reads, is known to refer to, or compares with; and where pictures got no name, everything
/// but Tessera's own ones, since importers do not understand every reference of every format. To be asked
/// before anything is rendered, and again before a file is written: what is at its path, or where its path
/// leads, may have changed in between. (What is kept are the files that were there when the guard was made.)
class FileGuard {
 public:
  /// @param reference  of --compare, or empty
  /// @param default_picture  the pictures' path where -o did not name it, with its {frame}; or empty
  FileGuard(const std::set<std::string>& inputs, const std::string& reference, std::string default_picture);

  /// @throws Error that names the file and a way out.
  void check_picture(const std::string& file) const;
  void check_plane(const std::string& file) const;

 private:
  /// What a file is, whichever path leads to it.
  using FileId = std::pair<dev_t, ino_t>;
  static std::optional<FileId> id_of(const std::string& path);
  void check(const std::string& file, const char* instead) const;

  std::set<FileId> inputs_;
  std::optional<FileId> reference_;
  std::string default_picture_;
};

}  // namespace tessera::program::cli
