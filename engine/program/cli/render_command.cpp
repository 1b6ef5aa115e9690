#include "engine/program/cli/render_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "engine/program/cli/explain_command.h"
#include "engine/program/cli/file_guard.h"
#include "engine/program/cli/frame_palettes.h"
#include "engine/program/cli/freed_memory.h"
#include "engine/program/cli/indexed_frame.h"
#include "engine/program/cli/memory_dump.h"
#include "engine/program/cli/override_effects.h"
#include "engine/program/cli/picture_output.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/scene_buffers.h"
#include "engine/program/cli/scene_input.h"
#include "engine/program/cli/shown_pictures.h"
#include "engine/program/compare/picture_errors.h"
#include "engine/program/imageio/screen_picture.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/scene_mode.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program::cli {
namespace {

namespace fs = std::filesystem;

constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

const char* buffer_name(Buffer buffer) {
  switch (buffer) {
    case Buffer::color: return "color";
    case Buffer::depth: return "depth";
    case Buffer::stencil: return "stencil";
    case Buffer::accumulation: return "accumulation";
  }
  return "";
}

std::string output_path(const RenderRequest& request) {
  if (!request.output.path.empty()) return request.output.path;
  // Without the suffix, the picture of truck.obj could replace its texture truck.png.
  const std::string name =
      request.input.empty() ? "tessera" : fs::path(request.input).stem().string() + ".render";
  return name + (request.frames > 1 ? "_{frame}.png" : ".png");
}

std::string plane_path(const fs::path& folder, Buffer which, int k) {
  char name[32];
  std::snprintf(name, sizeof name, "%s_%02d.pbm", buffer_name(which), k);
  return (folder / name).string();
}

void write_planes(const SceneBuffers& buffers, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error("cannot make the folder \"" + folder.string() + "\": " + error.message());
  for (const Buffer which : kBuffers) {
    const FrameBuffer& buffer = buffers.holding(which);
    for (int k = 0; k < buffer.plane_count(which); ++k)
      write_plane(buffer.plane(which, k), plane_path(folder, which, k));
  }
}

/// The part of a frame that a file holds.
enum class FileContent { picture, indices, one_bit };

/// @param may_be_indexed  false: pixels of PNG files have components
FileContent file_content(const FrameBufferFormat& format, const std::string& path, bool may_be_indexed) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".png" && may_be_indexed && is_indexed(format)) return FileContent::indices;
  if (extension == ".pbm" && format.color_bits == 1) return FileContent::one_bit;
  return FileContent::picture;
}

/// The mode of a scene, or one of square pixels.
VideoMode scene_video_mode(const Scene& scene) {
  if (scene.mode) return video_mode(*scene.mode);
  return {.width = scene.framebuffer.width, .height = scene.framebuffer.height};
}

/// Keeps the buffers that are read after the frame.
void keep_buffers(bool all, bool packed_colors, Frame& frame) {
  if (all) frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
  else if (packed_colors) frame.keep({Buffer::color});
}

std::size_t pixel_count(const Scene& scene) {
  return static_cast<std::size_t>(scene.framebuffer.width) *
         static_cast<std::size_t>(scene.framebuffer.height);
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void print_log(LogLevel min_level, LogLevel level, std::string_view message) {
  constexpr const char* kNames[] = {"debug", "info", "warning"};
  if (level >= min_level)
    std::cerr << "tessera: " << kNames[static_cast<int>(level)] << ": " << printable(message) << "\n";
}

/// Renders the scene once more, untimed: counting fragments slows rendering down.
std::uint64_t count_fragments(const Scene& scene, RendererOptions options) {
  options.debug.count_fragments = true;
  options.progress = {};
  options.log = {};
  Renderer renderer(options);
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  return renderer.finish(frame).fragments;
}

int report_difference(const Picture& picture, const Picture& reference, const RenderRequest& request) {
  const PictureErrors errors = picture_errors(pixels_of(picture), pixels_of(reference));
  const std::uint64_t wrong_pixels = errors.pixels_over(request.threshold);
  char share[32];
  std::snprintf(share, sizeof share, "%.4f %%", 100 * errors.share_over(request.threshold));
  std::cerr << "tessera: " << wrong_pixels << " pixels (" << share << ") differ by more than "
            << request.threshold << " of 255 levels from \"" << request.reference
            << "\"; the largest difference is " << errors.largest << "\n";
  return wrong_pixels == 0 ? 0 : kDiffers;
}

/// Refuses contradictory outputs before anything is rendered.
void check_outputs(const RenderRequest& request, const std::string& path) {
  std::vector<std::string> stdout_users;
  if (is_stream(path)) stdout_users.emplace_back("the picture");
  if (request.explain) stdout_users.emplace_back("--explain");
  if (request.stats == StatsFormat::json) stdout_users.emplace_back("--stats=json");
  if (stdout_users.size() > 1)
    throw UsageError(stdout_users[0] + " and " + stdout_users[1] + " cannot both go to the standard output");
  if (request.dump == path) throw UsageError("the picture and --dump are both \"" + path + "\"");
  const auto protect_inputs = [&](const std::string& file, const char* option) {
    refuse_overwriting(file, request.input, "input", option);
    refuse_overwriting(file, request.reference, "reference", option);
  };
  for (int f = 0; f < request.frames; ++f) {
    if (!request.dump.empty()) protect_inputs(frame_path(request.dump, f, request.frames), "--dump");
    if (!is_stream(path)) protect_inputs(frame_path(path, f, request.frames), "-o");
  }
}

/// Refuses options that have no effect on the scene.
void check_scene_options(const RenderRequest& request, const SceneInput& input) {
  const bool moves = input.is_animated() || request.frames == 1 || request.display.display.has_value();
  request.given.require(
      {{"--frames", moves,
        "needs a scene in which something moves, and nothing does; all frames would be equal"}});
  check_override_effects(request.given, input);
}

/// Reads the content of a picture's file.
/// @param shown  the screen that shows the picture; null: the picture is written itself
FinishedPicture finished_picture(const std::shared_ptr<Picture>& picture, const ShownPictures* shown,
                                 const FrameBuffer& buffer, FileContent content) {
  if (shown != nullptr)
    return {.picture = std::make_shared<Picture>(shown->image()), .light = shown->light()};
  FinishedPicture finished{.picture = picture};
  if (content == FileContent::indices) finished.indexed = indexed_picture(buffer);
  if (content == FileContent::one_bit) finished.one_bit = screen_picture(buffer, {});
  return finished;
}

/// Writes the planes and the memory of a frame.
void write_buffers(const RenderRequest& request, const Scene& scene, const SceneBuffers& buffers, int frame) {
  const auto path_of = [&](const std::string& name) { return frame_path(name, frame, request.frames); };
  if (!request.planes_folder.empty()) write_planes(buffers, path_of(request.planes_folder));
  if (!request.dump.empty()) write_memory_dump(buffers.shown(), *scene.mode, path_of(request.dump));
}

}  // namespace

int render(RenderRequest request) {
  const auto start = std::chrono::steady_clock::now();
  const Interrupt interrupt;
  SceneInput input(request.input, request.overrides, request.import, request.progress);
  input.print_warnings();
  RunStats run;
  run.load_ms = milliseconds_since(start);

  const bool is_named = !request.output.path.empty();
  const std::string path = output_path(request);
  check_outputs(request, path);
  check_scene_options(request, input);
  if (!request.dump.empty() && !input.scene().mode)
    throw UsageError(
        "--dump writes the memory of a display mode, and the scene has none; name one with --mode");
  std::optional<Picture> reference;
  if (!request.reference.empty()) reference = read_picture(request.reference);

  std::optional<ShownPictures> shown;
  if (request.display.display) {
    shown.emplace(request.display, scene_video_mode(input.scene()), path, request.options.threads,
                  request.options.instruction_set);
    shown->print_notes();
  }

  std::optional<ThreadLimit> raised_limit;
  if (request.options.threads > available_cores()) raised_limit.emplace(request.options.threads);
  Progress progress(request.progress);
  int done_renders = 0;
  std::string label;
  request.options.progress = [&](double done) {
    progress.show((done_renders + done) / (static_cast<double>(request.frames) * request.repeat), label);
    return !Interrupt::pressed();
  };
  if (request.log)
    request.options.log = [&progress, min_level = *request.log](LogLevel level, std::string_view message) {
      progress.clear();
      print_log(min_level, level, message);
    };
  if (request.frames > 1) keep_freed_memory();
  Renderer renderer(request.options);
  run.options = renderer.options();

  label = "choosing the palette";
  FramePalettes palettes(input, request.frames, renderer);
  const bool may_be_indexed =
      !is_animated_png(path, request.frames) || frames_share_palette(input, request.frames);
  const bool is_transparent = request.overrides.background && request.overrides.background->a == 0;
  request.output.path = path;
  PictureOutput output(request.output, request.frames, run.options.threads,
                       shown ? shown->image().rgba.size() / 4 : pixel_count(input.scene()));
  int exit_code = 0;
  for (int f = 0; f < request.frames; ++f) {
    const bool is_last = f + 1 == request.frames;
    label = request.frames > 1 ? "frame " + std::to_string(f + 1) + " of " + std::to_string(request.frames)
                               : "rendering";
    input.move_to(input.frame_time(f, request.frames));
    const Scene& scene = input.scene();
    SceneBuffers buffers(scene);
    if (const auto palette = palettes.next(scene, renderer)) buffers.shown().set_palette(*palette);
    Frame frame(buffers.drawn, renderer);
    const auto picture = output.spare_picture(scene.framebuffer.width, scene.framebuffer.height);
    picture->keeps_alpha = is_transparent;
    const FileContent content =
        shown ? FileContent::picture : file_content(buffers.shown().format(), path, may_be_indexed);
    const bool reads_colors = !scene.reduced && (content != FileContent::picture || !request.dump.empty());
    if (request.explain && f == 0) {
      record(scene, frame);
      std::cout << explanation_text(scene, frame);
      frame.reset();
    }
    for (int r = 0; r < request.repeat; ++r, ++done_renders) {
      const auto render_start = std::chrono::steady_clock::now();
      record(scene, frame);
      keep_buffers(!request.planes_folder.empty(), reads_colors, frame);
      run.frame = renderer.finish(frame, picture->target());
      if (buffers.reduced) reduce_picture(renderer, *picture, *buffers.reduced);
      if (is_transparent) divide_by_alpha(*picture);
      run.render_ms.push_back(milliseconds_since(render_start));
    }
    progress.clear();
    if (shown) shown->show(*picture);
    const auto write_start = std::chrono::steady_clock::now();
    const auto print_name = [&, file = frame_path(path, f, request.frames)] {
      if (!is_named) std::cerr << "tessera: wrote " << printable(file) << "\n";
    };
    output.add(finished_picture(picture, shown ? &*shown : nullptr, buffers.shown(), content), f, print_name);
    write_buffers(request, scene, buffers, f);
    if (is_last) output.finish();
    run.write_ms += milliseconds_since(write_start);
    for (std::size_t i = 0; i < run.buffer_bytes.size(); ++i)
      run.buffer_bytes[i] = buffers.holding(kBuffers[i]).allocated_bytes(kBuffers[i]);
    if (request.stats != StatsFormat::none && is_last)
      run.frame.fragments = count_fragments(scene, run.options);
    if (reference && is_last)
      exit_code = report_difference(shown ? shown->image() : *picture, *reference, request);
  }
  if (request.stats == StatsFormat::text) std::cerr << stats_text(run);
  if (request.stats == StatsFormat::json) std::cout << stats_json(run);
  return exit_code;
}

}  // namespace tessera::program::cli
