#include "engine/program/import/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "engine/program/import/number_text.h"

namespace tessera::program {
namespace {

constexpr std::size_t kMaxElements = 1000, kMaxProperties = 1000;

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName kTypeNames[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

/// Takes the words of a line in order.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    const std::size_t begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
    const std::size_t end = std::min(rest_.find_first_of(" \t", begin), rest_.size());
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
  }
  std::string_view rest() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size()));
    return rest_;
  }

 private:
  std::string_view rest_;
};

class HeaderReader {
 public:
  explicit HeaderReader(ModelFile& file) : file_(file) {}

  PlyHeader read() {
    if (file_.rest_of_line() != "ply")
      file_.fail_at_line("not a PLY file: expected \"ply\" in the first line");
    for (;;) {
      if (file_.remaining() == 0) file_.fail_at_line("the header ends without \"end_header\"");
      Words words(file_.rest_of_line());
      const std::string_view keyword = words.next();
      if (keyword == "end_header") break;
      read_line(keyword, words);
    }
    if (!has_format_) file_.fail_at_line("the header has no line \"format\"");
    return std::move(header_);
  }

 private:
  void read_line(std::string_view keyword, Words& words) {
    if (keyword == "format") read_format(words.next());
    else if (keyword == "element") read_element(words);
    else if (keyword == "property") read_property(words);
    else if (keyword == "comment") read_comment(words);
    else if (!keyword.empty() && keyword != "obj_info" && header_.warnings.empty())
      header_.warnings.push_back("line " + std::to_string(file_.line()) +
                                 " of the header is left out: it begins with " + quoted(keyword));
  }

  void read_format(std::string_view name) {
    constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto found = std::ranges::find(kNames, name);
    if (found == std::end(kNames))
      file_.fail_at_line("found format \"" + std::string(name.substr(0, 40)) +
                         "\", expected ascii, binary_little_endian or binary_big_endian");
    header_.format = static_cast<PlyFormat>(found - std::begin(kNames));
    has_format_ = true;
  }

  void read_element(Words& words) {
    PlyElement element{.name = std::string(words.next())};
    const std::string_view count = words.next();
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size())
      file_.fail_at_line("found \"" + std::string(count.substr(0, 40)) +
                         "\", expected the number of elements \"" + element.name.substr(0, 40) + "\"");
    if (header_.elements.size() == kMaxElements)
      file_.fail_at_line("more than " + std::to_string(kMaxElements) + " kinds of elements");
    header_.elements.push_back(std::move(element));
  }

  void read_property(Words& words) {
    if (header_.elements.empty()) file_.fail_at_line("found a property before the first element");
    PlyElement& element = header_.elements.back();
    if (element.properties.size() == kMaxProperties)
      file_.fail_at_line("more than " + std::to_string(kMaxProperties) + " properties of an element");
    std::string_view type = words.next();
    PlyProperty property{.is_list = type == "list"};
    if (property.is_list) {
      property.count_type = type_of(words.next());
      if (!is_integer(property.count_type)) file_.fail_at_line("the length of a list must be an integer");
      type = words.next();
    }
    property.type = type_of(type);
    property.name = std::string(words.rest());
    element.properties.push_back(std::move(property));
  }

  PlyType type_of(std::string_view name) const {
    const auto* const found = std::ranges::find(kTypeNames, name, &TypeName::name);
    if (found == std::end(kTypeNames))
      file_.fail_at_line("found type \"" + std::string(name.substr(0, 40)) +
                         "\", expected char, uchar, short, ushort, int, uint, float or double");
    return found->type;
  }

  /// MeshLab and photogrammetry programs name the texture in a comment.
  void read_comment(Words& words) {
    if (words.next() == "TextureFile" && header_.texture.empty()) header_.texture = std::string(words.rest());
  }

  ModelFile& file_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

int PlyElement::find(std::initializer_list<std::string_view> names, bool is_list) const {
  for (const std::string_view wanted : names)
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == wanted && properties[i].is_list == is_list) return static_cast<int>(i);
  return -1;
}

std::uint64_t PlyElement::min_bytes(PlyFormat format) const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties) {
    const PlyType type = property.is_list ? property.count_type : property.type;
    bytes += format == PlyFormat::ascii ? 2 : size_of(type);  // a digit and a space
  }
  return bytes;
}

PlyHeader read_ply_header(ModelFile& file) { return HeaderReader(file).read(); }

}  // namespace tessera::program
