// A buffer that counts: each triangle adds one level to what it covers.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

/// A mesh of triangles in clip space, and a random order of them.
struct CountedMesh {
  std::vector<float> positions;  // x y z w
  std::vector<std::uint32_t> indices;

  std::uint32_t add_vertex(double x, double y, double z = 0, double w = 1) {
    for (const double c : {x, y, z, w}) positions.push_back(static_cast<float>(c));
    return static_cast<std::uint32_t>(positions.size() / 4 - 1);
  }
  /// Of either winding.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::mt19937& random) {
    const bool turned = random() % 2 != 0;
    indices.insert(indices.end(), {a, turned ? c : b, turned ? b : c});
  }
  std::size_t triangles() const { return indices.size() / 3; }
  void shuffle(std::mt19937& random) {
    for (std::size_t i = triangles(); i > 1; --i)
      for (std::size_t k = 0, j = random() % i; k < 3; ++k) std::swap(indices[3 * (i - 1) + k], indices[3 * j + k]);
  }
};

/// Counts with one level of blue; more than 255 stay 255.
class Counter {
 public:
  explicit Counter(int width, int height, RendererOptions options = {.threads = 1}) : buffer_({.width = width, .height = height}), renderer_(options), width_(width), counts_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    state_.lighting = false;
    state_.depth.enabled = false;
    state_.blend = BlendState{.src = BlendFactor::one, .dst = BlendFactor::one};
    state_.material.diffuse = {0, 0, 1 / 255.0f, 1};
  }
  /// Of each pixel, rows from the top.
  const std::vector<std::uint32_t>& count(const CountedMesh& mesh) {
    Frame frame(buffer_);
    frame.clear({.color = Color{0, 0, 0, 1}});
    frame.draw({.positions = mesh.positions, .position_components = 4, .indices = mesh.indices}, state_);
    ImageTarget target{counts_.data(), width_, static_cast<int>(counts_.size()) / width_, 4 * static_cast<std::ptrdiff_t>(width_), PixelOrder::bgra8};
    renderer_.finish(frame, target);
    for (std::uint32_t& c : counts_) c &= 255;
    return counts_;
  }

 private:
  FrameBuffer buffer_;
  Renderer renderer_;
  int width_;
  DrawState state_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace tessera::test
