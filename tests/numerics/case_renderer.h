// What draws the hard cases: Tessera, and Mesa by the same steps, for a row of its own in the table of
// bounds.
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

/// A draw in clip space, or in one that `transform` carries there; unlit. Nothing is culled.
struct CaseDraw {
  Primitive primitive = Primitive::triangles;
  std::vector<float> positions{};        ///< x y z w
  std::vector<float> colors{};           ///< r g b a for each vertex; empty: `color`
  std::vector<float> texcoords{};        ///< s t for each vertex, with a texture
  std::vector<std::uint32_t> indices{};  ///< empty: vertices in order
  Color color{1, 1, 1, 1};
  bool add = false;         ///< colours are added to those that are there
  bool test_depth = false;  ///< false: depth is neither tested nor written
  Compare depth_func = Compare::less;
  double depth_near = 0, depth_far = 1;
  std::optional<Rect> viewport{};     ///< absent: the whole buffer
  bool textured = false;              ///< with the case's texture, in place of the colour
  std::optional<Matrix> transform{};  ///< to clip space, in double; Mesa makes floats of it
  PolygonOffset offset{};             ///< of filled triangles
};

struct CaseFormat {
  int width = 64, height = 64;
  DepthFormat depth = DepthFormat::none;
  bool reversed = false;  ///< z runs 0..w, depth is z/w
  double cleared_depth = 1;
  /// A texture of luminances, rows from the bottom, repeated, filtered linearly from level 0, or the nearest
  /// texel.
  int texture_width = 0, texture_height = 0;
  std::vector<std::uint8_t> texture{};
  bool nearest_texel = false;
};

/// Rows from the top.
struct CasePicture {
  std::vector<std::array<float, 3>> colors;  ///< Tessera's are 255ths
  std::vector<std::uint32_t> depth;          ///< levels, or the bits of floats; empty without a depth buffer
};

class CaseRenderer {
 public:
  virtual ~CaseRenderer() = default;
  /// A frame that starts black, with the depth that the format says.
  virtual const CasePicture& draw(const std::vector<CaseDraw>& draws) = 0;
  /// How often each pixel was covered, if all that is drawn adds one 255th of blue.
  std::vector<int> count(const std::vector<CaseDraw>& draws);
};

using MakeRenderer = std::function<std::unique_ptr<CaseRenderer>(const CaseFormat&)>;

std::unique_ptr<CaseRenderer> make_tessera(const CaseFormat& format,
                                           const RendererOptions& options = {.threads = 1});
/// Null where the tests are built without OSMesa. Throws std::runtime_error for what it cannot do.
std::unique_ptr<CaseRenderer> make_mesa(const CaseFormat& format);

/// Measures a figure of Tessera and expects it within what is promised (bounds.h), then puts Mesa's beside
/// it.
///
/// @param figure  draws with the renderers that it is given a maker of. `is_tessera` is false for Mesa, of
/// which the usual number of
///     cases is enough in a long run, too.
void expect_figure(const std::string& quantity, long double promised, const std::string& unit,
                   const std::function<long double(const MakeRenderer& make, bool is_tessera)>& figure);

}  // namespace tessera::test
