// What the tests of the public interface share: small meshes, read-back in one line, and fingerprints of frame buffers.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::test {

/// The same numbers on every machine and library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2 + 1) {}
  std::uint32_t next() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1du >> 32);
  }
  /// 24 bits, so that every step is exact but the last.
  float between(float low, float high) { return low + (high - low) * (static_cast<float>(next() >> 8) / 16777216.0f); }

 private:
  std::uint64_t state_;
};

/// An axis-parallel rectangle of two triangles, counter-clockwise, in whatever space the camera makes of it.
inline MeshData rectangle(float x0, float y0, float x1, float y1, float z = 0) {
  MeshData mesh;
  mesh.positions = {x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}
/// The whole window under the initial camera.
inline MeshData whole_window(float z = 0) { return rectangle(-1, -1, 1, 1, z); }

inline DrawState unlit(Color color) {
  DrawState state;
  state.lighting = false;
  state.material.diffuse = color;
  return state;
}

inline std::size_t pixel_count(const FrameBuffer& buffer) {
  return static_cast<std::size_t>(buffer.format().width) * static_cast<std::size_t>(buffer.format().height);
}
inline std::vector<std::uint32_t> color_words(const FrameBuffer& buffer) {
  std::vector<std::uint32_t> words(pixel_count(buffer));
  buffer.read_color_words(words);
  return words;
}
inline std::vector<std::uint32_t> depth_words(const FrameBuffer& buffer) {
  std::vector<std::uint32_t> words(pixel_count(buffer));
  buffer.read_depth_words(words);
  return words;
}
inline std::vector<std::uint8_t> stencil_values(const FrameBuffer& buffer) {
  std::vector<std::uint8_t> values(pixel_count(buffer));
  buffer.read_stencil(values);
  return values;
}

/// r g b a of each pixel.
inline std::vector<float> accumulated_values(const FrameBuffer& buffer) {
  std::vector<float> values(4 * pixel_count(buffer));
  buffer.read_accumulation(values);
  return values;
}

/// Pixels of its own, 4 bytes each without gaps.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
  explicit Image(const FrameBuffer& buffer) : width(buffer.format().width), height(buffer.format().height), bytes(4 * pixel_count(buffer)) {}
  ImageTarget target(PixelOrder order = PixelOrder::rgba8) {
    return {.pixels = bytes.data(), .width = width, .height = height, .stride_bytes = std::ptrdiff_t{4} * width, .order = order};
  }
};

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
inline std::uint64_t hash_of(std::span<const std::uint32_t> words) {
  Hash hash;
  for (const std::uint32_t word : words) hash.add(word);
  return hash.value();
}
inline std::uint64_t hash_of(const PlaneView& plane) {
  Hash hash;
  for (int y = 0; y < plane.height; ++y)
    for (std::ptrdiff_t at = 0; at < plane.stride_bytes; at += 8) {
      std::uint64_t bits;  // rows are padded to whole cache lines
      std::memcpy(&bits, plane.bits + y * plane.stride_bytes + at, sizeof bits);
      hash.add(bits);
    }
  return hash.value();
}

/// What a frame left behind. 0 stands for a buffer that there is none of, 1 for one that was not kept. Alpha stands in the colour.
struct Fingerprint {
  std::uint64_t color = 0, depth = 0, stencil = 0, accumulation = 0;
  std::vector<std::uint64_t> planes;  ///< of colour, then of depth, of stencil and of accumulation
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Fingerprint& f) {
    out << std::hex << "colour " << f.color << ", depth " << f.depth << ", stencil " << f.stencil << ", accumulation " << f.accumulation << ", planes";
    for (const std::uint64_t plane : f.planes) out << ' ' << (plane & 0xffff);
    return out << std::dec;
  }
};
inline Fingerprint fingerprint(const FrameBuffer& buffer) {
  Fingerprint f;
  f.color = hash_of(color_words(buffer));
  if (buffer.plane_count(Buffer::depth) > 0) f.depth = hash_of(depth_words(buffer));
  const auto value_hash = [&](Buffer which, const auto& values) -> std::uint64_t {
    if (buffer.plane_count(which) == 0) return 0;
    try {
      Hash hash;
      for (const auto value : values()) hash.add(std::bit_cast<std::conditional_t<sizeof value == 1, std::uint8_t, std::uint32_t>>(value));
      return hash.value();
    } catch (const Error&) {
      return 1;
    }
  };
  f.stencil = value_hash(Buffer::stencil, [&] { return stencil_values(buffer); });
  f.accumulation = value_hash(Buffer::accumulation, [&] { return accumulated_values(buffer); });
  for (const Buffer which : {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation})
    if ((which != Buffer::stencil || f.stencil != 1) && (which != Buffer::accumulation || f.accumulation != 1))
      for (int k = 0; k < buffer.plane_count(which); ++k) f.planes.push_back(hash_of(buffer.plane(which, k)));
  return f;
}

/// The message of the tessera::Error that `act` throws; empty if it throws none.
template <class Act>
std::optional<std::string> error_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return std::nullopt;
}

}  // namespace tessera::test
