// The frame buffer of a scene, and the features that its kind excludes.
#include "palette.h"
#include "scene_parts.h"

namespace tessera::reference {
namespace {

std::vector<Rgb8> parse_palette(const Value& v, int bits) {
  if (v.json->is_string() && text(v) == "adaptive")
    fail(v.pointer, "a fixed or custom palette: adaptive ones come later");
  if (v.json->is_string()) return named_palette(text(v), bits);
  std::vector<Rgb8> palette;
  if (array_size(v) == 0 || array_size(v) > (std::size_t{1} << bits)) fail(v.pointer, "1 to 2^bits entries");
  for (std::size_t i = 0; i < array_size(v); ++i) {
    Rgb8 entry;
    if (array_size(v[i]) != 3) fail(v[i].pointer, "r, g, b");
    for (std::size_t c = 0; c < 3; ++c)
      entry[c] = static_cast<std::uint8_t>(std::floor(255 * number(v[i][c], 0, 1) + 0.5));
    palette.push_back(entry);
  }
  return palette;
}

void parse_color(const Value& v, FrameBufferFormat& format) {
  ObjectReader reader(v);
  if (const Value mode = reader.find("mode"))
    format.color_mode = choice<ColorMode>(mode, {{"rgb", ColorMode::kRgb}, {"index", ColorMode::kIndex}});
  if (const Value bits = reader.find("bits")) format.color_bits = static_cast<int>(integer(bits, 1, 24));
  reader.finish();
}

Dither parse_dither(const Value& v) {
  for (const char* later : {"blue_noise", "floyd_steinberg", "jarvis", "pattern"})
    if (text(v) == later) fail(v.pointer, "none | bayer2 | bayer4 | bayer8: " + text(v) + " comes later");
  return choice<Dither>(v, {{"none", Dither::kNone},
                            {"bayer2", Dither::kBayer2},
                            {"bayer4", Dither::kBayer4},
                            {"bayer8", Dither::kBayer8}});
}

/// An integer from a list. Index buffers only allow the first value.
int parse_size(const Value& v, const std::vector<int>& sizes, const FrameBufferFormat& format,
               const std::string& what) {
  std::string all;
  bool known = false;
  const std::int64_t size = integer(v, 0, 1024);
  for (const int candidate : sizes) {
    all += std::string(all.empty() ? "" : " | ") + std::to_string(candidate);
    known = known || candidate == size;
  }
  if (!known) fail(v.pointer, all);
  if (format.color_mode == ColorMode::kIndex && size != sizes.front())
    fail(v.pointer, "an RGB buffer for " + what + ", not an index buffer");
  return static_cast<int>(size);
}

}  // namespace

FrameBufferFormat parse_framebuffer(const Value& v) {
  ObjectReader reader(v);
  FrameBufferFormat format;
  if (const Value width = reader.find("width")) format.width_px = static_cast<int>(integer(width, 1, 16384));
  if (const Value height = reader.find("height"))
    format.height_px = static_cast<int>(integer(height, 1, 16384));
  if (const Value color = reader.find("color")) parse_color(color, format);
  const Value palette = reader.find("palette");
  if (format.color_mode == ColorMode::kIndex)
    format.palette = palette ? parse_palette(palette, format.color_bits) : default_palette(format.color_bits);
  else if (palette) fail(palette.pointer, "an index buffer to go with a palette");
  if (const Value dither = reader.find("dither")) format.dither = parse_dither(dither);
  if (const Value depth = reader.find("depth"))
    format.depth = choice<DepthFormat>(depth, {{"none", DepthFormat::kNone},
                                               {"unorm16", DepthFormat::kUnorm16},
                                               {"unorm24", DepthFormat::kUnorm24},
                                               {"unorm32", DepthFormat::kUnorm32},
                                               {"float32", DepthFormat::kFloat32}});
  if (const Value stencil = reader.find("stencil"))
    format.stencil_bits = static_cast<int>(integer(stencil, 0, 8));
  if (const Value alpha = reader.find("alpha"))
    format.alpha_bits = parse_size(alpha, {0, 8}, format, "alpha planes");
  if (const Value accumulation = reader.find("accumulation"))
    format.accumulation_bits = parse_size(accumulation, {0, 16, 32}, format, "accumulation");
  if (const Value samples = reader.find("samples"))
    format.samples = parse_size(samples, {1, 4, 8}, format, "multisampling");
  reader.finish();
  return format;
}

}  // namespace tessera::reference
