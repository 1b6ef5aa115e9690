// Draws a white quadrilateral over the middle of a small picture and prints the sum of the pixels. Every kind
// of linking must print the same sum.
#include <tessera/tessera.hpp>

#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

int main() {
  if (tessera::version() != std::string_view(TESSERA_VERSION)) return 3;
  try {
    tessera::Renderer({.threads = -1});
    return 4;
  } catch (const tessera::Error&) {  // thrown across the library boundary
  }
  const float positions[] = {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0.5f, 0.5f, 0, -0.5f, 0.5f, 0};
  const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
  constexpr int kWidth = 64, kHeight = 48;
  std::vector<std::uint8_t> pixels(4 * kWidth * kHeight);
  tessera::Renderer renderer;
  tessera::FrameBuffer buffer({.width = kWidth, .height = kHeight});
  tessera::Frame frame(buffer);
  frame.clear({.color = tessera::Color{0, 0, 0, 1}, .depth = 1.0});
  frame.draw({.positions = positions, .indices = indices},
             {.material = {.diffuse = {1, 1, 1, 1}}, .lighting = false});
  renderer.finish(frame,
                  {.pixels = pixels.data(), .width = kWidth, .height = kHeight, .stride_bytes = 4 * kWidth});
  unsigned long long sum = 0;
  for (const std::uint8_t byte : pixels) sum += byte;
  std::printf("%llu\n", sum);
  return sum == 255ull * (kWidth * kHeight + 3 * (kWidth / 2) * (kHeight / 2)) ? 0 : 5;
}
