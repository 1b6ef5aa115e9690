// index.html of a gallery: a page without scripts that refers to nothing beyond its folder.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>

#include "engine/program/cli/gallery_list.h"

namespace tessera::program::cli {

struct ShownGalleryPicture {
  const GalleryPicture* picture;
  std::optional<double> aspect;  ///< width to height on the screen; none: the picture has square pixels
};

/// The page, with pictures, texts, commands, and links to the pictures' files.
std::string gallery_page(std::span<const ShownGalleryPicture> pictures);

/// Files that a page links, itself and the contact sheet included: the files that the command may replace.
/// @param page  content of an index.html; empty result if gallery_page() did not write it
std::set<std::string> files_of_page(const std::string& page);

}  // namespace tessera::program::cli
