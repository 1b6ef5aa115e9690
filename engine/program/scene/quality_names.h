// Names of quality caps in scene files and options.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "engine/tessera/quality.hpp"

namespace tessera::program {

inline constexpr std::array<std::pair<std::string_view, ShadingCap>, 5> kShadingCaps{
    {{"as_asked", ShadingCap::as_asked},
     {"phong_2x2", ShadingCap::phong_2x2},
     {"phong_4x4", ShadingCap::phong_4x4},
     {"gouraud", ShadingCap::gouraud},
     {"flat", ShadingCap::flat}}};
inline constexpr std::array<std::pair<std::string_view, ViewerCap>, 2> kViewerCaps{
    {{"as_asked", ViewerCap::as_asked}, {"infinite", ViewerCap::infinite}}};
inline constexpr std::array<std::pair<std::string_view, InterpolationCap>, 2> kInterpolationCaps{
    {{"perspective", InterpolationCap::perspective}, {"affine", InterpolationCap::affine}}};
inline constexpr std::array<std::pair<std::string_view, TextureCap>, 3> kTextureCaps{
    {{"as_asked", TextureCap::as_asked},
     {"bilinear", TextureCap::bilinear},
     {"nearest", TextureCap::nearest}}};
inline constexpr std::array<std::pair<std::string_view, bool>, 2> kRenormalize{
    {{"on", true}, {"off", false}}};

/// Parses "KEY=VALUE,...", for example "shading=phong_2x2,viewer=infinite". Keys are the fields of Quality;
/// those that are absent have their defaults.
/// @throws Error "found ..., expected ..."
Quality parse_quality(const std::string& text);

}  // namespace tessera::program
