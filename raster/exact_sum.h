// Exact sums of doubles and of their products.
#pragma once

#include <cmath>
#include <limits>

namespace tessera::detail {

/// An exact sum as an expansion: non-overlapping doubles, the smallest first.
/// - Exact if every nonzero product is at least 2^-960 in magnitude. NaN after any overflow.
///
/// Source: J. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
/// 1997 (grow-expansion, compress).
class ExactSum {
 public:
  void add(double term) {
    if (count_ == kMaxParts) compress();
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      // The sum and its exact rounding error.
      const double sum = term + parts_[i];
      const double term_part = sum - parts_[i];
      const double error = (parts_[i] - (sum - term_part)) + (term - term_part);
      if (error != 0) parts_[kept++] = error;
      term = sum;
    }
    if (!std::isfinite(term)) {  // the errors are NaN, which compress() cannot reduce
      kept = 0;
      term = std::numeric_limits<double>::quiet_NaN();
    }
    if (term != 0) parts_[kept++] = term;
    count_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  /// Adds a b 2^exponent. Only this product must be within the range of doubles, not a b itself.
  void add_product(double a, double b, int exponent) {
    int exponent_a, exponent_b;
    a = std::frexp(a, &exponent_a);
    b = std::frexp(b, &exponent_b);
    const double product = a * b;
    add(std::scalbn(std::fma(a, b, -product), exponent_a + exponent_b + exponent));
    add(std::scalbn(product, exponent_a + exponent_b + exponent));
  }
  void add_product(const ExactSum& a, double b) {
    for (int i = 0; i < a.count_; ++i) add_product(a.parts_[i], b);
  }
  /// Adds the product of two sums times `sign`, 1 or -1.
  void add_product(const ExactSum& a, const ExactSum& b, double sign) {
    for (int i = 0; i < b.count_; ++i) add_product(a, b.parts_[i] * sign);
  }
  /// Rounded value; relative error below 2^-52.
  double value() const {
    double sum = 0;
    for (int i = 0; i < count_; ++i) sum += parts_[i];
    return sum;
  }

 private:
  // Compressed parts have 53 bits each, so 40 of them span 2^1023 to 2^-1074.
  static constexpr int kMaxParts = 64;

  void compress() {
    double sum = parts_[count_ - 1];
    int bottom = count_ - 1;
    for (int i = count_ - 2; i >= 0; --i) {
      const double larger = sum + parts_[i];
      const double rest = parts_[i] - (larger - sum);
      sum = larger;
      if (rest == 0) continue;
      parts_[bottom--] = larger;
      sum = rest;
    }
    int top = 0;
    for (int i = bottom + 1; i < count_; ++i) {
      const double larger = parts_[i] + sum;
      const double rest = sum - (larger - parts_[i]);
      sum = larger;
      if (rest != 0) parts_[top++] = rest;
    }
    parts_[top++] = sum;
    count_ = top;
  }

  double parts_[kMaxParts];
  int count_ = 0;
};

}  // namespace tessera::detail
