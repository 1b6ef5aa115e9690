#include "inflate.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tessera::reference {
namespace {

class Bits {
 public:
  explicit Bits(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  unsigned bit() {
    if (at_ / 8 >= bytes_.size()) throw std::runtime_error("compressed data that ends early");
    const unsigned value = bytes_[at_ / 8] >> at_ % 8 & 1u;
    ++at_;
    return value;
  }

  /// Reads a number, least significant bit first.
  unsigned number(int bits) {
    unsigned value = 0;
    for (int i = 0; i < bits; ++i) value |= bit() << i;
    return value;
  }

  void align() { at_ = (at_ + 7) / 8 * 8; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// A canonical Huffman code: codes of equal length are assigned in symbol order.
class Huffman {
 public:
  explicit Huffman(std::span<const int> lengths) {
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol)
      if (lengths[symbol] > 0)
        symbols_[static_cast<std::size_t>(lengths[symbol])].push_back(static_cast<unsigned>(symbol));
  }

  unsigned symbol(Bits& bits) const {
    unsigned code = 0;
    unsigned first = 0;
    for (std::size_t length = 1; length < symbols_.size(); ++length) {
      code = 2 * code + bits.bit();
      first *= 2;
      const auto count = static_cast<unsigned>(symbols_[length].size());
      if (code - first < count) return symbols_[length][code - first];
      first += count;
    }
    throw std::runtime_error("compressed data with an unknown code");
  }

 private:
  std::array<std::vector<unsigned>, 16> symbols_;  // by code length
};

constexpr unsigned kEnd = 256;

constexpr std::array<unsigned, 29> kLengths{3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                            31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<int, 29> kLengthBits{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                          2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<unsigned, 30> kDistances{1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                              33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                              1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};

int distance_bits(std::size_t symbol) { return symbol < 4 ? 0 : static_cast<int>(symbol / 2 - 1); }

struct Codes {
  Huffman literals;
  Huffman distances;
};

Codes fixed_codes() {
  std::array<int, 288> literals;
  literals.fill(8);
  std::fill(literals.begin() + 144, literals.begin() + 256, 9);
  std::fill(literals.begin() + 256, literals.begin() + 280, 7);
  std::array<int, 30> distances;
  distances.fill(5);
  return {Huffman(literals), Huffman(distances)};
}

Codes read_codes(Bits& bits) {
  constexpr std::array<std::size_t, 19> kOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                               11, 4,  12, 3, 13, 2, 14, 1, 15};
  const std::size_t literals = bits.number(5) + 257;
  const std::size_t distances = bits.number(5) + 1;
  const std::size_t code_lengths = bits.number(4) + 4;
  std::array<int, 19> length_lengths{};
  for (std::size_t i = 0; i < code_lengths; ++i) length_lengths[kOrder[i]] = static_cast<int>(bits.number(3));
  const Huffman length_code(length_lengths);
  std::vector<int> lengths;
  while (lengths.size() < literals + distances) {
    const unsigned symbol = length_code.symbol(bits);
    if (symbol < 16) lengths.push_back(static_cast<int>(symbol));
    else if (symbol == 16 && lengths.empty())
      throw std::runtime_error("compressed data that repeats nothing");
    else if (symbol == 16) lengths.insert(lengths.end(), bits.number(2) + 3, int{lengths.back()});
    else if (symbol == 17) lengths.insert(lengths.end(), bits.number(3) + 3, 0);
    else lengths.insert(lengths.end(), bits.number(7) + 11, 0);
  }
  const std::span all(lengths);
  return {Huffman(all.first(literals)), Huffman(all.subspan(literals, distances))};
}

void append_block(Bits& bits, const Codes& codes, std::vector<std::uint8_t>& out) {
  for (unsigned symbol = codes.literals.symbol(bits); symbol != kEnd; symbol = codes.literals.symbol(bits)) {
    if (symbol < kEnd) {
      out.push_back(static_cast<std::uint8_t>(symbol));
      continue;
    }
    const std::size_t run = symbol - kEnd - 1;
    const unsigned length = kLengths.at(run) + bits.number(kLengthBits.at(run));
    const std::size_t far = codes.distances.symbol(bits);
    const unsigned distance = kDistances.at(far) + bits.number(distance_bits(far));
    if (distance > out.size()) throw std::runtime_error("compressed data that refers to before its start");
    for (unsigned i = 0; i < length; ++i) out.push_back(std::uint8_t{out[out.size() - distance]});
  }
}

}  // namespace

std::vector<std::uint8_t> inflate(std::span<const std::uint8_t> zlib) {
  if (zlib.size() < 2 || (zlib[0] & 15) != 8) throw std::runtime_error("data that is not compressed by zlib");
  Bits bits(zlib.subspan(2));
  std::vector<std::uint8_t> out;
  for (bool last = false; !last;) {
    last = bits.bit() == 1;
    switch (bits.number(2)) {
      case 0: {
        bits.align();
        const unsigned length = bits.number(16);
        bits.number(16);  // the length's complement
        for (unsigned i = 0; i < length; ++i) out.push_back(static_cast<std::uint8_t>(bits.number(8)));
        break;
      }
      case 1: append_block(bits, fixed_codes(), out); break;
      case 2: append_block(bits, read_codes(bits), out); break;
      default: throw std::runtime_error("compressed data with an unknown block");
    }
  }
  return out;
}

}  // namespace tessera::reference
