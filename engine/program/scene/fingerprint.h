// What a frame buffer holds, read back in one line, and as hashes that are the same on every machine.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

std::size_t pixel_count(const FrameBuffer& buffer);
std::vector<std::uint32_t> packed_colors(const FrameBuffer& buffer);
std::vector<std::uint32_t> stored_depths(const FrameBuffer& buffer);
std::vector<std::uint8_t> stencil_values(const FrameBuffer& buffer);
/// r g b a of each pixel.
std::vector<float> accumulation_values(const FrameBuffer& buffer);

/// 64 bits of a run of words, by value: no matter of byte order.
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 32;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};
std::uint64_t hash_of(std::span<const std::uint32_t> words);
std::uint64_t hash_of(const PlaneView& plane);

/// What a frame left behind. 0 stands for a buffer that there is none of, 1 for one that was not kept. Alpha
/// stands in the colour.
struct Fingerprint {
  std::uint64_t color = 0, depth = 0, stencil = 0, accumulation = 0;
  std::vector<std::uint64_t> planes;  ///< of colour, then of depth, of stencil and of accumulation
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Fingerprint& f);
};
Fingerprint fingerprint(const FrameBuffer& buffer);

}  // namespace tessera::program
