// Displays by name: parsing, checking and listing of their parameters.
#include <algorithm>
#include <optional>
#include <string>

#include "framebuffer/display/display_values.h"

namespace tessera {
namespace {

using detail::Numbers;
using detail::Parameter;

constexpr NamedDisplayKind kKinds[] = {
    {DisplayKind::crt, "crt", "cathode ray tube: beam, shadow mask, phosphor"},
    {DisplayKind::lcd, "lcd", "liquid crystal panel: stripes of subpixels that respond slowly"},
    {DisplayKind::plasma, "plasma", "plasma panel: cells that flash in subfields"},
    {DisplayKind::eink, "eink", "electrophoretic panel: few greys, and a ghost of the frame before"},
    {DisplayKind::ntsc, "ntsc", "television tube behind an NTSC-M signal"},
    {DisplayKind::pal, "pal", "television tube behind a PAL-B/G signal"},
};

std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

/// The names of a table, separated by commas.
template <class Rows>
std::string names_of(const Rows& rows) {
  std::string list;
  for (const auto& row : rows) list += (list.empty() ? "" : ", ") + std::string(row.name);
  return list;
}

/// The row of that name; the end if there is none.
template <class Rows>
auto find_named(const Rows& rows, std::string_view name) {
  return std::find_if(std::begin(rows), std::end(rows), [&](const auto& row) { return row.name == name; });
}

std::string_view name_of(DisplayKind kind) {
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const NamedDisplayKind& named) { return named.kind == kind; });
  if (found == std::end(kKinds))
    throw DisplayError("kind is " + std::to_string(static_cast<int>(kind)) + ", expected 0 to 5");
  return found->name;
}

/// "found 9, expected 0.05 to 5 mm"
DisplayError value_error(const Parameter& parameter, const std::string& found) {
  const std::string unit = parameter.unit.empty() ? "" : " (" + std::string(parameter.unit) + ")";
  return DisplayError(std::string(parameter.name) + ": found " + found + ", expected " +
                      values_text(parameter) + unit);
}

/// Sets the parameter of an entry "NAME=VALUE".
void set_parameter(Display& display, std::string_view entry) {
  const std::vector<Parameter> table = detail::parameter_table(display.kind);
  const std::size_t equals = entry.find('=');
  const auto parameter = find_named(table, entry.substr(0, equals));
  if (parameter == table.end())
    throw DisplayError("found " + quoted(entry) + ", expected NAME=VALUE with a parameter of " +
                       std::string(name_of(display.kind)) + ": " + names_of(table));
  const std::string_view text = equals == std::string_view::npos ? "" : entry.substr(equals + 1);
  const auto value = parse_value(*parameter, text);
  if (!value) throw value_error(*parameter, quoted(text));
  parameter->member.set(display, *value);
}

/// Sets the parameters of a list "NAME=VALUE,...".
void set_parameters(Display& display, std::string_view list) {
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    set_parameter(display, list.substr(begin, end - begin));
    begin = end + 1;
  }
}

/// Splits "NAME:PARAMETERS".
struct DisplayText {
  explicit DisplayText(std::string_view text) : name(text.substr(0, text.find(':'))) {
    if (name.size() < text.size()) parameters = text.substr(name.size() + 1);
  }
  std::string_view name;
  std::optional<std::string_view> parameters;  ///< absent without a colon
};

/// A display without check().
Display parse_display(std::string_view text) {
  const DisplayText parts(text);
  Display display;
  if (const auto kind = find_named(kKinds, parts.name); kind != std::end(kKinds)) {
    display = default_display(kind->kind);
  } else {
    const auto presets = display_presets();
    const auto preset = find_named(presets, parts.name);
    if (preset == presets.end())
      throw DisplayError("found display " + quoted(parts.name) + ", expected one of " + names_of(kKinds) +
                         ", " + names_of(presets));
    display = parse_display(preset->definition);
  }
  if (parts.parameters) set_parameters(display, *parts.parameters);
  return display;
}

/// Checks values that depend on each other.
void check_together(const Display& display) {
  const bool has_tube = display.kind == DisplayKind::crt || display.kind == DisplayKind::ntsc ||
                        display.kind == DisplayKind::pal;
  if (has_tube && display.crt.phosphor != Phosphor::p22 && display.crt.mask != ShadowMask::none)
    throw DisplayError("phosphor: found a monochrome one with a shadow mask, expected p22 or mask=none");
  if (display.kind == DisplayKind::eink && !(display.eink.black < display.eink.white))
    throw DisplayError("black: found " + detail::number_text(display.eink.black) +
                       ", expected less than white, which is " + detail::number_text(display.eink.white));
}

}  // namespace

std::span<const NamedDisplayKind> display_kinds() { return kKinds; }

// A television of 20 inches with slots of 0.64 mm is a choice within the usual 0.6 to 0.8 mm.
Display default_display(DisplayKind kind) {
  Display display{.kind = kind};
  if (kind != DisplayKind::ntsc && kind != DisplayKind::pal) return display;
  display.crt.diagonal_in = 20;
  display.crt.mask = ShadowMask::slots;
  display.crt.pitch_mm = .64;
  display.crt.primaries = kind == DisplayKind::ntsc ? DisplayPrimaries::smpte_c : DisplayPrimaries::ebu;
  return display;
}

Display find_display(std::string_view text) {
  Display display = parse_display(text);
  check(display);
  return display;
}

void check(const Display& display) {
  name_of(display.kind);  // throws for a value that is no kind
  for (const Parameter& parameter : detail::parameter_table(display.kind)) {
    const Numbers value = parameter.member.get(display);
    if (!is_valid(parameter, value)) throw value_error(parameter, value_text(parameter, value));
  }
  check_together(display);
}

std::vector<DisplayParameter> display_parameters(DisplayKind kind) {
  const Display defaults = default_display(kind);
  std::vector<DisplayParameter> list;
  for (const Parameter& parameter : detail::parameter_table(kind))
    list.push_back({.name = parameter.name,
                    .unit = parameter.unit,
                    .values = values_text(parameter),
                    .default_value = value_text(parameter, parameter.member.get(defaults)),
                    .description = parameter.description,
                    .source = parameter.source});
  return list;
}

}  // namespace tessera
