// Shared by tests of the public interface: small meshes, images and error messages. Contents of frame buffers
// are in fingerprint.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/program/scene/fingerprint.h"
#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::test {
using namespace program;

/// Random numbers; the same sequence on every machine and standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2 + 1) {}
  std::uint32_t next() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1du >> 32);
  }
  /// Uniform from `low` to `high`, in steps of 2^-24 of the range: 24 random bits are exact as a float.
  float between(float low, float high) {
    return low + (high - low) * (static_cast<float>(next() >> 8) / 16777216.0f);
  }

 private:
  std::uint64_t state_;
};

inline std::int64_t below(Random& random, std::int64_t n) {
  return static_cast<std::int64_t>(random.next()) % n;
}

/// An axis-parallel rectangle of two triangles, counter-clockwise in the coordinates of the current camera.
inline MeshData rectangle(float x0, float y0, float x1, float y1, float z = 0) {
  MeshData mesh;
  mesh.positions = {x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}
/// Covers the whole window under the initial camera.
inline MeshData whole_window(float z = 0) { return rectangle(-1, -1, 1, 1, z); }

inline DrawState unlit(Color color) {
  DrawState state;
  state.lighting = false;
  state.material.diffuse = color;
  return state;
}

/// Owns its pixels: 4 bytes each, without gaps.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
  explicit Image(const FrameBuffer& buffer)
      : width(buffer.format().width), height(buffer.format().height), bytes(4 * pixel_count(buffer)) {}
  ImageTarget target(PixelOrder order = PixelOrder::rgba8) {
    return {.pixels = bytes.data(),
            .width = width,
            .height = height,
            .stride_bytes = std::ptrdiff_t{4} * width,
            .order = order};
  }
};

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
