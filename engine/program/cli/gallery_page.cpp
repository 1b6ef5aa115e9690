#include "engine/program/cli/gallery_page.h"

#include <string_view>

#include "engine/program/cli/formatted.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

constexpr std::string_view kMark = "<meta name=\"generator\" content=\"tessera gallery\">";

constexpr std::string_view kStyle = R"(
body { margin: 0 auto; max-width: 100rem; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif; }
body { background: #1b1d21; color: #dcdcdc; }
a { color: #8ab8ff; }
h2 { margin: 2.5rem 0 1rem; font-weight: 600; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); gap: 1.75rem 1.25rem; }
h2 { grid-column: 1 / -1; }
figure { margin: 0; }
figure img { display: block; width: 100%; background: #000; }
figcaption { padding-top: .5rem; }
code { display: block; overflow-wrap: anywhere; color: #a0a8b0; font-size: .8rem; }
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else if (c == '"') result += "&quot;";
    else result += c;
  }
  return result;
}

std::string link(const std::string& file) {
  return "<a href=\"" + escaped(file) + "\">" + escaped(file) + "</a>";
}

std::string figure(const ShownGalleryPicture& shown) {
  const GalleryPicture& picture = *shown.picture;
  const std::string file = escaped(picture.picture_file());
  std::string text = "<figure id=\"" + picture.name + "\">\n<a href=\"" + file + "\"><img src=\"" + file +
                     "\" alt=\"" + escaped(picture.text) + "\" loading=\"lazy\"";
  if (shown.aspect) text += formatted(" style=\"aspect-ratio: %.4f\"", *shown.aspect);
  text += "></a>\n";
  text += "<figcaption>" + escaped(picture.text) + " (" + link(picture.scene_file());
  for (const std::string& input : picture.inputs) text += ", " + link(input);
  return text + ")\n<code>" + escaped(picture.command()) + "</code></figcaption>\n</figure>\n";
}

}  // namespace

std::string gallery_page(std::span<const ShownGalleryPicture> pictures) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + std::string(kMark) +
      "\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>Tessera: gallery</title>\n"
      "<style>" +
      std::string(kStyle) + "</style>\n</head>\n<body>\n<h1>Tessera " + escaped(version()) +
      ": gallery</h1>\n<p>Each picture is drawn from the scene file next to it by the command "
      "below it. All on one sheet: " +
      link("index.png") + ".</p>\n<main>\n";
  std::string_view group;
  for (const ShownGalleryPicture& shown : pictures) {
    if (shown.picture->group != group) text += "<h2>" + escaped(shown.picture->group) + "</h2>\n";
    group = shown.picture->group;
    text += figure(shown);
  }
  return text + "</main>\n</body>\n</html>\n";
}

std::set<std::string> files_of_page(const std::string& page) {
  constexpr std::string_view kLink = "href=\"";
  if (page.find(kMark) == std::string::npos) return {};
  std::set<std::string> files{"index.html"};
  for (std::size_t at = page.find(kLink); at != std::string::npos; at = page.find(kLink, at)) {
    at += kLink.size();
    files.insert(page.substr(at, page.find('"', at) - at));
  }
  return files;
}

}  // namespace tessera::program::cli
