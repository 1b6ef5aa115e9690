// Names of enumerations in scene files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

inline constexpr std::array<std::pair<std::string_view, Primitive>, 10> kPrimitives{
    {{"points", Primitive::points},
     {"lines", Primitive::lines},
     {"line_strip", Primitive::line_strip},
     {"line_loop", Primitive::line_loop},
     {"triangles", Primitive::triangles},
     {"triangle_strip", Primitive::triangle_strip},
     {"triangle_fan", Primitive::triangle_fan},
     {"quads", Primitive::quads},
     {"quad_strip", Primitive::quad_strip},
     {"polygon", Primitive::polygon}}};

inline constexpr std::array<std::pair<std::string_view, SpecularModel>, 2> kSpecularModels{
    {{"blinn", SpecularModel::blinn}, {"phong", SpecularModel::phong}}};

inline constexpr std::array<std::pair<std::string_view, Shading>, 3> kShadings{
    {{"flat", Shading::flat}, {"gouraud", Shading::gouraud}, {"phong", Shading::phong}}};

inline constexpr std::array<std::pair<std::string_view, ColorMaterial>, 6> kColorMaterials{
    {{"none", ColorMaterial::none},
     {"ambient_and_diffuse", ColorMaterial::ambient_and_diffuse},
     {"diffuse", ColorMaterial::diffuse},
     {"ambient", ColorMaterial::ambient},
     {"emission", ColorMaterial::emission},
     {"specular", ColorMaterial::specular}}};

inline constexpr std::array<std::pair<std::string_view, Cull>, 3> kCulls{
    {{"none", Cull::none}, {"back", Cull::back}, {"front", Cull::front}}};

inline constexpr std::array<std::pair<std::string_view, Compare>, 8> kCompares{
    {{"never", Compare::never},
     {"less", Compare::less},
     {"equal", Compare::equal},
     {"lequal", Compare::lequal},
     {"greater", Compare::greater},
     {"notequal", Compare::notequal},
     {"gequal", Compare::gequal},
     {"always", Compare::always}}};

inline constexpr std::array<std::pair<std::string_view, BlendFactor>, 15> kBlendFactors{
    {{"zero", BlendFactor::zero},
     {"one", BlendFactor::one},
     {"src_color", BlendFactor::src_color},
     {"one_minus_src_color", BlendFactor::one_minus_src_color},
     {"dst_color", BlendFactor::dst_color},
     {"one_minus_dst_color", BlendFactor::one_minus_dst_color},
     {"src_alpha", BlendFactor::src_alpha},
     {"one_minus_src_alpha", BlendFactor::one_minus_src_alpha},
     {"dst_alpha", BlendFactor::dst_alpha},
     {"one_minus_dst_alpha", BlendFactor::one_minus_dst_alpha},
     {"constant_color", BlendFactor::constant_color},
     {"one_minus_constant_color", BlendFactor::one_minus_constant_color},
     {"constant_alpha", BlendFactor::constant_alpha},
     {"one_minus_constant_alpha", BlendFactor::one_minus_constant_alpha},
     {"src_alpha_saturate", BlendFactor::src_alpha_saturate}}};

inline constexpr std::array<std::pair<std::string_view, TextureFilter>, 6> kTextureFilters{
    {{"nearest", TextureFilter::nearest},
     {"linear", TextureFilter::linear},
     {"nearest_mipmap_nearest", TextureFilter::nearest_mipmap_nearest},
     {"linear_mipmap_nearest", TextureFilter::linear_mipmap_nearest},
     {"nearest_mipmap_linear", TextureFilter::nearest_mipmap_linear},
     {"linear_mipmap_linear", TextureFilter::linear_mipmap_linear}}};

inline constexpr std::array<std::pair<std::string_view, TextureWrap>, 3> kTextureWraps{
    {{"repeat", TextureWrap::repeat},
     {"clamp_to_edge", TextureWrap::clamp_to_edge},
     {"mirrored_repeat", TextureWrap::mirrored_repeat}}};

/// @pre the table has the value
template <class Enum, std::size_t count>
std::string_view name_in(const std::array<std::pair<std::string_view, Enum>, count>& names, Enum value) {
  return std::ranges::find(names, value, &std::pair<std::string_view, Enum>::second)->first;
}

}  // namespace tessera::program
