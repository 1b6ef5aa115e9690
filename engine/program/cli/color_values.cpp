#include "engine/program/cli/color_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <system_error>

#include "engine/program/cli/formatted.h"
#include "engine/program/cli/printable.h"
#include "engine/tessera/types.hpp"

namespace tessera::program::cli {
namespace {

constexpr double kMaxMagnitude = 1e6;  // precondition of <tessera/color.hpp>
constexpr std::string_view kSeparators = " ,\t\r\n";

double parse_number(std::string_view text, const NamedColorSpace& space) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (is_number && std::abs(number) <= kMaxMagnitude) return number;
  const bool takes_hex = space.space.model == ColorModel::rgb;
  throw Error("found " + quoted(text) + ", expected a number from -1e6 to 1e6" +
              (takes_hex ? " or a colour as #RRGGBB" : ""));
}

ColorValues parse_hex(std::string_view text, const NamedColorSpace& space) {
  if (space.space.model != ColorModel::rgb)
    throw Error("found " + quoted(text) +
                ", but #RRGGBB is for spaces of R'G'B'; expected three numbers of " +
                std::string(space.name));
  std::uint32_t packed = 0;
  const char* const digits = text.data() + 1;
  const auto [end, error] = std::from_chars(digits, text.data() + text.size(), packed, 16);
  if (text.size() != 7 || error != std::errc() || end != text.data() + text.size())
    throw Error("found " + quoted(text) + ", expected # and six hexadecimal digits, as in #80ff00");
  return {(packed >> 16 & 255) / 255.0, (packed >> 8 & 255) / 255.0, (packed & 255) / 255.0};
}

/// Calls take(part) for the parts of `text` between separators.
template <class Take>
void for_each_part(std::string_view text, const Take& take) {
  for (std::size_t begin = 0; (begin = text.find_first_not_of(kSeparators, begin)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    take(text.substr(begin, end - begin));
    begin = end;
  }
}

/// Collects numbers and hexadecimal colours.
class ColorCollector {
 public:
  explicit ColorCollector(const NamedColorSpace& space) : space_(space) {}

  void add(std::string_view part) {
    if (part.starts_with('#')) {
      if (count_ > 0)
        throw Error("found " + quoted(part) + " after " + std::to_string(count_) +
                    (count_ == 1 ? " value" : " values") + " of a colour, expected 3 values per colour");
      colors_.push_back(parse_hex(part, space_));
      return;
    }
    pending_[count_++] = parse_number(part, space_);
    if (count_ < pending_.size()) return;
    colors_.push_back(pending_);
    count_ = 0;
  }
  std::vector<ColorValues> finish() const {
    if (count_ > 0)
      throw Error("found " + std::to_string(3 * colors_.size() + count_) +
                  (total_is_one() ? " value" : " values") + ", expected 3 values per colour (" +
                  std::string(space_.components[0].name) + " " + std::string(space_.components[1].name) +
                  " " + std::string(space_.components[2].name) + ")");
    return colors_;
  }

 private:
  bool total_is_one() const { return colors_.empty() && count_ == 1; }

  const NamedColorSpace& space_;
  std::vector<ColorValues> colors_;
  ColorValues pending_{};
  std::size_t count_ = 0;  ///< values in `pending_`
};

}  // namespace

std::vector<ColorValues> parse_colors(const std::vector<std::string>& words, const NamedColorSpace& space) {
  ColorCollector collector(space);
  for (const std::string& word : words)
    for_each_part(word, [&](std::string_view part) { collector.add(part); });
  return collector.finish();
}

std::vector<ColorValues> read_colors(std::istream& stream, const NamedColorSpace& space) {
  std::vector<ColorValues> colors;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string where = "standard input, line " + std::to_string(number) + ": ";
    try {
      const std::vector<ColorValues> found = parse_colors({line}, space);
      if (found.size() > 1)
        throw Error("found " + std::to_string(found.size()) + " colours, expected one colour per line");
      colors.insert(colors.end(), found.begin(), found.end());
    } catch (const Error& error) {
      throw Error(where + error.what());
    }
  }
  return colors;
}

std::string color_text(const ColorValues& values) {
  const auto number = [](double value) {
    const bool is_noise = std::abs(value) < 5e-11;  // rounding errors of conversions to black and grey
    return formatted("%.10g", is_noise ? 0 : value);
  };
  return number(values[0]) + " " + number(values[1]) + " " + number(values[2]);
}

}  // namespace tessera::program::cli
