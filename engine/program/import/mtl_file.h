// The content of an MTL file as it stands.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::program {

using Rgb = std::array<float, 3>;

/// A map_... line. The texture's coordinates are scale * (s, t) + offset.
struct MtlMap {
  std::string image;  ///< file name; empty: none
  std::array<float, 2> scale{1, 1};
  std::array<float, 2> offset{0, 0};
  bool is_clamped = false;
};

/// A material; what the file does not give is absent.
struct MtlMaterial {
  std::string name;
  std::optional<Rgb> ambient, diffuse, specular, emission;
  std::optional<float> shininess;     ///< Ns
  std::optional<float> opacity;       ///< d: 0 invisible to 1 opaque
  std::optional<float> transparency;  ///< Tr: by the format 1 - d, but some programs write d; see alpha_of()
  std::optional<int> illum;
  MtlMap diffuse_map;  ///< map_Kd
  MtlMap opacity_map;  ///< map_d
};

/// Reads the text of an MTL file.
/// - Keywords in any case; those that MtlMaterial has no field for are ignored, as are the options -blendu,
///   -blendv, -bm, -boost, -cc, -imfchan, -mm, -t, -texres and -type of maps.
/// - A colour of one number is a grey.
/// - Colours given as spectral curves or in XYZ, and an illum that is not an integer, are left out.
/// `warnings`
///   gets a line for each.
/// @param file  for messages
/// @throws Error with file and line for a number that is missing, malformed or not finite
std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& file,
                                   std::vector<std::string>& warnings);

}  // namespace tessera::program
