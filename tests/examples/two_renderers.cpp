// Two renderers on two threads: they share only the mesh, which both read.
#include <tessera/tessera.hpp>

#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

int main() {
  constexpr int kWidth = 200;
  constexpr int kHeight = 100;
  constexpr int kFrames = 20;
  const float positions[] = {-0.9f, -0.9f, 0, 0.9f, -0.9f, 0, 0, 0.9f, 0};
  const auto render = [&](std::vector<std::uint8_t>& pixels) {
    tessera::Renderer renderer({.threads = 1});
    tessera::FrameBuffer buffer({.width = kWidth, .height = kHeight});
    tessera::Frame frame(buffer);
    for (int i = 0; i < kFrames; ++i) {
      frame.clear({.color = tessera::Color{0, 0, 0, 1}, .depth = 1.0});
      frame.draw({.positions = positions},
                 {.transform = tessera::rotate(10.0 * i, 0, 0, 1), .shading = tessera::Shading::phong});
      renderer.finish(
          frame, {.pixels = pixels.data(), .width = kWidth, .height = kHeight, .stride_bytes = 4 * kWidth});
    }
  };
  std::vector<std::uint8_t> left(4 * kWidth * kHeight), right(4 * kWidth * kHeight);
  std::thread other(render, std::ref(left));
  render(right);
  other.join();
  std::printf("the two pictures are %s\n", left == right ? "the same" : "different");
  return left == right ? 0 : 1;
}
