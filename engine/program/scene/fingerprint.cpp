#include "engine/program/scene/fingerprint.h"

#include <bit>
#include <cstring>
#include <ostream>
#include <type_traits>

namespace tessera::program {

std::size_t pixel_count(const FrameBuffer& buffer) {
  return static_cast<std::size_t>(buffer.format().width) * static_cast<std::size_t>(buffer.format().height);
}

std::vector<std::uint32_t> packed_colors(const FrameBuffer& buffer) {
  std::vector<std::uint32_t> words(pixel_count(buffer));
  buffer.read_packed_colors(words);
  return words;
}
std::vector<std::uint32_t> stored_depths(const FrameBuffer& buffer) {
  std::vector<std::uint32_t> words(pixel_count(buffer));
  buffer.read_stored_depths(words);
  return words;
}
std::vector<std::uint8_t> stencil_values(const FrameBuffer& buffer) {
  std::vector<std::uint8_t> values(pixel_count(buffer));
  buffer.read_stencil(values);
  return values;
}
std::vector<float> accumulation_values(const FrameBuffer& buffer) {
  std::vector<float> values(4 * pixel_count(buffer));
  buffer.read_accumulation(values);
  return values;
}

std::uint64_t hash_of(std::span<const std::uint32_t> words) {
  Hash hash;
  for (const std::uint32_t word : words) hash.add(word);
  return hash.value();
}
std::uint64_t hash_of(const PlaneView& plane) {
  Hash hash;
  for (int y = 0; y < plane.height; ++y)
    for (std::ptrdiff_t at = 0; at < plane.stride_bytes; at += 8) {
      std::uint64_t bits;  // rows are padded to whole cache lines
      std::memcpy(&bits, plane.bits + y * plane.stride_bytes + at, sizeof bits);
      hash.add(bits);
    }
  return hash.value();
}

std::ostream& operator<<(std::ostream& out, const Fingerprint& f) {
  out << std::hex << "colour " << f.color << ", depth " << f.depth << ", stencil " << f.stencil
      << ", accumulation " << f.accumulation << ", planes";
  for (const std::uint64_t plane : f.planes) out << ' ' << (plane & 0xffff);
  return out << std::dec;
}

Fingerprint fingerprint(const FrameBuffer& buffer) {
  constexpr std::uint64_t kNotKept = 1;
  Fingerprint f;
  f.color = hash_of(packed_colors(buffer));
  if (buffer.plane_count(Buffer::depth) > 0) f.depth = hash_of(stored_depths(buffer));
  const auto value_hash = [&](Buffer which, const auto& values) -> std::uint64_t {
    if (buffer.plane_count(which) == 0) return 0;
    try {
      Hash hash;
      for (const auto value : values())
        hash.add(std::bit_cast<std::conditional_t<sizeof value == 1, std::uint8_t, std::uint32_t>>(value));
      return hash.value();
    } catch (const Error&) {
      return kNotKept;
    }
  };
  f.stencil = value_hash(Buffer::stencil, [&] { return stencil_values(buffer); });
  f.accumulation = value_hash(Buffer::accumulation, [&] { return accumulation_values(buffer); });
  for (const Buffer which : {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation}) {
    const bool is_lost_stencil = which == Buffer::stencil && f.stencil == kNotKept;
    const bool is_lost_accumulation = which == Buffer::accumulation && f.accumulation == kNotKept;
    if (is_lost_stencil || is_lost_accumulation) continue;
    for (int k = 0; k < buffer.plane_count(which); ++k) f.planes.push_back(hash_of(buffer.plane(which, k)));
  }
  return f;
}

}  // namespace tessera::program
