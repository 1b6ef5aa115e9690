// What is measured cannot pass for want of a number.
#include <gtest/gtest.h>

#include <limits>

#include "tests/numerics/bounds.h"

namespace tessera::test {
namespace {

template <class Number>
void expect_nan_to_be_the_worst() {
  constexpr Number kNaN = std::numeric_limits<Number>::quiet_NaN(),
                   kMost = std::numeric_limits<Number>::max();
  Number worst = 0;
  update_worst(worst, Number{2}, Number{1});
  EXPECT_EQ(worst, 2);
  update_worst(worst, kNaN);
  EXPECT_GT(worst, kMost);
  update_worst(worst, kMost, kNaN);
  EXPECT_GT(worst, kMost);
  Number first = 0, middle = 0;
  update_worst(first, kNaN, Number{1});
  update_worst(middle, Number{1}, -kNaN, Number{2});
  EXPECT_GT(first, kMost);
  EXPECT_GT(middle, kMost);
}

TEST(Bounds, ANanIsBeyondEachOfThem) {
  expect_nan_to_be_the_worst<float>();
  expect_nan_to_be_the_worst<double>();
  expect_nan_to_be_the_worst<long double>();
}

}  // namespace
}  // namespace tessera::test
