#include "engine/cli/render_command.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include "engine/cli/stats_text.h"
#include "engine/imageio/picture.h"
#include "engine/import/model.h"
#include "engine/parallel.h"
#include "engine/scene/model_scene.h"

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil};

const char* buffer_name(Buffer buffer) { return buffer == Buffer::color ? "color" : buffer == Buffer::depth ? "depth" : "stencil"; }

Scene read_input(const RenderRequest& request) {
  if (request.input.empty()) return builtin_scene();
  if (is_model_file(request.input)) {
    const FrameBufferFormat standard;
    return model_scene(import_model(request.input), request.input, request.overrides.width.value_or(standard.width),
                       request.overrides.height.value_or(standard.height));
  }
  std::string ending = fs::path(request.input).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".json")
    throw Error("cannot render \"" + request.input + "\": it ends neither in .json (a scene) nor in .obj (a model)");
  return load_scene(request.input);
}

std::string output_path(const RenderRequest& request) {
  if (!request.output.empty()) return request.output;
  return request.input.empty() ? "tessera.png" : fs::path(request.input).stem().string() + ".png";
}

void print_explanations(const Scene& scene, const Frame& frame) {
  std::size_t index = 0;
  for (const SceneCommand& command : scene.frame)
    if (const auto* draw = std::get_if<DrawCommand>(&command.what)) {
      std::string text = frame.explain(index);
      while (!text.empty() && text.back() == '\n') text.pop_back();
      std::cout << "draw " << index++ << ", \"" << scene.meshes[draw->mesh].name << "\":\n" << text << "\n";
    }
}

// Buffers that the format has but the frame never touched hold what new buffers hold.
void write_planes(const FrameBuffer& buffer, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error("cannot make the folder \"" + folder.string() + "\": " + error.message());
  for (const Buffer which : kBuffers)
    for (int k = 0; k < buffer.plane_count(which); ++k) {
      char name[32];
      std::snprintf(name, sizeof name, "%s_%02d.pbm", buffer_name(which), k);
      write_plane(buffer.plane(which, k), (folder / name).string());
    }
}

// All that the format has, so that every plane can be read.
void keep_all(const FrameBuffer& buffer, Frame& frame) {
  const bool has_depth = buffer.plane_count(Buffer::depth) > 0, has_stencil = buffer.plane_count(Buffer::stencil) > 0;
  if (has_depth && has_stencil)
    frame.keep({Buffer::color, Buffer::depth, Buffer::stencil});
  else if (has_depth)
    frame.keep({Buffer::color, Buffer::depth});
  else if (has_stencil)
    frame.keep({Buffer::color, Buffer::stencil});
  else
    frame.keep({Buffer::color});
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void render(const RenderRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  Scene scene = read_input(request);
  apply(request.overrides, scene);
  for (const std::string& warning : scene.warnings) std::cerr << "tessera: warning: " << warning << "\n";
  const double load_ms = milliseconds_since(start);

  std::optional<ThreadLimit> more_threads_than_cores;
  if (request.options.threads > available_cores()) more_threads_than_cores.emplace(request.options.threads);
  Renderer renderer(request.options);
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  if (request.explain) print_explanations(scene, frame);
  if (!request.planes_folder.empty()) keep_all(buffer, frame);

  Picture picture(scene.framebuffer.width, scene.framebuffer.height);
  const auto render_start = std::chrono::steady_clock::now();
  const FrameStats stats = renderer.finish(frame, picture.target());
  const double render_ms = milliseconds_since(render_start);

  const auto write_start = std::chrono::steady_clock::now();
  const std::string output = output_path(request);
  write_picture(picture, output);
  if (!request.planes_folder.empty()) write_planes(buffer, request.planes_folder);
  if (request.output.empty()) std::cerr << "tessera: wrote " << output << "\n";
  if (request.stats)
    std::cerr << stats_text(stats, renderer.options(), {.load_ms = load_ms, .render_ms = render_ms, .write_ms = milliseconds_since(write_start)});
}

}  // namespace tessera::cli
