// Draws a vase with the lighting of phong.h and with the built-in lighting, and compares the two pictures.
#include "phong.h"

#include <cstdio>
#include <cstdlib>
#include <vector>

int main() {
  constexpr int kWidth = 320, kHeight = 240, kRings = 24, kSides = 48;
  std::vector<float> positions;  // vertices of a vase; its normals are generated
  std::vector<std::uint32_t> indices;
  for (int ring = 0; ring <= kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const float y = 2.0f * float(ring) / kRings - 1, angle = 6.2831853f * float(side) / kSides;
      const float radius = 0.5f + 0.25f * std::sin(4 * y);
      positions.insert(positions.end(), {radius * std::cos(angle), y, -radius * std::sin(angle)});
    }
  for (std::uint32_t quad = 0; quad < kRings * kSides; ++quad) {
    const std::uint32_t right = quad - quad % kSides + (quad + 1) % kSides;
    for (const std::uint32_t corner : {quad, right, right + kSides, quad, right + kSides, quad + kSides})
      indices.push_back(corner);
  }
  const tessera::Mesh vase{.positions = positions, .indices = indices};

  Phong phong{{1, 2, 0}, {0.8f, 0.3f, 0.2f}, 0.6f, 20};
  tessera::Material material;
  material.ambient = {0, 0, 0, 1};
  material.diffuse = {phong.diffuse[0], phong.diffuse[1], phong.diffuse[2], 1};
  material.specular = {phong.specular, phong.specular, phong.specular, 1};
  material.shininess = float(phong.shininess);

  tessera::Renderer renderer;
  std::vector<std::uint8_t> pictures[2];
  for (const bool by_stage : {false, true}) {
    tessera::FrameBuffer buffer({.width = kWidth, .height = kHeight});
    tessera::Frame frame(buffer);
    // The camera stands at the origin of the world, so the light is the same in both spaces.
    frame.set_camera({.projection = tessera::perspective(40, double(kWidth) / kHeight, 1, 10)});
    frame.set_lights({tessera::Light{.position = {phong.light[0], phong.light[1], phong.light[2], 1}}});
    frame.set_light_model(
        {.ambient = {0, 0, 0, 1}, .local_viewer = true, .specular = tessera::SpecularModel::phong});
    frame.clear({.color = tessera::Color{0.1f, 0.1f, 0.15f, 1}, .depth = 1.0});
    tessera::DrawState state{.material = material,
                             .transform = tessera::translate(0, 0, -4) * tessera::rotate(20, 1, 0, 0),
                             .shading = tessera::Shading::phong};
    if (by_stage)
      state.fragment_stage = tessera::FragmentStage{
          .run = Phong::run, .data = &phong, .name = "phong", .reads = {.eye = true, .normal = true}};
    frame.draw(vase, state);
    pictures[by_stage].resize(4 * kWidth * kHeight);
    renderer.finish(frame, {.pixels = pictures[by_stage].data(), .width = kWidth, .height = kHeight});
  }
  int largest = 0;
  for (std::size_t i = 0; i < pictures[0].size(); ++i)
    largest = std::max(largest, std::abs(pictures[0][i] - pictures[1][i]));
  std::printf("largest difference between the stage and the built-in lighting: %d of 255 levels\n", largest);
  return largest <= 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
