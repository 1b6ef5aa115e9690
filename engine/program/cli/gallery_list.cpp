#include "engine/program/cli/gallery_list.h"

#include <algorithm>
#include <sstream>

#include "engine/program/cli/gallery_files.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/words.h"
#include "engine/program/scene/json_value.h"
#include "engine/program/scene/suggest.h"

namespace tessera::program::cli {
namespace {

constexpr std::size_t kMaxNearNames = 8;

std::string title_of(const std::string& scene_file) {
  const json::Json scene = json::parse(gallery_content(scene_file), scene_file);
  return scene.at("title").get<std::string>();
}

/// Reads gallery.txt, whose first lines describe its format.
std::vector<GalleryPicture> read_list() {
  std::vector<GalleryPicture> pictures;
  std::string group;
  std::istringstream list{std::string(gallery_content("gallery.txt"))};
  for (std::string line; std::getline(list, line);) {
    std::vector<std::string> words = words_of(line);
    if (words.empty() || words.front() == "#") continue;
    if (words.front() == "==") {
      group = line.substr(3);
    } else if (words.front() == "+") {
      pictures.back().inputs.insert(pictures.back().inputs.end(), words.begin() + 1, words.end());
    } else {
      GalleryPicture picture{.name = words.front(), .group = group, .text = {}, .options = {}, .inputs = {}};
      picture.text = title_of(picture.scene_file());
      picture.options.assign(words.begin() + 1, words.end());
      pictures.push_back(std::move(picture));
    }
  }
  return pictures;
}

/// Names that contain the typed one, else those that begin with its first word, else the most similar one.
std::vector<std::string> near_names(const std::string& typed) {
  std::vector<std::string> near;
  std::vector<std::string_view> all;
  for (const GalleryPicture& picture : gallery_pictures()) {
    all.push_back(picture.name);
    if (picture.name.find(typed) != std::string::npos) near.push_back(picture.name);
  }
  const std::string first_word = typed.substr(0, typed.find_first_of("_-. "));
  if (near.empty() && first_word.size() > 2)
    for (const std::string_view name : all)
      if (name.starts_with(first_word)) near.emplace_back(name);
  const std::string_view similar = nearest_name(typed, all);
  if (!similar.empty() && std::ranges::find(near, similar) == near.end()) near.emplace(near.begin(), similar);
  near.resize(std::min(near.size(), kMaxNearNames));
  return near;
}

}  // namespace

std::vector<std::string> GalleryPicture::files() const {
  std::vector<std::string> files{scene_file(), picture_file()};
  files.insert(files.end(), inputs.begin(), inputs.end());
  return files;
}

std::string GalleryPicture::command() const {
  std::string line = "tessera render " + scene_file() + " -o " + picture_file();
  for (const std::string& option : options) line += " " + option;
  return line;
}

const std::vector<GalleryPicture>& gallery_pictures() {
  static const std::vector<GalleryPicture> pictures = read_list();
  return pictures;
}

std::string_view gallery_content(std::string_view file) {
  const auto found = std::ranges::find(kGalleryFiles, file, &GalleryFile::name);
  if (found == kGalleryFiles.end())
    throw Error(ErrorCode::internal, "the gallery lacks its file " + cli::quoted(file));
  return found->content;
}

std::string error_of_gallery_name(const std::string& name) {
  if (std::ranges::find(gallery_pictures(), name, &GalleryPicture::name) != gallery_pictures().end())
    return "";
  std::string text;
  for (const std::string& near : near_names(name)) text += (text.empty() ? "; near it: " : ", ") + near;
  return "found " + cli::quoted(name) + ", expected a picture of the gallery" + text +
         "; tessera gallery --list names all";
}

std::string gallery_list_text() {
  std::size_t width = 0;
  for (const GalleryPicture& picture : gallery_pictures()) width = std::max(width, picture.name.size());
  std::string text;
  for (const GalleryPicture& picture : gallery_pictures())
    text += picture.name + std::string(width + 2 - picture.name.size(), ' ') + picture.text + "\n";
  return text;
}

}  // namespace tessera::program::cli
