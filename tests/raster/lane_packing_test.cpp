// Numbers of packed lanes, for every set of lanes of every width: kernels of each instruction set look lanes
// up by them.
#include <gtest/gtest.h>

#include <vector>

#include "raster/lane_packing.h"

namespace tessera::detail {
namespace {

template <int kLanes>
void check_every_set() {
  for (std::uint32_t bits = 0; bits < 1u << kLanes; ++bits) {
    std::vector<int> set;
    for (int l = 0; l < kLanes; ++l)
      if ((bits >> l & 1) != 0) set.push_back(l);
    const LaneShuffle packing = compress_lanes<kLanes>(bits), unpacking = expand_lanes<kLanes>(bits);
    for (std::size_t j = 0; j < set.size(); ++j) {
      ASSERT_EQ(packing.byte[j], set[j]) << "lanes " << bits;
      ASSERT_EQ(unpacking.byte[set[j]], j) << "lanes " << bits;
    }
    for (int l = 0; l < kLanes; ++l) {  // looked up, whether used or not
      ASSERT_LT(packing.byte[l], 16) << "lanes " << bits;
      ASSERT_LT(unpacking.byte[l], 16) << "lanes " << bits;
    }
  }
}

TEST(LanePacking, NumbersOneLane) { check_every_set<1>(); }
TEST(LanePacking, NumbersFourLanes) { check_every_set<4>(); }
TEST(LanePacking, NumbersEightLanes) { check_every_set<8>(); }
TEST(LanePacking, NumbersSixteenLanes) { check_every_set<16>(); }

}  // namespace
}  // namespace tessera::detail
