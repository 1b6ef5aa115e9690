#include "engine/program/cli/parse_overrides.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <vector>

#include "engine/program/cli/printable.h"

namespace tessera::program::cli {

std::vector<double> parse_numbers(const std::string& text, std::size_t min_count, std::size_t max_count) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    double number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (error != std::errc{} || end != part.data() + part.size() || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  if (text.ends_with(',')) return {};
  return numbers.size() >= min_count && numbers.size() <= max_count ? numbers : std::vector<double>{};
}

namespace {

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw Error("found " + found + ", expected " + expected);
}

int parse_side(const std::string& digits, const std::string& text) {
  const bool is_number =
      !digits.empty() && digits.size() <= 5 && digits.find_first_not_of("0123456789") == std::string::npos;
  const int side = is_number ? std::stoi(digits) : 0;
  if (side < 1 || side > kMaxFrameBufferSize)
    refuse(cli::quoted(text), "WIDTHxHEIGHT, each 1 to " + std::to_string(kMaxFrameBufferSize));
  return side;
}

/// The first `count` of the comma-separated parts of a text, from part `first` on.
std::string parts(const std::string& text, std::size_t first, std::size_t count) {
  std::istringstream stream(text);
  std::string list, part;
  for (std::size_t i = 0; i < first + count && std::getline(stream, part, ','); ++i)
    if (i >= first) list += (list.empty() ? "" : ",") + part;
  return list;
}

}  // namespace

void parse_size(const std::string& text, SceneOverrides& overrides) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  overrides.width = parse_side(text.substr(0, cross), text);
  overrides.height = parse_side(text.substr(std::min(cross + 1, text.size())), text);
}

void parse_camera(const std::string& text, SceneOverrides& overrides) {
  const std::vector<double> n = parse_numbers(text, 6, 7);
  if (n.empty())
    refuse(cli::quoted(text), "EX,EY,EZ,TX,TY,TZ[,FOVY]: eye, target, vertical angle in degrees");
  const double distance = std::hypot(n[0] - n[3], n[1] - n[4], n[2] - n[5]);
  if (distance == 0) refuse("eye and target both at " + parts(text, 0, 3), "two different points");
  if (!std::isfinite(distance * 100))
    refuse("eye and target in " + cli::quoted(text), "points that are less far apart");
  Lens lens;
  if (n.size() == 7) lens.fovy = n[6];
  if (!(lens.fovy > 0 && lens.fovy < 180))
    refuse("the vertical angle " + parts(text, 6, 1), "an angle above 0 and below 180 degrees");
  lens.near = distance / 100;
  lens.far = distance * 100;
  const bool along_y = n[0] == n[3] && n[2] == n[5];
  overrides.camera = camera_at({.eye = {n[0], n[1], n[2]},
                                .target = {n[3], n[4], n[5]},
                                .up = along_y ? Vec3{0, 0, -1} : Vec3{0, 1, 0}},
                               lens);
}

void parse_light(const std::string& text, SceneOverrides& overrides) {
  const std::vector<double> n = parse_numbers(text, 3, 4);
  if (n.empty()) refuse(cli::quoted(text), "X,Y,Z[,W]: a position, or with W = 0 a direction");
  const bool is_direction = n.size() == 4 && n[3] == 0;
  if (is_direction && n[0] == 0 && n[1] == 0 && n[2] == 0)
    refuse("the direction " + parts(text, 0, 3), "a direction with a length");
  const auto is_float = [](double value) { return std::abs(value) <= std::numeric_limits<float>::max(); };
  if (!std::ranges::all_of(n, is_float)) refuse(cli::quoted(text), "numbers up to 3.4e38");
  overrides.lights.push_back(
      Light{.position = {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]),
                         n.size() == 4 ? static_cast<float>(n[3]) : 1.0f}});
}

void parse_background(const std::string& text, SceneOverrides& overrides) {
  const char* const forms = "none, #RRGGBB, or R,G,B, each 0 to 1";
  if (text == "none") {
    overrides.background = Color{0, 0, 0, 0};
    return;
  }
  if (text.size() == 7 && text[0] == '#') {
    std::uint32_t rgb = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
    if (error != std::errc{} || end != text.data() + 7) refuse(cli::quoted(text), forms);
    const auto component = [&](int shift) { return static_cast<float>(rgb >> shift & 255) / 255; };
    overrides.background = Color{component(16), component(8), component(0), 1};
    return;
  }
  const std::vector<double> n = parse_numbers(text, 3, 3);
  if (n.empty() || std::ranges::any_of(n, [](double x) { return x < 0 || x > 1; }))
    refuse(cli::quoted(text), forms);
  overrides.background =
      Color{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]), 1};
}

}  // namespace tessera::program::cli
