// The files of the gallery: gallery.txt, scenes, and models that scenes read. embed_gallery.cmake generates
// the source from engine/program/gallery.
#pragma once

#include <span>
#include <string_view>

namespace tessera::program::cli {

struct GalleryFile {
  std::string_view name;
  const char* content;  ///< too long for the compiler to measure, as std::string_view does
};

extern const std::span<const GalleryFile> kGalleryFiles;

}  // namespace tessera::program::cli
