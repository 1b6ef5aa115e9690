// The draw, triangle, normal and distance under the pointer, for every pixel at once.
#include <tessera/tessera.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
  constexpr int kWidth = 64, kHeight = 48;
  const float square[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
  const tessera::Mesh mesh{.positions = square, .indices = indices};

  tessera::Renderer renderer;
  tessera::FrameBuffer buffer({.width = kWidth, .height = kHeight});
  tessera::Frame frame(buffer);
  const tessera::Camera camera{.view = tessera::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}),
                               .projection = tessera::perspective(40, double(kWidth) / kHeight, 1, 10)};
  frame.set_camera(camera);
  frame.clear({.depth = 1.0});
  frame.draw(mesh, {.transform = tessera::translate(-1, 0, 0)});  // draw 0
  // Draw 1, in front of draw 0.
  frame.draw(mesh, {.transform = tessera::translate(1, 0, 1) * tessera::rotate(45, 0, 1, 0)});

  std::vector<std::uint32_t> draw_ids(kWidth * kHeight);
  std::vector<std::uint32_t> triangles(kWidth * kHeight);
  std::vector<float> normals(3 * kWidth * kHeight);
  std::vector<float> distances(kWidth * kHeight);
  frame.capture({.draw_ids = draw_ids, .primitive_ids = triangles, .normals = normals});
  frame.keep({tessera::Buffer::depth});
  renderer.finish(frame);
  buffer.read_view_depth(distances, camera);

  const auto tell = [&](int x, int y) {
    const std::size_t at = std::size_t(y) * kWidth + std::size_t(x);
    if (draw_ids[at] == tessera::Capture::kNothing) std::printf("%d, %d: nothing\n", x, y);
    else
      std::printf("%d, %d: object %u, triangle %u, normal %.2f %.2f %.2f, %.2f away\n", x, y, draw_ids[at],
                  triangles[at], normals[3 * at], normals[3 * at + 1], normals[3 * at + 2], distances[at]);
    return draw_ids[at];
  };
  const bool right = tell(15, 24) == 0 && tell(45, 24) == 1 && tell(1, 1) == tessera::Capture::kNothing;
  return right ? 0 : 1;
}
