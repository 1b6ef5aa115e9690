// A NaN must never pass as a measurement within its bound.
#include <gtest/gtest.h>

#include <limits>

#include "tests/numerics/bounds.h"

namespace tessera::test::bounds_test {
namespace {

template <class Number>
void expect_nan_to_be_the_worst() {
  constexpr Number kNaN = std::numeric_limits<Number>::quiet_NaN();
  constexpr Number kMax = std::numeric_limits<Number>::max();
  Number worst = 0;
  update_worst(worst, Number{2}, Number{1});
  EXPECT_EQ(worst, 2);
  update_worst(worst, kNaN);
  EXPECT_GT(worst, kMax);
  update_worst(worst, kMax, kNaN);
  EXPECT_GT(worst, kMax);
  Number first = 0;
  Number middle = 0;
  update_worst(first, kNaN, Number{1});
  update_worst(middle, Number{1}, -kNaN, Number{2});
  EXPECT_GT(first, kMax);
  EXPECT_GT(middle, kMax);
}

TEST(Bounds, NanExceedsEveryBound) {
  expect_nan_to_be_the_worst<float>();
  expect_nan_to_be_the_worst<double>();
  expect_nan_to_be_the_worst<long double>();
}

}  // namespace
}  // namespace tessera::test::bounds_test
