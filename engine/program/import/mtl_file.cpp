#include "engine/program/import/mtl_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <utility>

#include "engine/program/import/obj_line.h"

namespace tessera::program {
namespace {

std::string lower_case_keyword(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// Accepts "2.0" as well, and ignores text after a space.
std::optional<int> integer_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const std::string_view rest = word.substr(static_cast<std::size_t>(end - word.data()));
  const bool has_fraction = rest.starts_with('.') && rest.find_first_not_of("0123456789", 1) == rest.npos;
  if (error != std::errc{} || !(rest.empty() || has_fraction)) return std::nullopt;
  return number;
}

class MtlParser {
 public:
  std::vector<MtlMaterial> materials;

  MtlParser(const std::string& file, std::vector<std::string>& warnings) : file_(file), warnings_(warnings) {}

  void read(ObjLine& line) {
    const std::string keyword = lower_case_keyword(line.keyword());
    MtlMaterial unnamed;  // lines before the first newmtl are checked, but of no effect
    MtlMaterial& material = materials.empty() ? unnamed : materials.back();
    if (keyword == "newmtl") materials.emplace_back().name = line.rest();
    else if (keyword == "ka") read_color(line, material.name, material.ambient);
    else if (keyword == "kd") read_color(line, material.name, material.diffuse);
    else if (keyword == "ks") read_color(line, material.name, material.specular);
    else if (keyword == "ke") read_color(line, material.name, material.emission);
    else if (keyword == "ns") material.shininess = static_cast<float>(line.number());
    else if (keyword == "d") material.opacity = opacity(line);
    else if (keyword == "tr") material.transparency = unit_number(line);
    else if (keyword == "illum") read_illum(line, material);
    else if (keyword == "map_kd") material.diffuse_map = map(line);
    else if (keyword == "map_d") material.opacity_map = map(line);
  }

 private:
  void leave_out(const ObjLine& line, const std::string& material, const std::string& reason) {
    warnings_.push_back(file_ + ": " + std::string(line.keyword()) + " of material \"" + material +
                        "\" is left out: " + reason);
  }

  static bool has_one_word(ObjLine line) { return !line.word().empty() && line.word().empty(); }

  void read_color(ObjLine& line, const std::string& material, std::optional<Rgb>& color) {
    if (line.rest().starts_with("spectral") || line.rest().starts_with("xyz"))
      return leave_out(line, material, "only R G B is read");
    if (has_one_word(line)) {
      const auto gray = static_cast<float>(line.number());
      color = Rgb{gray, gray, gray};
      return;
    }
    const std::array<double, 3> rgb = line.three_numbers();
    color = Rgb{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
  }

  static float unit_number(ObjLine& line) {
    return std::clamp(static_cast<float>(line.number()), 0.0f, 1.0f);
  }

  static float opacity(ObjLine& line) {
    if (line.rest().starts_with("-halo")) line.word();
    return unit_number(line);
  }

  void read_illum(ObjLine& line, MtlMaterial& material) {
    const std::string found(line.rest().substr(0, 40));
    material.illum = integer_of(line.word());
    if (!material.illum) leave_out(line, material.name, "found \"" + found + "\", expected an integer");
  }

  /// Options and the name of an image, which may hold spaces.
  static MtlMap map(ObjLine& line) {
    // Words after each option; -s, -o and -t have up to three numbers.
    static const std::map<std::string, int, std::less<>> kIgnored{
        {"-blendu", 1},  {"-blendv", 1}, {"-bm", 1},     {"-boost", 1}, {"-cc", 1},
        {"-imfchan", 1}, {"-mm", 2},     {"-texres", 1}, {"-type", 1}};
    MtlMap map;
    for (;;) {
      ObjLine after = line;
      const std::string_view option = after.word();
      if (option == "-s") {
        read_vector(after, 1, map.scale);
      } else if (option == "-o") {
        read_vector(after, 0, map.offset);
      } else if (option == "-t") {
        std::array<float, 2> ignored{};
        read_vector(after, 0, ignored);
      } else if (option == "-clamp") {
        map.is_clamped = after.word() == "on";
      } else if (const auto ignored = kIgnored.find(option); ignored != kIgnored.end()) {
        for (int i = 0; i < ignored->second; ++i) after.word();
      } else {
        map.image = line.rest();
        return map;
      }
      line = after;
    }
  }

  /// Up to three numbers, of which the third is for textures with depth. The name of the image remains.
  static void read_vector(ObjLine& line, float missing, std::array<float, 2>& vector) {
    vector = {missing, missing};
    for (std::size_t k = 0; k < 3; ++k) {
      ObjLine after = line;
      const std::optional<double> number = after.find_number();
      if (!number || after.rest().empty()) return;
      if (k < 2) vector[k] = static_cast<float>(*number);
      line = after;
    }
  }

  const std::string& file_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& file,
                                   std::vector<std::string>& warnings) {
  MtlParser parser(file, warnings);
  for_each_obj_line(text, file, [&](ObjLine& line, std::size_t) { parser.read(line); });
  return std::move(parser.materials);
}

}  // namespace tessera::program
