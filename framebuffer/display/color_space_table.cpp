// The named colour spaces, as data.
#include <algorithm>
#include <array>

#include "framebuffer/tessera/color.hpp"

namespace tessera {
namespace {

using Components = std::array<ColorComponent, 3>;

constexpr ColorComponent unit_range(std::string_view name) { return {name, "", 0, 1}; }
constexpr ColorComponent symmetric(std::string_view name, double limit) { return {name, "", -limit, limit}; }

constexpr ColorComponent kHue{"H", "degrees", 0, 360};
constexpr Components kSignal{unit_range("R'"), unit_range("G'"), unit_range("B'")};
constexpr Components kLight{unit_range("R"), unit_range("G"), unit_range("B")};

constexpr TransferCurve kLinear{.formula = CurveFormula::power, .exponent = 1};
constexpr TransferCurve kCamera{.formula = CurveFormula::bt709};
constexpr TransferCurve power_curve(double exponent) {
  return {.formula = CurveFormula::power, .exponent = exponent};
}

constexpr RgbPrimaries with_white(RgbPrimaries primaries, Chromaticity white) {
  primaries.white = white;
  return primaries;
}

constexpr ColorSpace rgb_space(const RgbPrimaries& primaries, const TransferCurve& curve) {
  return {.primaries = primaries, .curve = curve};
}
constexpr ColorSpace srgb_model(ColorModel model) { return {.model = model}; }

// Tubes were measured with exponents from 2.2 to 2.5.
constexpr std::string_view kTubeSource = "color.org; power 2.4: default, of BT.1886 with black 0";
constexpr std::string_view kHueSource = "Smith, Color Gamut Transform Pairs, 1978";

constexpr NamedColorSpace kSpaces[] = {
    {"rgb", {}, kSignal, "sRGB: signal of displays and picture files", "IEC 61966-2-1"},
    {"linear", rgb_space(kBt709Primaries, kLinear), kLight, "light of sRGB's primaries", "ITU-R BT.709"},
    {"bt709", rgb_space(kBt709Primaries, kCamera), kSignal, "signal of HDTV cameras", "ITU-R BT.709"},
    {"smpte-c", rgb_space(kSmpteCPrimaries, kCamera), kSignal, "signal of North American television",
     "SMPTE RP 145; curve: SMPTE 170M"},
    {"ebu", rgb_space(kEbuPrimaries, power_curve(2.8)), kSignal, "signal of European television",
     "EBU Tech. 3213; power 2.8: ITU-R BT.470, B and G"},
    {"ntsc-1953", rgb_space(kNtsc1953Primaries, power_curve(2.2)), kSignal, "signal of early NTSC, white C",
     "FCC 1953; power 2.2: ITU-R BT.470, M"},
    {"trinitron", rgb_space(kTrinitronPrimaries, power_curve(2.4)), kSignal, "Trinitron monitor tube at D65",
     kTubeSource},
    {"trinitron-9300", rgb_space(with_white(kTrinitronPrimaries, kWhite9300K), power_curve(2.4)), kSignal,
     "Trinitron monitor tube at 9300 K", kTubeSource},
    {"hitachi", rgb_space(kHitachiPrimaries, power_curve(2.4)), kSignal, "Hitachi CM2198 monitor tube at D65",
     kTubeSource},
    {"hitachi-9300", rgb_space(with_white(kHitachiPrimaries, kWhite9300K), power_curve(2.4)), kSignal,
     "Hitachi CM2198 monitor tube at 9300 K", kTubeSource},
    {"hsv",
     srgb_model(ColorModel::hsv),
     {kHue, unit_range("S"), unit_range("V")},
     "hexagonal hue, saturation, value",
     kHueSource},
    {"hsl",
     srgb_model(ColorModel::hsl),
     {kHue, unit_range("S"), unit_range("L")},
     "hexagonal hue, saturation, lightness",
     kHueSource},
    {"hsi",
     srgb_model(ColorModel::hsi),
     {kHue, unit_range("S"), unit_range("I")},
     "circular hue, saturation, intensity",
     "atan2(sqrt(3) (G - B) / 2, R - (G + B) / 2); 1 - min / I"},
    {"hvc",
     srgb_model(ColorModel::hvc),
     {kHue, unit_range("V"), unit_range("C")},
     "hexagonal hue, value, chroma",
     "variant of HSV; not Munsell's or Tektronix's"},
    {"yuv",
     srgb_model(ColorModel::yuv),
     {unit_range("Y'"), symmetric("U", .43601), symmetric("V", .61498)},
     "luma and colour differences of R'G'B'",
     "SMPTE 170M"},
    {"yiq",
     srgb_model(ColorModel::yiq),
     {unit_range("Y'"), symmetric("I", .59590), symmetric("Q", .52274)},
     "U and V rotated by 33 degrees",
     "SMPTE 170M"},
    {"yiq-1953",
     srgb_model(ColorModel::yiq_1953),
     {unit_range("Y'"), symmetric("I", .599), symmetric("Q", .5251)},
     "YIQ with coefficients of two digits",
     "FCC 1953"},
    {"photoycc",
     {.model = ColorModel::photo_ycc, .curve = kCamera},
     {unit_range("Y"), symmetric("C1", .886), symmetric("C2", .701)},
     "Photo CD; white is Y = 1, the disc reaches 1.402",
     "Kodak, Photo CD article 4"},
    {"photoycc-8",
     {.model = ColorModel::photo_ycc_8bit, .curve = kCamera},
     {ColorComponent{"Y", "code", 0, 255}, {"C1", "code", 0, 255}, {"C2", "code", 0, 255}},
     "Photo CD in 8 bits, rounded; white is 182 156 137",
     "Kodak, Photo CD article 4"},
    {"xyz",
     srgb_model(ColorModel::xyz),
     {unit_range("X"), unit_range("Y"), ColorComponent{"Z", "", 0, 1.0891}},
     "tristimulus values, white has Y = 1",
     "CIE 1931, 2 degrees"},
    {"lab",
     srgb_model(ColorModel::lab),
     {ColorComponent{"L*", "", 0, 100}, symmetric("a*", 128), symmetric("b*", 128)},
     "CIELAB, white D65",
     "CIE 15"},
    {"lab-d50",
     {.model = ColorModel::lab,
      .primaries = with_white(kBt709Primaries, kWhiteD50),
      .adaptation = ChromaticAdaptation::bradford},
     {ColorComponent{"L*", "", 0, 100}, symmetric("a*", 128), symmetric("b*", 128)},
     "CIELAB, white D50, adapted by Bradford",
     "CIE 15; ICC.1, annex E"},
    {"oklab",
     srgb_model(ColorModel::oklab),
     {unit_range("L"), symmetric("a", .4), symmetric("b", .4)},
     "perceptual space for image processing",
     "Ottosson 2020"},
};

}  // namespace

std::span<const NamedColorSpace> color_spaces() { return kSpaces; }

std::optional<NamedColorSpace> find_color_space(std::string_view name) {
  const auto found = std::find_if(std::begin(kSpaces), std::end(kSpaces),
                                  [&](const NamedColorSpace& space) { return space.name == name; });
  return found == std::end(kSpaces) ? std::nullopt : std::optional(*found);
}

}  // namespace tessera
