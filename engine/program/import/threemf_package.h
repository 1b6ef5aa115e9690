// The ZIP archive that a 3MF file is.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tessera::program::threemf {

/// Returns the bytes of a part of a package, such as "/3D/3dmodel.model"; empty: there is no such part.
using ReadPart = std::function<std::optional<std::string>(const std::string& name)>;

/// A package in a file. Archives beyond 4 GiB (zip64) are read.
class Package {
 public:
  /// @throws Error for a file that is not a ZIP archive
  explicit Package(const std::string& path);

  /// Letters of the name match in both cases, as the Open Packaging Conventions say.
  /// @throws Error for a part that is damaged, encrypted or compressed by an unknown method
  std::optional<std::string> read(const std::string& name) const;

 private:
  struct Close {
    void operator()(void* archive) const;
  };
  std::unique_ptr<void, Close> archive_;
};

/// Returns the name of the part that holds the 3D model: the target of the package's relationship of that
/// type. Other relationships, such as those of thumbnails, are passed over.
/// @throws Error if there is none
std::string model_part_name(const ReadPart& read);

}  // namespace tessera::program::threemf
