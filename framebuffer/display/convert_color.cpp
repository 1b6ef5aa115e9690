#include "framebuffer/tessera/color.hpp"

namespace tessera {
namespace {

// Where the values of a model come from, in the order of the chain signal - light - XYZ.
enum class Stage { signal, light, xyz };

Stage stage_of(ColorModel model) {
  switch (model) {
    case ColorModel::xyz:
    case ColorModel::lab: return Stage::xyz;
    case ColorModel::oklab: return Stage::light;
    default: return Stage::signal;
  }
}

ColorValues signal_of(ColorModel model, const ColorValues& values) {
  switch (model) {
    case ColorModel::hsv: return rgb_from_hsv(values);
    case ColorModel::hsl: return rgb_from_hsl(values);
    case ColorModel::hsi: return rgb_from_hsi(values);
    case ColorModel::hvc: return rgb_from_hvc(values);
    case ColorModel::yuv: return rgb_from_yuv(values);
    case ColorModel::yiq: return rgb_from_yiq(values);
    case ColorModel::yiq_1953: return rgb_from_yiq_1953(values);
    case ColorModel::photo_ycc: return rgb_from_photo_ycc(values);
    case ColorModel::photo_ycc_8bit: return rgb_from_photo_ycc(photo_ycc_from_photo_ycc_8bit(values));
    default: return values;
  }
}
ColorValues values_of_signal(ColorModel model, const ColorValues& rgb) {
  switch (model) {
    case ColorModel::hsv: return hsv_from_rgb(rgb);
    case ColorModel::hsl: return hsl_from_rgb(rgb);
    case ColorModel::hsi: return hsi_from_rgb(rgb);
    case ColorModel::hvc: return hvc_from_rgb(rgb);
    case ColorModel::yuv: return yuv_from_rgb(rgb);
    case ColorModel::yiq: return yiq_from_rgb(rgb);
    case ColorModel::yiq_1953: return yiq_1953_from_rgb(rgb);
    case ColorModel::photo_ycc: return photo_ycc_from_rgb(rgb);
    case ColorModel::photo_ycc_8bit: return photo_ycc_8bit_from_photo_ycc(photo_ycc_from_rgb(rgb));
    default: return rgb;
  }
}

ColorValues light_of(const ColorSpace& space, const ColorValues& values) {
  if (space.model == ColorModel::oklab) return light_from_oklab(values);
  ColorValues light = signal_of(space.model, values);
  for (double& component : light) component = light_from_signal(space.curve, component);
  return light;
}
ColorValues values_of_light(const ColorSpace& space, const ColorValues& light) {
  if (space.model == ColorModel::oklab) return oklab_from_light(light);
  ColorValues signal = light;
  for (double& component : signal) component = signal_from_light(space.curve, component);
  return values_of_signal(space.model, signal);
}

ColorValues xyz_of_values(const ColorSpace& space, const ColorValues& values) {
  switch (space.model) {
    case ColorModel::xyz: return values;
    case ColorModel::lab: return xyz_from_lab(values, space.primaries.white);
    default: return xyz_from_rgb_light(space.primaries) * light_of(space, values);
  }
}
ColorValues values_of_xyz(const ColorSpace& space, const ColorValues& xyz) {
  switch (space.model) {
    case ColorModel::xyz: return xyz;
    case ColorModel::lab: return lab_from_xyz(xyz, space.primaries.white);
    default: return values_of_light(space, inverse(xyz_from_rgb_light(space.primaries)) * xyz);
  }
}

}  // namespace

ColorValues convert_color(const ColorValues& values, const ColorSpace& from, const ColorSpace& to) {
  const Stage stage_from = stage_of(from.model), stage_to = stage_of(to.model);
  const bool same_primaries =
      stage_from != Stage::xyz && stage_to != Stage::xyz && from.primaries == to.primaries;
  const bool same_signal =
      same_primaries && stage_from == Stage::signal && stage_to == Stage::signal && from.curve == to.curve;
  if (same_signal) return values_of_signal(to.model, signal_of(from.model, values));
  if (same_primaries) return values_of_light(to, light_of(from, values));
  const bool adapts =
      from.adaptation == ChromaticAdaptation::bradford || to.adaptation == ChromaticAdaptation::bradford;
  ColorValues xyz = xyz_of_values(from, values);
  if (adapts)
    xyz = adaptation_matrix(from.primaries.white, to.primaries.white, ChromaticAdaptation::bradford) * xyz;
  return values_of_xyz(to, xyz);
}

}  // namespace tessera
