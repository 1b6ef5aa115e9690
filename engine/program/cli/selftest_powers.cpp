// Measures powers through highlights. With a directional light along the view, the cosine of the highlight is
// the normal's z, so the colour of a vertex is emission + specular * z^shininess. The emission brings the
// exact colour to 1/2. With specular = 2^18, an error of one unit in the last place (ulp) of a power in 1/2
// .. 1, 2^-24, changes the colour by 1/64. Specular is doubled for each octave of smaller powers.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "engine/program/cli/selftest_checks.h"
#include "engine/program/scene/fingerprint.h"

namespace tessera::program::cli {
namespace {

constexpr int kOctaves = 8;                      // powers of at least 1/256
constexpr double kMeasurementUlps = 64 / 510.0;  // a stored level is known to 1/510 of full colour

/// Error bound in ulp. Powers with whole exponents up to 64 are products of exponent - 1 roundings. The other
/// exponents have the bound of tests/shading/power_test.cpp, which holds for those tested here; for arbitrary
/// exponents 15.6 is guaranteed (tests/numerics/README.md).
double bound_ulps(float exponent) {
  const bool is_product = exponent == std::floor(exponent) && exponent <= 64;
  return is_product ? std::max(double{exponent} - 1, 1.0) : 14;
}

/// One point at the centre of each pixel, rows from the bottom, with powers in 2^-(octave + 1) .. 2^-octave.
struct Powers {
  float exponent;
  double specular;
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> emissions;
  std::vector<double> exact;

  Powers(float y, int octave) : exponent(y), specular(std::ldexp(1.0, 18 + octave)) {
    for (int i = 0; i < kFramePoints; ++i) {
      const double wanted = std::ldexp(1 + (i + 0.5) / kFramePoints, -octave - 1);
      const auto x = static_cast<float>(std::pow(wanted, 1 / double{y}));
      exact.push_back(std::pow(double{x}, double{y}));
      const auto emission = static_cast<float>(0.5 - specular * exact.back());
      positions.insert(positions.end(),
                       {(static_cast<float>(i % kFrameSide) + 0.5f) / (kFrameSide / 2) - 1,
                        (static_cast<float>(i / kFrameSide) + 0.5f) / (kFrameSide / 2) - 1, 0});
      normals.insert(normals.end(), {0, 0, x});
      emissions.insert(emissions.end(), {emission, emission, emission, 1});
    }
  }

  std::vector<std::uint32_t> drawn(Renderer& renderer) const {
    DrawState state{.color_material = ColorMaterial::emission, .normalize = false};
    const auto s = static_cast<float>(specular);
    state.material = {.ambient = {0, 0, 0, 1},
                      .diffuse = {0, 0, 0, 1},
                      .specular = {s, s, s, 1},
                      .emission = {0, 0, 0, 1},
                      .shininess = exponent};
    state.depth.enabled = false;
    FrameBuffer buffer({.width = kFrameSide, .height = kFrameSide});
    Frame frame(buffer);
    frame.set_lights({Light{.position = {0, 0, 1, 0}}});
    frame.set_light_model({.ambient = {0, 0, 0, 1}});
    frame.clear({.color = Color{0, 0, 0, 1}});
    frame.draw(
        {.primitive = Primitive::points, .positions = positions, .normals = normals, .colors = emissions},
        state);
    renderer.finish(frame);
    return packed_colors(buffer);  // rows from the top
  }

  double largest_error_ulps(Renderer& renderer) const {
    const std::vector<std::uint32_t> colors = drawn(renderer);
    double largest = 0;
    for (int i = 0; i < kFramePoints; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto pixel =
          static_cast<std::size_t>((kFrameSide - 1 - i / kFrameSide) * kFrameSide + i % kFrameSide);
      const double found = ((colors[pixel] & 255) / 255.0 - double{emissions[4 * at]}) / specular;
      largest = std::max(largest, std::abs(found - exact[at]) / std::ldexp(1.0, std::ilogb(exact[at]) - 23));
    }
    return largest;
  }
};

/// Formats as "14" or "9.9".
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", value == std::floor(value) ? 0 : 1, value);
  return text;
}

}  // namespace

CheckReport check_powers(const Configurations& configurations) {
  std::vector<Powers> powers;
  for (const float exponent : {0.5f, 2.0f, 20.0f, 128.0f, 10000.0f})
    for (int octave = 0; octave < kOctaves; ++octave) powers.emplace_back(exponent, octave);
  CheckReport report{.name = "powers, pow() in double", .measured = {}, .first_failure = {}};
  double largest = 0;
  double share = 0;  // largest error as a fraction of its bound
  for (const RendererOptions& configuration : configurations) {
    Renderer renderer(configuration);
    for (const Powers& p : powers) {
      const double error = p.largest_error_ulps(renderer);
      // Colours saturate at black or white, so errors above 31 ulp are reported too small: "or more".
      if (error > bound_ulps(p.exponent) + kMeasurementUlps)
        report.add("the error of x^" + number(p.exponent) + " is " + number(error) +
                       " ulp or more, must be at most " + number(bound_ulps(p.exponent)),
                   configuration);
      largest = std::max(largest, error);
      share = std::max(share, (error - kMeasurementUlps) / bound_ulps(p.exponent));
    }
  }
  report.measured = std::to_string(powers.size() * kFramePoints * configurations.size()) + " powers, error " +
                    number(largest) + " ulp, " + number(std::ceil(100 * share)) + " % of its bound";
  return report;
}

}  // namespace tessera::program::cli
