#include "engine/program/cli/color_space_choice.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <system_error>
#include <vector>

#include "engine/program/cli/formatted.h"
#include "engine/program/cli/printable.h"
#include "engine/program/scene/suggest.h"
#include "engine/tessera/types.hpp"

namespace tessera::program::cli {
namespace {

constexpr double kMinExponent = 0.1, kMaxExponent = 10;
constexpr double kMaxBlack = 0.99;

std::optional<double> number_within(std::string_view text, double min, double max) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || !(number >= min && number <= max)) return std::nullopt;
  return number;
}

TransferCurve parse_curve(std::string_view text) {
  const struct {
    std::string_view name;
    TransferCurve curve;
  } kCurves[] = {{"srgb", {.formula = CurveFormula::srgb}},
                 {"bt709", {.formula = CurveFormula::bt709}},
                 {"bt1886", {.formula = CurveFormula::bt1886}},
                 {"bt1886-1", {.formula = CurveFormula::bt1886_appendix_1}},
                 {"linear", {.formula = CurveFormula::power, .exponent = 1}}};
  std::vector<std::string_view> names;
  for (const auto& [name, curve] : kCurves) {
    if (name == text) return curve;
    names.push_back(name);
  }
  if (const auto exponent = number_within(text, kMinExponent, kMaxExponent))
    return {.formula = CurveFormula::power, .exponent = *exponent};
  throw Error("curve: found " + quoted(text) +
              ", expected srgb, bt709, bt1886, bt1886-1, linear or an exponent from 0.1 to 10" +
              did_you_mean(text, names));
}

bool has_black(const TransferCurve& curve) {
  return curve.formula == CurveFormula::bt1886 || curve.formula == CurveFormula::bt1886_appendix_1;
}

/// Values of `curve` and `black`; empty: not given.
struct CurveParameters {
  std::string_view curve, black;
};

CurveParameters parse_parameters(std::string_view text) {
  CurveParameters parameters;
  while (!text.empty()) {
    const std::string_view entry = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), entry.size() + 1));
    const std::size_t equals = entry.find('=');
    const std::string_view key = entry.substr(0, equals);
    std::string_view* value = nullptr;
    if (key == "curve") value = &parameters.curve;
    if (key == "black") value = &parameters.black;
    if (value == nullptr || equals == std::string_view::npos || equals + 1 == entry.size())
      throw Error("found " + quoted(entry) + ", expected curve=NAME or black=LIGHT");
    *value = entry.substr(equals + 1);
  }
  return parameters;
}

void set_parameters(ColorSpace& space, const CurveParameters& parameters) {
  if (!parameters.curve.empty()) space.curve = parse_curve(parameters.curve);
  if (parameters.black.empty()) return;
  const auto black = number_within(parameters.black, 0, kMaxBlack);
  if (!black) throw Error("black: found " + quoted(parameters.black) + ", expected a number from 0 to 0.99");
  if (!has_black(space.curve))
    throw Error("black: the curve is " + curve_text(space.curve) + ", expected curve=bt1886 or bt1886-1");
  space.curve.black = *black;
}

}  // namespace

NamedColorSpace parse_color_space(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  auto named = find_color_space(name);
  if (!named) {
    std::vector<std::string_view> names;
    for (const NamedColorSpace& space : color_spaces()) names.push_back(space.name);
    throw Error("found " + quoted(name) + ", expected one of " + color_space_names() +
                did_you_mean(name, names));
  }
  if (colon == std::string_view::npos) return *named;
  if (named->space.model != ColorModel::rgb)
    throw Error("found " + quoted(text) + ", but " + std::string(name) +
                " has no parameters; only spaces of R'G'B' have");
  set_parameters(named->space, parse_parameters(text.substr(colon + 1)));
  return *named;
}

std::string color_space_names() {
  std::string list;
  for (const NamedColorSpace& space : color_spaces())
    list += (list.empty() ? "" : ", ") + std::string(space.name);
  return list;
}

std::string components_text(const NamedColorSpace& named) {
  std::string list;
  for (const auto& [name, unit, min, max] : named.components) {
    list += (list.empty() ? "" : ", ") + std::string(name) + formatted(" %g..%g", min, max);
    if (!unit.empty()) list += " " + std::string(unit);
  }
  return list;
}

std::string curve_text(const TransferCurve& curve) {
  switch (curve.formula) {
    case CurveFormula::srgb: return "sRGB";
    case CurveFormula::bt709: return "BT.709";
    case CurveFormula::bt1886: return "BT.1886";
    case CurveFormula::bt1886_appendix_1: return "BT.1886, appendix 1";
    case CurveFormula::power: break;
  }
  return curve.exponent == 1 ? "linear" : formatted("power %g", curve.exponent);
}

}  // namespace tessera::program::cli
