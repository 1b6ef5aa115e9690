#include "engine/program/cli/parse_overrides.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

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

bool parse_size(const std::string& text, SceneOverrides& overrides) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return false;
  const auto parse = [](const std::string& digits, std::optional<int>& size) {
    const bool is_number =
        !digits.empty() && digits.size() <= 5 && digits.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) size = std::stoi(digits);
    return is_number && *size >= 1 && *size <= kMaxFrameBufferSize;
  };
  return parse(text.substr(0, cross), overrides.width) && parse(text.substr(cross + 1), overrides.height);
}

bool parse_camera(const std::string& text, SceneOverrides& overrides) {
  const std::vector<double> n = parse_numbers(text, 6, 7);
  if (n.empty()) return false;
  const double distance = std::hypot(n[0] - n[3], n[1] - n[4], n[2] - n[5]);
  Lens lens;
  if (n.size() == 7) lens.fovy = n[6];
  lens.near = distance / 100;
  lens.far = distance * 100;
  if (!(lens.fovy > 0 && lens.fovy < 180) || distance == 0) return false;
  const bool along_y = n[0] == n[3] && n[2] == n[5];
  overrides.camera = camera_at({.eye = {n[0], n[1], n[2]},
                                .target = {n[3], n[4], n[5]},
                                .up = along_y ? Vec3{0, 0, -1} : Vec3{0, 1, 0}},
                               lens);
  return true;
}

bool parse_light(const std::string& text, SceneOverrides& overrides) {
  const std::vector<double> n = parse_numbers(text, 3, 4);
  if (n.empty()) return false;
  overrides.lights.push_back(
      Light{.position = {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]),
                         n.size() == 4 ? static_cast<float>(n[3]) : 1.0f}});
  return true;
}

bool parse_background(const std::string& text, SceneOverrides& overrides) {
  if (text == "none") {
    overrides.background = Color{0, 0, 0, 0};
    return true;
  }
  if (text.size() == 7 && text[0] == '#') {
    std::uint32_t rgb = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
    if (error != std::errc{} || end != text.data() + 7) return false;
    const auto component = [&](int shift) { return static_cast<float>(rgb >> shift & 255) / 255; };
    overrides.background = Color{component(16), component(8), component(0), 1};
    return true;
  }
  const std::vector<double> n = parse_numbers(text, 3, 3);
  if (n.empty() || std::ranges::any_of(n, [](double x) { return x < 0 || x > 1; })) return false;
  overrides.background =
      Color{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]), 1};
  return true;
}

}  // namespace tessera::program::cli
