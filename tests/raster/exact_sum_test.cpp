// Exact sums: terms that are added and then subtracted in another order cancel exactly.
#include "raster/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace tessera::test::exact_sum_test {
using namespace detail;
namespace {

struct Terms {
  std::mt19937 random;
  explicit Terms(unsigned seed) : random(seed) {}
  // Terms of few bits leave gaps between the parts of a sum, so that it has many parts.
  double term(int lowest, int highest, int bits) {
    const double mantissa = static_cast<double>(random() >> (32 - std::min(bits, 32))) +
                            (bits > 32 ? static_cast<double>(random() >> 12) * 0x1p-20 : 0);
    const double value = std::ldexp(
        mantissa + 1, lowest + static_cast<int>(random() % static_cast<unsigned>(highest - lowest + 1)));
    return random() % 2 != 0 ? value : -value;
  }
};

TEST(ExactSum, CancelsExactly) {
  for (unsigned round = 0; round < 2000; ++round) {
    Terms terms(round);
    const int reach = round % 3 == 0 ? 20 : 900, bits = round % 2 == 0 ? 1 : 52;
    std::vector<double> all;
    for (int i = 0; i < 300; ++i) all.push_back(terms.term(-reach, reach, bits));
    ExactSum sum;
    for (const double term : all) sum.add(term);
    const double last = terms.term(-reach, reach, bits);
    sum.add(last);
    std::shuffle(all.begin(), all.end(), terms.random);
    for (const double term : all) sum.add(-term);
    ASSERT_EQ(sum.value(), last) << "round " << round;
  }
}

TEST(ExactSum, ProductOfSumsEqualsSumOfProducts) {
  for (unsigned round = 0; round < 2000; ++round) {
    Terms terms(round);
    const int reach = round % 2 == 0 ? 10 : 200;
    ExactSum a, b, difference;
    std::vector<double> of_a, of_b;
    for (int i = 0; i < 6; ++i) {
      of_a.push_back(terms.term(-reach, reach, 52));
      of_b.push_back(terms.term(-reach, reach, 52));
      a.add(of_a.back());
      b.add(of_b.back());
    }
    difference.add_product(a, b, 1);
    for (const double x : of_a)
      for (const double y : of_b) difference.add_product(-x, y);
    ASSERT_EQ(difference.value(), 0) << "round " << round;
    difference.add_product(b, a, -1);
    difference.add_product(a, b, 1);
    ASSERT_EQ(difference.value(), 0) << "round " << round;
  }
}

TEST(ExactSum, ValueIsAccurateToTheLastBit) {
  for (unsigned round = 0; round < 20000; ++round) {
    Terms terms(round);
    ExactSum sum;
    __extension__ __int128 exact = 0;
    for (int i = 0; i < 10; ++i) {
      const double term = std::trunc(terms.term(0, 60, 52));
      exact += static_cast<__int128>(term);
      sum.add(term);
    }
    const double expected = static_cast<double>(exact);
    ASSERT_NEAR(sum.value(), expected, std::abs(expected) * 0x1p-52) << "round " << round;
  }
}

TEST(ExactSum, ScaledProductsCancelExactly) {
  for (unsigned round = 0; round < 2000; ++round) {
    Terms terms(round);
    const double a = terms.term(-900, 900, 52);
    const double b = terms.term(-30, 30, 52);
    const int exponent = static_cast<int>(round % 200) - 100 - std::ilogb(a);
    ExactSum sum;
    sum.add_product(a, b, exponent);
    sum.add_product(-std::scalbn(a, exponent), b);
    ASSERT_EQ(sum.value(), 0) << "round " << round;
  }
}

// For every kind of overflow, and any number of later terms.
TEST(ExactSum, StaysNanAfterOverflow) {
  for (const double large :
       {0x1p1023, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    ExactSum sum, product;
    for (int i = 0; i < 300; ++i) {
      sum.add(std::ldexp(1, i % 2 == 0 ? -3 * i : 3 * i));
      if (i % 50 == 49) sum.add(large), sum.add(large), sum.add(-large);
    }
    EXPECT_TRUE(std::isnan(sum.value())) << large;
    product.add_product(sum, sum, 1);
    EXPECT_TRUE(std::isnan(product.value())) << large;
  }
}

}  // namespace
}  // namespace tessera::test::exact_sum_test
