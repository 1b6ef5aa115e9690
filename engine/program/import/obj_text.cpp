#include "engine/program/import/obj_text.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

namespace tessera::program {
namespace {

constexpr std::string_view kSpaces = " \t";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
  return text.substr(0, text.find_last_not_of(kSpaces) + 1);
}

/// Calls edit(keyword, arguments) -> std::string for each logical line; an empty result keeps the line.
template <class Edit>
std::string edit_lines(std::string_view text, const Edit& edit) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::string result;
  result.reserve(text.size() + 1);
  while (!text.empty()) {
    std::string line;
    std::string skipped_ends;
    for (bool continued = true; continued && !text.empty();) {
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      const std::size_t next = std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size());
      line += text.substr(0, end);
      text.remove_prefix(next);
      continued = line.ends_with('\\');
      if (continued) {
        line.back() = ' ';
        skipped_ends += '\n';
      }
    }
    const std::string_view whole = trimmed(line);
    const std::string_view keyword = whole.substr(0, whole.find_first_of(kSpaces));
    const std::string edited = edit(keyword, trimmed(whole.substr(keyword.size())));
    result += edited.empty() ? line : edited;
    result += '\n' + skipped_ends;
  }
  return result;
}

/// Returns "keyword name" with kSpaceInName inside the name.
std::string line_with_name(std::string_view keyword, std::string_view name) {
  std::string line = std::string(keyword) + " " + std::string(name);
  std::replace(line.begin() + static_cast<std::ptrdiff_t>(keyword.size()) + 1, line.end(), ' ', kSpaceInName);
  return line;
}

/// Accepts "2.0" as well, and ignores text after a space.
bool begins_with_int(std::string_view text) {
  text = text.substr(0, text.find_first_of(kSpaces));
  if (text.starts_with('+')) text.remove_prefix(1);
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  const bool has_fraction = rest.starts_with('.') && rest.find_first_not_of("0123456789", 1) == rest.npos;
  return error == std::errc{} && (rest.empty() || has_fraction);
}

}  // namespace

std::string normalized_obj(const std::string& text) {
  return edit_lines(text, [](std::string_view keyword, std::string_view arguments) -> std::string {
    if (keyword == "vw" || keyword == "l" || keyword == "p" || keyword == "t") return "#";
    if (keyword == "usemtl" && arguments.find(' ') != arguments.npos)
      return line_with_name(keyword, arguments);
    if (keyword == "mtllib" && arguments.find_first_of(" \\") != arguments.npos) {
      std::string line = line_with_name(keyword, arguments);
      std::replace(line.begin(), line.end(), '\\', kBackslashInName);
      return line;
    }
    return {};
  });
}

std::string normalized_mtl(const std::string& text, const std::string& path,
                           std::vector<std::string>& warnings) {
  std::string material;
  return edit_lines(text, [&](std::string_view keyword, std::string_view arguments) -> std::string {
    if (keyword == "newmtl") {
      material = arguments;
      return line_with_name(keyword, arguments);
    }
    if (keyword == "illum" && !begins_with_int(arguments)) {
      warnings.push_back(path + ": illum of material \"" + material + "\" is left out: found \"" +
                         std::string(arguments.substr(0, 40)) + "\", expected an integer");
      return "#";
    }
    if (keyword != "Ka" && keyword != "Kd" && keyword != "Ks" && keyword != "Ke") return {};
    if (arguments.starts_with("spectral") || arguments.starts_with("xyz")) {
      warnings.push_back(path + ": " + std::string(keyword) + " of material \"" + material +
                         "\" is left out: only R G B is read");
      return "#";
    }
    const bool is_gray = !arguments.empty() && arguments.find_first_of(" \t#") == arguments.npos;
    const std::string number(arguments);
    return is_gray ? std::string(keyword) + " " + number + " " + number + " " + number : std::string();
  });
}

std::string with_spaces(std::string name) {
  std::replace(name.begin(), name.end(), kSpaceInName, ' ');
  return name;
}

std::array<std::string, 2> possible_paths(std::string name) {
  name = with_spaces(std::move(name));
  std::string with_slashes;
  std::string unescaped;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool before_space = name[i] == kBackslashInName && name[i + 1] == ' ';
    if (!before_space) with_slashes += name[i] == kBackslashInName ? '/' : name[i];
  }
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == kBackslashInName && i + 1 < name.size()) ++i;
    unescaped += name[i] == kBackslashInName ? '\\' : name[i];
  }
  return {with_slashes, unescaped};
}

}  // namespace tessera::program
