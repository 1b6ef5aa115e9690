// The pairs of frames from which the prices come.
#pragma once

#include <vector>

#include "perf/prices/price_frame.h"

namespace tessera::bench {

/// A price is the time of `with` minus that of `without`, minus the price of `known` work, per unit.
/// - The number of units is that of `with` if both frames have the same number, else the difference. The same
///   holds for known items.
struct PricePair {
  PriceItem item;
  PriceFrame with;
  std::optional<PriceFrame> without{};  ///< absent: nothing, the price is that of `with`
  std::vector<PriceItem> known{};    ///< items that `with` has in addition; their prices are measured before
  std::vector<PriceItem> instead{};  ///< items that `with` lacks: their prices are added
  bool has_known_triangles = false;  ///< the triangles that `with` has in addition, by their size
  int count = 1;                     ///< units per counted thing: 2 if `with` has two lights more
};

/// One pair per item, in an order in which known items come first.
std::vector<PricePair> price_pairs();

/// The prices of lights and of their effects, at vertices or at pixels.
struct LightPrices {
  PriceItem directional, point, attenuation, spot, highlight, local_viewer, second_side;
};
/// @param lit  a lit frame without lights
std::vector<PricePair> light_price_pairs(const PriceFrame& lit, const LightPrices& prices);
/// The frame with one directional light and no highlight.
PriceFrame lit_from_afar(PriceFrame lit);

// Parts of price_pairs().
std::vector<PricePair> frame_price_pairs();
std::vector<PricePair> vertex_price_pairs();
std::vector<PricePair> triangle_price_pairs();
std::vector<PricePair> operation_price_pairs();
std::vector<PricePair> shading_price_pairs();

/// A frame with a change.
template <class Change>
PriceFrame changed(PriceFrame frame, const Change& change) {
  change(frame);
  return frame;
}

}  // namespace tessera::bench
