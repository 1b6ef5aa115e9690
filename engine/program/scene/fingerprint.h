// Reads back the contents of frame buffers, and hashes them identically on every machine.
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
/// Returns r g b a per pixel.
std::vector<float> accumulation_values(const FrameBuffer& buffer);

/// 64-bit hash of words; independent of endianness.
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

/// Hashes of a frame buffer's contents. 0: the format has no such buffer; 1: the frame did not keep it.
struct Fingerprint {
  std::uint64_t color = 0;  ///< including alpha
  std::uint64_t depth = 0;
  std::uint64_t stencil = 0;
  std::uint64_t accumulation = 0;
  std::vector<std::uint64_t> planes;  ///< planes of colour, depth, stencil and accumulation, in this order
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Fingerprint& f);
};
Fingerprint fingerprint(const FrameBuffer& buffer);

}  // namespace tessera::program
