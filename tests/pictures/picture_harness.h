// Draws one scene with the engine, the reference renderer and, if it supports the scene, Mesa, and defines
// when two of the pictures count as equal.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "tests/reference/compare.h"

namespace tessera::test {

/// Fractions of pixels that may differ by more than reference::kTolerance levels: of interior pixels (where
/// the reference is smooth, see reference::kInteriorSpan) and of all pixels.
///
/// Rounded down to whole pixels, so pictures of fewer than 200 pixels may not differ at all. Small pictures
/// are not at a disadvantage: both fractions allow for rounding at edges and between stored levels, whose
/// probability per pixel does not depend on the size.
inline constexpr double kInteriorShare = 0.001;
inline constexpr double kWholeShare = 0.005;

bool obeys_rule(const reference::Comparison& comparison);

/// 3 bytes per pixel, rows from the top; empty if there is no picture.
using Rgb = std::vector<std::uint8_t>;

struct ThreeWayReport {
  std::string name;  ///< name of the scene file without folder and extension
  int width_px = 0, height_px = 0;
  Rgb engine;
  Rgb reference;
  Rgb mesa;
  std::string mesa_cannot;  ///< why Mesa does not support the scene; empty if it does
  reference::Comparison engine_to_reference;
  reference::Comparison mesa_to_reference;  ///< this and the next are empty without Mesa's picture
  reference::Comparison engine_to_mesa;     ///< interior pixels according to Mesa's picture

  bool is_good() const;
  std::string text() const;
};

/// Draws a scene file with all three renderers and compares the pictures.
///
/// @param options  of the engine's renderer
/// @throws std::exception if one of the three cannot read or draw the scene.
ThreeWayReport compare_three_ways(const std::string& path, const RendererOptions& options = {});

/// Writes the pictures and their differences (multiplied by 16) into the folder named by the environment
/// variable TESSERA_PICTURES; default: `tessera_pictures` in the temporary folder.
/// @return the folder
std::string write_pictures(const ThreeWayReport& report);

}  // namespace tessera::test
