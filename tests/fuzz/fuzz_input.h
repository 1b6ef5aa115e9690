// Numbers drawn from a fuzzer's bytes, biased towards difficult values. All are 0 once the bytes are used up.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tessera::fuzz {

class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  std::uint32_t word() {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits |= std::uint32_t{byte()} << 8 * k;
    return bits;
  }
  bool coin() { return (byte() & 1) != 0; }
  /// True once in 64 times.
  bool rarely() { return byte() >= 252; }
  /// @pre  n is 1 .. 256
  int below(int n) { return byte() % n; }
  template <class Enum>
  Enum one_of(int count) {
    return static_cast<Enum>(below(count));
  }

  /// Any double: mostly of a size that lies within a picture, often on a grid that meets pixel centres and
  /// edges.
  double real() {
    const int kind = byte();
    if (kind < 128) return static_cast<std::int8_t>(byte()) / 64.0;
    if (kind < 192) {
      const int low = byte();
      return (static_cast<std::int8_t>(byte()) * 256 + low) / 4096.0;
    }
    if (kind < 224) return kOdd[kind - 192];
    if (kind < 240) return std::ldexp(kind < 232 ? 1.0 : -1.0, static_cast<std::int8_t>(byte()));
    if (kind < 252) {
      const std::uint32_t bits = word();
      float x;
      std::memcpy(&x, &bits, sizeof x);
      return x;
    }
    const std::uint64_t bits = word() | std::uint64_t{word()} << 32;
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }
  /// The same distribution as a float; values out of range become infinite.
  float real32() { return as_float(real()); }
  /// Nearly always finite, for inputs that must be finite.
  double finite() {
    return nearly_always(real(), [](double x) { return std::isfinite(x); });
  }
  float finite32() {
    return as_float(
        nearly_always(real(), [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); }));
  }
  /// Nearly always 0 .. 1, the ends often.
  float unit() {
    const int kind = byte();
    if (kind < 16) return 0;
    if (kind <= 200) return static_cast<float>(kind) / 255.0f;
    if (kind < 250) return 1;
    if (kind == 252) return 1 - 0x1p-24f;
    if (kind == 253) return std::numeric_limits<float>::denorm_min();
    if (kind == 254) return -0.0f;
    return kind == 255 && byte() >= 252 ? real32() : 0.5f;
  }
  /// Mostly low .. high, else far outside.
  int integer(int low, int high) {
    constexpr int kLimits[] = {std::numeric_limits<int>::min(),
                               std::numeric_limits<int>::max(),
                               -1,
                               0,
                               16384,
                               16385,
                               -16385,
                               1 << 20,
                               -(1 << 20),
                               std::numeric_limits<int>::max() - 1};
    const int kind = byte();
    if (kind >= 254) return kLimits[below(10)];
    const int more = high - low >= 254 ? byte() : 0;
    return low + (kind + 254 * more) % (high - low + 1);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kOdd[32] = {
      kNan,     kNan,      kNan,     kInfinity,      -kInfinity,      kInfinity,   0.0,    -0.0,
      0x1p-149, -0x1p-149, 0x1p-126, 0x1.fffffep127, -0x1.fffffep127, 1e30,        -1e30,  1e-30,
      0.5,      1.0,       -1.0,     0x1p-12,        1 + 0x1p-23,     1 - 0x1p-24, 0x1p24, 0x1p31,
      -0x1p31,  1.0 / 3,   16384.0,  -16384.0,       180.0,           255.0,       1e300,  0x1p-1074};

  static float as_float(double x) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (x > kLargest) return std::numeric_limits<float>::infinity();
    if (x < -kLargest) return -std::numeric_limits<float>::infinity();
    return static_cast<float>(x);
  }
  template <class Wanted>
  double nearly_always(double x, const Wanted& wanted) {
    return wanted(x) || rarely() ? x : 0.5;
  }

  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace tessera::fuzz
