#include "framebuffer/tessera/rgb_primaries.hpp"

namespace tessera {
namespace {

// Cone responses from XYZ [Lam, 1985; ICC.1:2022, annex E].
constexpr ColorMatrix kBradford{{{{.8951, .2664, -.1614}, {-.7502, 1.7135, .0367}, {.0389, -.0685, 1.0296}}}};

constexpr ColorMatrix diagonal(const ColorValues& v) {
  return {{{{v[0], 0, 0}, {0, v[1], 0}, {0, 0, v[2]}}}};
}

/// The matrix with these columns.
constexpr ColorMatrix of_columns(const ColorValues& a, const ColorValues& b, const ColorValues& c) {
  return {{{{a[0], b[0], c[0]}, {a[1], b[1], c[1]}, {a[2], b[2], c[2]}}}};
}

}  // namespace

// Cofactors over the determinant.
ColorMatrix inverse(const ColorMatrix& m) {
  const auto& r = m.rows;
  const auto cofactor = [&r](std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return r[i1][j1] * r[i2][j2] - r[i1][j2] * r[i2][j1];
  };
  const double determinant = r[0][0] * cofactor(0, 0) + r[0][1] * cofactor(0, 1) + r[0][2] * cofactor(0, 2);
  ColorMatrix result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result.rows[j][i] = cofactor(i, j) / determinant;
  return result;
}

ColorValues xyz_of(Chromaticity chromaticity) {
  const auto [x, y] = chromaticity;
  return {x / y, 1, (1 - x - y) / y};
}

// XYZ of the primaries, each scaled so that their sum is the white.
ColorMatrix xyz_from_rgb_light(const RgbPrimaries& primaries) {
  const ColorMatrix unscaled =
      of_columns(xyz_of(primaries.red), xyz_of(primaries.green), xyz_of(primaries.blue));
  return unscaled * diagonal(inverse(unscaled) * xyz_of(primaries.white));
}

ColorMatrix adaptation_matrix(Chromaticity from, Chromaticity to, ChromaticAdaptation adaptation) {
  if (adaptation == ChromaticAdaptation::none || from == to) return diagonal({1, 1, 1});
  const ColorValues cones_from = kBradford * xyz_of(from);
  const ColorValues cones_to = kBradford * xyz_of(to);
  const ColorMatrix scale =
      diagonal({cones_to[0] / cones_from[0], cones_to[1] / cones_from[1], cones_to[2] / cones_from[2]});
  return inverse(kBradford) * scale * kBradford;
}

}  // namespace tessera
