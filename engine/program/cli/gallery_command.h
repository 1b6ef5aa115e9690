// `tessera gallery`: draws pictures of the renderer's features from scenes that the program contains.
#pragma once

#include <string>
#include <vector>

namespace tessera::program::cli {

struct GalleryRequest {
  std::string folder;              ///< created if it does not exist
  std::vector<std::string> names;  ///< pictures to draw; empty: all
  bool list = false;               ///< prints the names in place of drawing
  int threads = 0;                 ///< 0: all cores
};

/// Writes NAME.json, NAME.png and the other inputs of each picture into the folder, a page index.html and a
/// contact sheet index.png; or prints the list of the pictures.
/// - Each picture is drawn by `tessera render`, with the options that the page shows.
/// - Pictures of an earlier run stay on the page and on the sheet.
/// - The page is written first, so that an interrupted run can be repeated.
/// @throws Error, before anything is written, for a file that exists and that no page of the gallery links
void gallery(const GalleryRequest& request);

}  // namespace tessera::program::cli
