// Display modes by name: WIDTHxHEIGHTxBITS, and parameters after a colon.
#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "engine/buffers/display_mode_state.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/tessera/display_mode.hpp"
#include "framebuffer/mode_table.h"

namespace tessera {
using namespace detail;

namespace {

[[noreturn]] void refuse_name(const std::string& message, ErrorCode code = ErrorCode::invalid_argument) {
  throw Error(code, "display_mode: " + message);
}
std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

/// A decimal number without sign; absent if the text is anything else or the number exceeds int.
std::optional<int> decimal(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size() && !text.starts_with('-');
  return is_number ? std::optional(value) : std::nullopt;
}

/// Modes whose color depends on the pixel's cell or on its left neighbour.
struct RefusedMode {
  std::string_view name;
  std::string_view reason;
};
constexpr RefusedMode kRefusedModes[] = {
    {"spectrum", "it has two colours per cell of 8x8 pixels"},
    {"c64", "it has two to four colours per cell of 8x8 pixels"},
    {"msx", "it has two colours per group of 8 pixels"},
    {"ham", "a pixel may change one component of its left neighbour (HAM)"},
    {"ham6", "a pixel may change one component of its left neighbour (HAM)"},
    {"ham8", "a pixel may change one component of its left neighbour (HAM)"},
};

/// The parameters after the colon, each of which must be used.
class ModeParameters {
 public:
  ModeParameters(std::string_view mode, std::string_view text) : mode_(mode) {
    while (!text.empty()) {
      const std::size_t comma = std::min(text.find(','), text.size());
      const std::string_view item = text.substr(0, comma);
      const std::size_t equals = item.find('=');
      if (equals == std::string_view::npos || equals == 0 || equals + 1 == item.size() ||
          comma + 1 == text.size())
        refuse_name("found " + quoted(text) + " in the parameters of " + quoted(mode) +
                    ", expected key=value, separated by commas");
      const std::string_view key = item.substr(0, equals);
      for (const auto& [known, value] : items_)
        if (known == key) refuse_name("parameter " + quoted(key) + " is given twice");
      items_.emplace_back(key, item.substr(equals + 1));
      text.remove_prefix(std::min(comma + 1, text.size()));
    }
  }
  /// Removes a parameter and returns its value; absent if it is not given.
  std::optional<std::string_view> take(std::string_view key) {
    const auto found =
        std::find_if(items_.begin(), items_.end(), [&](const auto& item) { return item.first == key; });
    if (found == items_.end()) return std::nullopt;
    const std::string_view value = found->second;
    items_.erase(found);
    return value;
  }
  /// The position of the parameter's value in `choices`; `default_choice` if it is not given.
  std::size_t take_choice(std::string_view key, std::span<const std::string_view> choices,
                          std::size_t default_choice) {
    const auto value = take(key);
    if (!value) return default_choice;
    const auto found = std::find(choices.begin(), choices.end(), *value);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    std::string list;
    for (const std::string_view choice : choices) list += (list.empty() ? "" : ", ") + std::string(choice);
    refuse_value(key, *value, "one of " + list);
  }
  [[noreturn]] void refuse_value(std::string_view key, std::string_view value,
                                 const std::string& expected) const {
    refuse_name(quoted(mode_) + ": " + std::string(key) + " is " + quoted(value) + ", expected " + expected);
  }
  /// @param known  names of the mode's parameters, for the message
  void require_all_used(std::string_view known) const {
    if (items_.empty()) return;
    refuse_name(quoted(mode_) + " has no parameter " + quoted(items_.front().first) +
                (known.empty() ? "; it takes none" : ", expected " + std::string(known)));
  }

 private:
  std::string_view mode_;
  std::vector<std::pair<std::string_view, std::string_view>> items_;
};

void set_cga_colors(ModeParameters& parameters, DisplayMode& mode) {
  constexpr std::string_view kPalettes[] = {"0", "1", "mode5"};  // in the order of CgaPalette
  constexpr std::string_view kIntensities[] = {"low", "high"};
  const CgaColors defaults;
  CgaColors colors;
  colors.palette = static_cast<CgaPalette>(
      parameters.take_choice("palette", kPalettes, static_cast<std::size_t>(defaults.palette)));
  colors.high_intensity =
      parameters.take_choice("intensity", kIntensities, defaults.high_intensity ? 1 : 0) == 1;
  if (const auto text = parameters.take("background")) {
    const auto background = decimal(*text);
    if (!background || *background > 15) parameters.refuse_value("background", *text, "0 to 15");
    colors.background = *background;
  }
  mode.palette = colors_of(cga_entries(colors));
}

void set_byte_order(ModeParameters& parameters, DisplayMode& mode) {
  constexpr std::string_view kOrders[] = {"little", "big"};  // in the order of ByteOrder
  mode.byte_order = static_cast<ByteOrder>(
      parameters.take_choice("bytes", kOrders, static_cast<std::size_t>(mode.byte_order)));
}

/// 4 bits: base palette; 8 bits: pseudo-colour; all others: components.
void set_sized_colors(ModeParameters& parameters, DisplayMode& mode) {
  constexpr std::string_view kColors[] = {"rgb", "index", "gray"};
  const bool is_index_by_default = mode.color_bits == 4 || mode.color_bits == 8;
  const std::size_t choice = parameters.take_choice("color", kColors, is_index_by_default ? 1 : 0);
  const bool is_gray = choice == 2;
  if (is_gray && mode.color_bits > 8)
    refuse_name(quoted(mode.name) + ": gray takes 1 to 8 bits, found " + std::to_string(mode.color_bits));
  if (choice == 0 || (is_gray && mode.color_bits <= 2)) return;  // 1 and 2 bits of components are greys
  mode.color_mode = ColorMode::index;
  mode.palette = is_gray ? named_palette("gray", mode.color_bits) : default_palette(mode.color_bits);
  mode.palette_component_bits = is_gray ? 0 : 8;
}

void set_sized_aspect(ModeParameters& parameters, DisplayMode& mode) {
  const auto text = parameters.take("aspect");
  if (!text) return;
  const std::size_t colon = std::min(text->find(':'), text->size());
  const auto width = decimal(text->substr(0, colon));
  const auto height = decimal(text->substr(std::min(colon + 1, text->size())));
  const auto is_valid = [](const std::optional<int>& side) { return side && *side >= 1 && *side <= 255; };
  if (!is_valid(width) || !is_valid(height))
    parameters.refuse_value("aspect", *text, "WIDTH:HEIGHT of a pixel, each 1 to 255");
  mode.pixel_aspect = lowest_terms(*width, *height);
}

MemoryLayout sized_layout(int bits) {
  if (bits > 8) return MemoryLayout::bytes;
  return 8 % bits == 0 ? MemoryLayout::packed : MemoryLayout::planes;
}

/// WIDTHxHEIGHTxBITS; absent if the text does not have this form.
std::optional<DisplayMode> sized_mode(std::string_view text) {
  int sizes[3];
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? rest.find('x') : rest.size();
    const auto number = end == std::string_view::npos ? std::nullopt : decimal(rest.substr(0, end));
    if (!number) return std::nullopt;
    sizes[i] = *number;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  for (const int side : {sizes[0], sizes[1]})
    if (side < 1 || side > kMaxFrameBufferSize)
      refuse_name(quoted(text) + ": each side must be 1 to " + std::to_string(kMaxFrameBufferSize) +
                  " pixels");
  if (sizes[2] < 1 || sizes[2] > 24)
    refuse_name(quoted(text) + " has " + std::to_string(sizes[2]) + " bits per pixel, must be 1 to 24");
  return DisplayMode{.name = std::string(text),
                     .description = std::to_string(sizes[0]) + "x" + std::to_string(sizes[1]) + ", " +
                                    std::to_string(sizes[2]) + (sizes[2] == 1 ? " bit" : " bits"),
                     .width = sizes[0],
                     .height = sizes[1],
                     .color_bits = sizes[2],
                     .layout = sized_layout(sizes[2])};
}

DisplayMode named_mode(std::string_view base) {
  for (const RefusedMode& refused : kRefusedModes)
    if (refused.name == base)
      refuse_name("mode " + quoted(base) + " is not supported: " + std::string(refused.reason),
                  ErrorCode::unsupported);
  std::string list;
  for (const DisplayMode& mode : display_modes()) {
    if (mode.name == base) return mode;
    list += mode.name + ", ";
  }
  refuse_name("mode " + quoted(base) + " is unknown, expected one of " + list + "or WIDTHxHEIGHTxBITS");
}

DisplayMode parsed_mode(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view base = text.substr(0, colon);
  ModeParameters parameters(base, text.substr(std::min(colon + 1, text.size())));
  const auto sized = sized_mode(base);
  DisplayMode mode = sized ? *sized : named_mode(base);
  std::string known;
  const auto add_known = [&known](std::string_view names) {
    known += (known.empty() ? "" : ", ") + std::string(names);
  };
  if (mode.name == "cga") {
    set_cga_colors(parameters, mode);
    add_known("palette, intensity, background");
  }
  if (sized) {
    set_sized_colors(parameters, mode);
    set_sized_aspect(parameters, mode);
    add_known("color, aspect");
  }
  if (mode.layout == MemoryLayout::bytes) {
    set_byte_order(parameters, mode);
    add_known("bytes");
  }
  parameters.require_all_used(known);
  mode.name = text;
  if (mode.layout != MemoryLayout::character_cells) check_display_mode(mode, "display_mode");
  return mode;
}

}  // namespace

DisplayMode display_mode(std::string_view name) {
  const FloatingPointMode floating_point;
  return translate_bad_alloc("display_mode", [&] { return parsed_mode(name); });
}

}  // namespace tessera
