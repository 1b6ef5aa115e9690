// A software window: renders into the window's RGBA pixels at a steady rate. Here the window is plain memory;
// a real one provides the address and stride of its pixels (SDL_LockTexture, wl_shm, XShmPutImage).
#include <tessera/tessera.hpp>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

struct Window {
  int width = 320, height = 200;
  std::ptrdiff_t stride_bytes = 4 * 320 + 64;  // many windows pad their rows
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(static_cast<std::size_t>(stride_bytes) * 200);
  void present() {}
};

int main() {
  constexpr int kFrames = 30;
  constexpr auto kPeriod = std::chrono::milliseconds(1000) / 60;
  const float positions[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const float colors[] = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1};

  Window window;
  tessera::Renderer renderer;
  tessera::FrameBuffer buffer({.width = window.width, .height = window.height, .stencil_bits = 0});
  tessera::Frame frame(buffer);  // recorded again for each picture; the camera persists
  frame.set_camera({.view = tessera::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}),
                    .projection = tessera::perspective(45, double(window.width) / window.height, 0.1, 100)});
  const auto start = std::chrono::steady_clock::now();
  int late = 0;
  for (int i = 0; i < kFrames; ++i) {
    frame.clear({.color = tessera::Color{0.1f, 0.1f, 0.1f, 1}, .depth = 1.0});
    frame.draw({.positions = positions, .colors = colors},
               {.transform = tessera::rotate(6.0 * i, 0, 1, 0), .lighting = false});
    renderer.finish(frame, {.pixels = window.pixels.data(),
                            .width = window.width,
                            .height = window.height,
                            .stride_bytes = window.stride_bytes,
                            .order = tessera::PixelOrder::bgra8});
    window.present();
    const auto next = start + (i + 1) * kPeriod;
    if (std::chrono::steady_clock::now() > next) ++late;
    std::this_thread::sleep_until(next);
  }
  std::printf("%d frames, %d late\n", kFrames, late);
  // Scan-out wrote to the window directly: the buffer stored no pixels.
  return buffer.allocated_bytes(tessera::Buffer::color) == 0 ? 0 : 1;
}
