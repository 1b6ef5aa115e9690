// The module libtessera_imageio, loaded on first need.
#pragma once

#include <string>

#include "engine/imageio/module_interface.h"
#include "engine/imageio/picture.h"

namespace tessera {

class ImageModule {
 public:
  explicit ImageModule(tessera_imageio_write_function* function) : write_(function) {}
  /// @param shown_path  the path in messages
  /// @throws Error
  void write(const Picture& picture, const std::string& path, const std::string& shown_path) const;

 private:
  tessera_imageio_write_function* write_;
};

/// Looks beside the running program, in ../lib from there, then where the system looks for libraries. Stays loaded.
/// @param path  the file that needs it, for the message
/// @throws Error, naming the module, if it is not there.
const ImageModule& image_module(const std::string& path);

}  // namespace tessera
