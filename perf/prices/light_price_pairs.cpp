// Prices of lights and of their effects.
#include <utility>

#include "perf/prices/price_pairs.h"

namespace tessera::bench {
namespace {

Light directional() { return {.position = {0.3f, 0.2f, 1, 0}}; }
Light positional() { return {.position = {1, 1, 2, 1}}; }

PriceFrame with_lights(PriceFrame frame, std::vector<Light> lights) {
  frame.lights = std::move(lights);
  return frame;
}

void add_highlight(PriceFrame& frame) {
  frame.state.material.specular = {0.5f, 0.5f, 0.5f, 1};
  frame.state.material.shininess = 30;
}
void add_cone(PriceFrame& frame) {
  Light& light = frame.lights.front();
  light.spot_direction = {-0.2f, -0.2f, -1};
  light.spot_cutoff = 80;
  light.spot_exponent = 4;
}

/// A second and a third light of the same kind.
PricePair two_lights_more(PriceItem item, const PriceFrame& lit, const Light& light) {
  return {.item = item,
          .with = with_lights(lit, {light, light, light}),
          .without = with_lights(lit, {light}),
          .count = 2};
}

}  // namespace

PriceFrame lit_from_afar(PriceFrame lit) { return with_lights(std::move(lit), {directional()}); }

std::vector<PricePair> light_price_pairs(const PriceFrame& lit, const LightPrices& prices) {
  const PriceFrame one = lit_from_afar(lit);
  const PriceFrame near = with_lights(lit, {positional()});
  const PriceFrame shiny = changed(one, add_highlight);
  return {
      two_lights_more(prices.directional, lit, directional()),
      two_lights_more(prices.point, lit, positional()),
      {.item = prices.attenuation,
       .with = changed(near, [](PriceFrame& f) { f.lights.front().attenuation_quadratic = 0.1f; }),
       .without = near},
      {.item = prices.spot, .with = changed(near, add_cone), .without = near},
      {.item = prices.highlight, .with = shiny, .without = one},
      {.item = prices.local_viewer,
       .with = changed(shiny, [](PriceFrame& f) { f.light_model.local_viewer = true; }),
       .without = shiny},
      {.item = prices.second_side,
       .with = changed(one, [](PriceFrame& f) { f.light_model.two_sided = true; }),
       .without = one},
  };
}

}  // namespace tessera::bench
