// Renderers for the hard cases: Tessera, and Mesa with the same steps for its column in the table of bounds.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

/// An unlit draw without culling, in clip space or in the space that `transform` maps to clip space.
struct CaseDraw {
  Primitive primitive = Primitive::triangles;
  std::vector<float> positions{};        ///< x y z w
  std::vector<float> colors{};           ///< r g b a per vertex; empty: `color`
  std::vector<float> texcoords{};        ///< s t per vertex, for textured draws
  std::vector<std::uint32_t> indices{};  ///< empty: vertices in order
  Color color{1, 1, 1, 1};
  bool add = false;         ///< additive blending
  bool test_depth = false;  ///< false: depth is neither tested nor written
  Compare depth_func = Compare::less;
  double depth_near = 0, depth_far = 1;
  std::optional<Rect> viewport{};     ///< none: the whole buffer
  bool textured = false;              ///< uses the texture of the case instead of the colour
  std::optional<Matrix> transform{};  ///< to clip space, in double; Mesa converts it to float
  PolygonOffset offset{};             ///< for filled triangles
};

struct CaseFormat {
  int width = 64, height = 64;
  DepthFormat depth = DepthFormat::none;
  bool reversed = false;  ///< z runs 0..w, depth is z/w
  double cleared_depth = 1;
  /// Luminance texture, rows from the bottom, repeat wrapping. Filter: linear from level 0, or nearest.
  int texture_width = 0, texture_height = 0;
  std::vector<std::uint8_t> texture{};
  bool nearest_texel = false;
};

/// Rows from the top.
struct CasePicture {
  std::vector<std::array<float, 3>> colors;  ///< multiples of 1/255 for Tessera
  std::vector<std::uint32_t> depth;          ///< levels, or float bits; empty without a depth buffer
};

class CaseRenderer {
 public:
  virtual ~CaseRenderer() = default;
  /// Renders a frame cleared to black and to `cleared_depth`.
  virtual const CasePicture& draw(const std::vector<CaseDraw>& draws) = 0;
  /// Number of times each pixel was covered, given draws that add 1/255 of blue each.
  std::vector<int> count(const std::vector<CaseDraw>& draws);
};

using MakeRenderer = std::function<std::unique_ptr<CaseRenderer>(const CaseFormat&)>;

std::unique_ptr<CaseRenderer> make_tessera(const CaseFormat& format,
                                           const RendererOptions& options = {.threads = 1});
/// Returns null if the tests are built without OSMesa.
/// @throws std::runtime_error for features that Mesa lacks
std::unique_ptr<CaseRenderer> make_mesa(const CaseFormat& format);

/// Measures a figure of Tessera, expects it to be within `promised` (bounds.h), and reports Mesa's figure in
/// the same row.
///
/// @param figure draws with renderers made by `make`. `is_tessera` is false for Mesa, which always runs the
///     short set of cases.
void expect_figure(const std::string& quantity, long double promised, const std::string& unit,
                   const std::function<long double(const MakeRenderer& make, bool is_tessera)>& figure);

}  // namespace tessera::test
