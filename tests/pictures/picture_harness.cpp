#include "tests/pictures/picture_harness.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "engine/program/scene/scene.h"
#include "tests/mesa/mesa_renderer.h"
#include "tests/reference/render.h"

namespace tessera::test {
using namespace program;
namespace {

bool is_within(const reference::Counts& counts, double share) {
  return counts.differing <=
         static_cast<std::int64_t>(std::floor(share * static_cast<double>(counts.pixels)));
}

Rgb draw_by_engine(const std::string& path, const RendererOptions& options) {
  const Scene scene = load_scene(path);
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  const int width = scene.framebuffer.width, height = scene.framebuffer.height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint8_t> rgba(4 * pixels);
  ImageTarget target;
  target.pixels = rgba.data();
  target.width = width;
  target.height = height;
  target.stride_bytes = std::ptrdiff_t{4} * width;
  Renderer(options).finish(frame, target);

  Rgb rgb;
  for (std::size_t i = 0; i < pixels; ++i)
    rgb.insert(rgb.end(), {rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]});
  return rgb;
}

}  // namespace

bool obeys_rule(const reference::Comparison& comparison) {
  return is_within(comparison.interior, kInteriorShare) && is_within(comparison.all, kWholeShare);
}

bool ThreeWayReport::is_good() const {
  return obeys_rule(engine_to_reference) && obeys_rule(mesa_to_reference) && obeys_rule(engine_to_mesa);
}

std::string ThreeWayReport::text() const {
  std::string lines = name + ", " + std::to_string(width_px) + " x " + std::to_string(height_px);
  lines += "\n  engine to reference: " + reference::to_string(engine_to_reference);
  if (!mesa_cannot.empty()) return lines + "\n  Mesa cannot follow: " + mesa_cannot;
  lines += "\n  Mesa to reference:   " + reference::to_string(mesa_to_reference);
  return lines + "\n  engine to Mesa:      " + reference::to_string(engine_to_mesa);
}

ThreeWayReport compare_three_ways(const std::string& path, const RendererOptions& options) {
  ThreeWayReport report;
  report.name = std::filesystem::path(path).stem().string();
  const reference::Scene scene = reference::load_scene(path);
  const int width = report.width_px = scene.framebuffer.width_px;
  const int height = report.height_px = scene.framebuffer.height_px;

  report.reference = reference::render(scene).rgb;
  report.engine = draw_by_engine(path, options);
  report.engine_to_reference = reference::compare(report.reference, report.engine, width, height);

  if (const auto reason = mesa::unsupported(scene)) {
    report.mesa_cannot = *reason;
    return report;
  }
  report.mesa = mesa::render(scene);
  report.mesa_to_reference = reference::compare(report.reference, report.mesa, width, height);
  report.engine_to_mesa = reference::compare(report.mesa, report.engine, width, height);
  return report;
}

std::string write_pictures(const ThreeWayReport& report) {
  const char* const named = std::getenv("TESSERA_PICTURES");
  const std::filesystem::path folder = named != nullptr && *named != '\0'
                                           ? std::filesystem::path(named)
                                           : std::filesystem::temp_directory_path() / "tessera_pictures";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* what, const Rgb& rgb) {
    reference::write_ppm((folder / (report.name + "_" + what + ".ppm")).string(), rgb, report.width_px,
                         report.height_px);
  };
  write("engine", report.engine);
  write("reference", report.reference);
  write("engine_to_reference", reference::difference(report.reference, report.engine));
  if (report.mesa_cannot.empty()) {
    write("mesa", report.mesa);
    write("mesa_to_reference", reference::difference(report.reference, report.mesa));
    write("engine_to_mesa", reference::difference(report.mesa, report.engine));
  }
  return folder.string();
}

}  // namespace tessera::test
