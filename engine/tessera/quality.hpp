// Quality: caps on what draws ask for, which trade accuracy for time.
#pragma once

#include <cstdint>

namespace tessera {

/// Most accurate shading that draws get. Draws that ask for less are drawn as asked.
enum class ShadingCap : std::uint8_t {
  as_asked,
  phong_2x2,  ///< Phong shading lights once per triangle and cell of 2x2 pixels
  phong_4x4,  ///< Phong shading lights once per triangle and cell of 4x4 pixels
  gouraud,    ///< Phong shading becomes Gouraud shading
  flat        ///< every draw is flat
};
/// infinite: highlights as if LightModel::local_viewer were false.
enum class ViewerCap : std::uint8_t { as_asked, infinite };
/// affine: colours, normals, positions and texture coordinates are interpolated linearly in the window.
/// - Depth is unaffected.
/// - Vertices that clipping makes have the values of perspective-correct interpolation.
enum class InterpolationCap : std::uint8_t { perspective, affine };
/// Most accurate filter of textures.
enum class TextureCap : std::uint8_t {
  as_asked,
  bilinear,  ///< no mipmaps: the filter within a level is as asked, on the largest level
  nearest    ///< the nearest texel of the largest level
};

/// Caps on what draws ask for. The default caps nothing, and changes no bit.
/// - A frame gives the same bits for any number of threads, tile size and instruction set, whatever the caps.
/// - Coverage, depth, stencil, alpha and blending are unaffected.
struct Quality {
  ShadingCap shading = ShadingCap::as_asked;
  /// false: Phong shading uses interpolated normals as they are, without making them unit vectors again.
  /// Without DrawState::normalize, normals of vertices keep their length after the transform, too.
  bool renormalize = true;
  ViewerCap viewer = ViewerCap::as_asked;
  InterpolationCap interpolation = InterpolationCap::perspective;
  TextureCap texture = TextureCap::as_asked;
  /// 0 to 1, where 1 is full intensity of a colour. Lights are left out of a draw whose summed contributions
  /// to any of its lit colours are proven to stay below it.
  float light_threshold = 0;

  bool operator==(const Quality&) const = default;
};

}  // namespace tessera
