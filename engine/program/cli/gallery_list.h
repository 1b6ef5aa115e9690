// The pictures of the gallery, as gallery.txt lists them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::program::cli {

struct GalleryPicture {
  std::string name;                  ///< NAME.json is its scene, NAME.png the picture
  std::string group;                 ///< heading of the pictures around it
  std::string text;                  ///< the title of the scene: what the picture shows
  std::vector<std::string> options;  ///< options of the `tessera render` that draws it
  std::vector<std::string> inputs;   ///< other files that the scene reads

  std::string scene_file() const { return name + ".json"; }
  std::string picture_file() const { return name + ".png"; }
  /// Scene, picture and inputs.
  std::vector<std::string> files() const;
  /// The command that draws the picture, in the folder of its scene.
  std::string command() const;
};

/// All pictures, in the order of gallery.txt.
const std::vector<GalleryPicture>& gallery_pictures();

/// Content of a scene or another input.
/// @param file  must exist
std::string_view gallery_content(std::string_view file);

/// Returns the error for a name that no picture has, with the names near it; empty for a picture's name.
std::string error_of_gallery_name(const std::string& name);

/// A line for each picture: its name and what it shows.
std::string gallery_list_text();

}  // namespace tessera::program::cli
