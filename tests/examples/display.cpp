// Shows a rendered frame as a CGA monitor does: tessera draws it in 320x200 pixels of 4 colours, and
// tessera::display simulates beam, scan lines and shadow mask.
#include <tessera/screen.hpp>
#include <tessera/tessera.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <vector>

int main() {
  const float positions[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  const float colors[] = {1, 0, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1};

  const tessera::DisplayMode mode = tessera::display_mode("cga");
  tessera::FrameBufferFormat format = tessera::frame_buffer_format(mode);
  format.dither = tessera::Dither::blue_noise;
  tessera::Renderer renderer;
  tessera::FrameBuffer buffer(format);
  tessera::Frame frame(buffer);
  frame.clear({.color = tessera::Color{0, 0.1f, 0.1f, 1}, .depth = 1.0});
  frame.set_camera({.view = tessera::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}),
                    .projection = tessera::perspective(45, mode.screen_aspect(), 0.1, 100)});
  frame.draw({.positions = positions, .colors = colors}, {.lighting = false});
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{4} * mode.width;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(row_bytes * mode.height));
  renderer.finish(
      frame,
      {.pixels = pixels.data(), .width = mode.width, .height = mode.height, .stride_bytes = row_bytes});

  const auto executor = tessera::serial_executor();  // any tessera::Executor, or threads of your own
  tessera::Screen screen(tessera::find_display("cga"),
                         {.width = mode.width,
                          .height = mode.height,
                          .pixel_aspect = mode.pixel_aspect.value(),
                          .timing = mode.timing},
                         {.scale_px_per_mm = 8}, tessera::ScreenWorkers(*executor));
  for (const std::string& note : screen.notes()) std::printf("%s\n", note.c_str());
  std::vector<std::uint8_t> image(std::size_t{3} * screen.width() * screen.height());
  screen.show({.rgb = pixels, .pixel_bytes = 4}, 0, {.rgb = image.data()});

  std::ofstream file("display_example.ppm", std::ios::binary);
  file << "P6\n" << screen.width() << " " << screen.height() << "\n255\n";
  file.write(reinterpret_cast<const char*>(image.data()), static_cast<std::streamsize>(image.size()));
  std::printf("%d x %d pixels on %.0f x %.0f mm\n", screen.width(), screen.height(), screen.width_mm(),
              screen.height_mm());
  return file.good() ? 0 : 1;
}
