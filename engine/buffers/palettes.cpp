// Chosen palettes: checks of arguments around the algorithms of the frame buffer's floor.
#include "engine/tessera/palettes.hpp"

#include <algorithm>
#include <string>

#include "engine/buffers/display_mode_state.h"
#include "engine/record/checks.h"
#include "engine/record/material_ramps.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "framebuffer/adaptive_palette.h"
#include "framebuffer/color_counts.h"
#include "framebuffer/instruction_set.h"
#include "framebuffer/ramp_palette.h"
#include "framebuffer/smooth_palette.h"

namespace tessera {
using namespace detail;

namespace {

[[noreturn]] void refuse(const char* function, const std::string& message,
                         ErrorCode code = ErrorCode::invalid_argument) {
  throw Error(code, std::string(function) + ": " + message);
}

PaletteShape checked_shape(const PaletteRequest& request, const char* function) {
  if (request.count < 1 || request.count > kMaxChosenEntries)
    refuse(function, "count is " + std::to_string(request.count) + ", must be 1 to " +
                         std::to_string(kMaxChosenEntries));
  if (request.component_bits < 1 || request.component_bits > 8)
    refuse(function, "component_bits is " + std::to_string(request.component_bits) + ", must be 1 to 8");
  return {.entries = static_cast<std::size_t>(request.count), .component_bits = request.component_bits};
}

void require_pixels(bool has_pixels, const char* function) {
  if (!has_pixels) refuse(function, "the picture has 0 pixels, must have at least 1");
}

void require_counts(const ColorCounts* counts, const char* function) {
  if (!counts) refuse(function, "the PictureColors was moved from", ErrorCode::invalid_state);
  require_pixels(!counts->empty(), function);
}

template <class Pixel>
std::vector<Color> palette_of_pixels(std::span<const Pixel> pixels, const PaletteRequest& request) {
  PictureColors picture;
  picture.add(pixels);
  return adaptive_palette(picture, request);
}

}  // namespace

PaletteRequest palette_request(const DisplayMode& mode) {
  constexpr const char* kFunction = "palette_request";
  const FloatingPointMode floating_point;
  return translate_bad_alloc(kFunction, [&]() -> PaletteRequest {
    check_display_mode(mode, kFunction);
    const std::string name = "mode \"" + mode.name + "\"";
    if (mode.color_mode != ColorMode::index)
      refuse(kFunction,
             name + " has no palette: its pixels hold colour components of " +
                 std::to_string(mode.color_bits) + (mode.color_bits == 1 ? " bit" : " bits"),
             ErrorCode::incompatible_format);
    if (mode.palette_component_bits == 0)
      refuse(kFunction,
             name + " has " + std::to_string(mode.palette.size()) +
                 " fixed colours; a palette cannot be chosen for it",
             ErrorCode::incompatible_format);
    return {.count = std::min(1 << mode.color_bits, kMaxChosenEntries),
            .component_bits = mode.palette_component_bits};
  });
}

PictureColors::PictureColors()
    : counts_(translate_bad_alloc("PictureColors", [] { return std::make_unique<ColorCounts>(); })) {}
PictureColors::~PictureColors() = default;
PictureColors::PictureColors(PictureColors&&) noexcept = default;
PictureColors& PictureColors::operator=(PictureColors&&) noexcept = default;

void PictureColors::add(std::span<const std::uint32_t> words) {
  constexpr const char* kFunction = "PictureColors::add";
  if (!counts_) refuse(kFunction, "the object was moved from", ErrorCode::invalid_state);
  require_pixels(!words.empty(), kFunction);
  translate_bad_alloc(kFunction, [&] { counts_->add(words); });
}

void PictureColors::add(std::span<const std::uint8_t> rgba) {
  constexpr const char* kFunction = "PictureColors::add";
  if (rgba.size() % 4 != 0)
    refuse(kFunction, "the picture has " + std::to_string(rgba.size()) +
                          " bytes, must be a multiple of 4: r g b a per pixel");
  const auto words = translate_bad_alloc(kFunction, [&] {
    std::vector<std::uint32_t> packed(rgba.size() / 4);
    for (std::size_t i = 0; i < packed.size(); ++i)
      packed[i] = std::uint32_t{rgba[4 * i]} << 16 | std::uint32_t{rgba[4 * i + 1]} << 8 | rgba[4 * i + 2];
    return packed;
  });
  add(std::span<const std::uint32_t>(words));
}

std::vector<Color> adaptive_palette(const PictureColors& picture, const PaletteRequest& request) {
  constexpr const char* kFunction = "adaptive_palette";
  const FloatingPointMode floating_point;
  return translate_bad_alloc(kFunction, [&] {
    const PaletteShape shape = checked_shape(request, kFunction);
    require_counts(picture.counts_.get(), kFunction);
    return colors_of(detail::adaptive_palette(*picture.counts_, shape, available_isas().front()));
  });
}
std::vector<Color> adaptive_palette(std::span<const std::uint8_t> rgba, const PaletteRequest& request) {
  return palette_of_pixels(rgba, request);
}
std::vector<Color> adaptive_palette(std::span<const std::uint32_t> words, const PaletteRequest& request) {
  return palette_of_pixels(words, request);
}

std::vector<Color> ramp_palette(std::span<const LitMaterials> groups, std::span<const Color> colors,
                                const PaletteRequest& request) {
  constexpr const char* kFunction = "ramp_palette";
  const FloatingPointMode floating_point;
  return translate_bad_alloc(kFunction, [&] {
    const PaletteShape shape = checked_shape(request, kFunction);
    std::vector<ColorRamp> ramps;
    for (const LitMaterials& group : groups) append_material_ramps(group, kFunction, ramps);
    for (const Color& color : colors) {
      require_finite({kFunction, ": a colour"}, color);
      ramps.push_back({{color.r, color.g, color.b}});
    }
    if (ramps.empty()) refuse(kFunction, "found no materials and no colours, expected at least one");
    return colors_of(detail::ramp_palette(ramps, shape, available_isas().front()));
  });
}

SmoothPalette::SmoothPalette(const PaletteRequest& request)
    : entries_(translate_bad_alloc("SmoothPalette", [&] {
        return std::make_unique<SmoothEntries>(checked_shape(request, "SmoothPalette"),
                                               available_isas().front());
      })) {}
SmoothPalette::~SmoothPalette() = default;
SmoothPalette::SmoothPalette(SmoothPalette&&) noexcept = default;
SmoothPalette& SmoothPalette::operator=(SmoothPalette&&) noexcept = default;

std::vector<Color> SmoothPalette::follow(const PictureColors& picture) {
  constexpr const char* kFunction = "SmoothPalette::follow";
  const FloatingPointMode floating_point;
  return translate_bad_alloc(kFunction, [&] {
    if (!entries_) refuse(kFunction, "the object was moved from", ErrorCode::invalid_state);
    require_counts(picture.counts_.get(), kFunction);
    return colors_of(entries_->follow(*picture.counts_));
  });
}

}  // namespace tessera
