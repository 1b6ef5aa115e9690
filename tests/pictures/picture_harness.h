// One scene, three pictures: by the engine, by the reference renderer and, where it can follow, by Mesa; and
// the rule by which two of them count as the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "tests/reference/compare.h"

namespace tessera::test {

/// Shares of pixels that may differ by more than reference::kTolerance levels: of the interior ones (where
/// the reference is smooth, see reference::kInteriorSpan) and of all.
///
/// Rounded down to whole pixels, so pictures of less than 200 pixels may not differ at all. That asks nothing
/// unfair of them: both shares stand for rounding, at edges and between stored levels, whose chance is the
/// same for each pixel, so that a small picture is as likely to have none as a large one is to stay below its
/// share.
inline constexpr double kInteriorShare = 0.001;
inline constexpr double kWholeShare = 0.005;

bool obeys_rule(const reference::Comparison& comparison);

/// 3 bytes a pixel, rows from the top; empty if there is no such picture.
using Rgb = std::vector<std::uint8_t>;

struct ThreeWayReport {
  std::string name;  ///< the scene file's, without folder and ending
  int width_px = 0, height_px = 0;
  Rgb engine, reference, mesa;
  std::string mesa_cannot;  ///< why Mesa cannot follow; empty if it can
  reference::Comparison engine_to_reference;
  reference::Comparison mesa_to_reference;  ///< this and the next are empty if Mesa cannot follow
  reference::Comparison engine_to_mesa;     ///< interior pixels by Mesa's picture

  bool is_good() const;
  std::string text() const;
};

/// Draws a scene file three times and compares.
///
/// @param options  of the engine's renderer.
/// @throws std::exception if one of the three cannot read or draw the scene.
ThreeWayReport compare_three_ways(const std::string& path, const RendererOptions& options = {});

/// Writes the pictures and their differences (16 times as strong) into the folder that the environment
/// variable TESSERA_PICTURES names, `tessera_pictures` among the temporary files by default.
/// @return the folder
std::string write_pictures(const ThreeWayReport& report);

}  // namespace tessera::test
