// Lane indices of compress_lanes() and expand_lanes(), for every mask at every vector width.
#include <gtest/gtest.h>

#include <vector>

#include "raster/lane_packing.h"

namespace tessera::detail::lane_packing_test {
namespace {

template <int kLanes>
void check_every_mask() {
  for (std::uint32_t bits = 0; bits < 1u << kLanes; ++bits) {
    std::vector<int> set;
    for (int l = 0; l < kLanes; ++l)
      if ((bits >> l & 1) != 0) set.push_back(l);
    const LaneShuffle packing = compress_lanes<kLanes>(bits), unpacking = expand_lanes<kLanes>(bits);
    for (std::size_t j = 0; j < set.size(); ++j) {
      ASSERT_EQ(packing.byte[j], set[j]) << "lanes " << bits;
      ASSERT_EQ(unpacking.byte[set[j]], j) << "lanes " << bits;
    }
    for (int l = 0; l < kLanes; ++l) {  // unused indices are looked up too and must be valid
      ASSERT_LT(packing.byte[l], 16) << "lanes " << bits;
      ASSERT_LT(unpacking.byte[l], 16) << "lanes " << bits;
    }
  }
}

TEST(LanePacking, IndexesOneLane) { check_every_mask<1>(); }
TEST(LanePacking, IndexesFourLanes) { check_every_mask<4>(); }
TEST(LanePacking, IndexesEightLanes) { check_every_mask<8>(); }
TEST(LanePacking, IndexesSixteenLanes) { check_every_mask<16>(); }

}  // namespace
}  // namespace tessera::detail::lane_packing_test
