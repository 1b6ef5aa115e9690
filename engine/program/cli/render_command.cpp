#include "engine/program/cli/render_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "engine/program/cli/compare.h"
#include "engine/program/cli/file_guard.h"
#include "engine/program/cli/printable.h"
#include "engine/program/import/model.h"
#include "engine/program/scene/file_extension.h"
#include "engine/program/scene/model_scene.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program::cli {
namespace {

namespace fs = std::filesystem;

constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

const char* buffer_name(Buffer buffer) {
  return buffer == Buffer::color     ? "color"
         : buffer == Buffer::depth   ? "depth"
         : buffer == Buffer::stencil ? "stencil"
                                     : "accumulation";
}

/// In any format, since an animation may change it: 24 bits of colour and 8 of alpha, 32 of depth, 8 of
/// stencil, four accumulated components of 32.
int max_planes(Buffer buffer) {
  return buffer == Buffer::accumulation ? 128 : buffer == Buffer::stencil ? 8 : 32;
}

/// What is rendered, frame by frame.
class Input {
 public:
  explicit Input(const RenderRequest& request) : overrides_(request.overrides) {
    const auto should_continue = [] { return !Interrupt::pressed(); };
    if (request.input.empty()) {
      scene_ = builtin_scene();
    } else if (lower_case_extension(request.input) == ".json") {
      file_.emplace(request.input, should_continue);
      scene_ = file_->at(0);
      files_ = file_->files();
    } else {
      const FrameBufferFormat standard;
      Model model = import_model(request.input, ModelUse::display, should_continue);
      files_ = {model.files.begin(), model.files.end()};
      files_.insert(request.input);
      scene_ = model_scene(std::move(model), request.input, overrides_.width.value_or(standard.width),
                           overrides_.height.value_or(standard.height));
    }
    apply(overrides_, scene_);
  }
  const Scene& scene() const { return scene_; }
  /// That it was read from, and those that models refer to.
  const std::set<std::string>& files() const { return files_; }
  /// The scene becomes that of a time, 0 .. 1.
  void move_to(double time) {
    if (!file_ || !file_->is_animated()) return;
    scene_ = file_->at(time);
    apply(overrides_, scene_);
  }

 private:
  SceneOverrides overrides_;
  std::optional<SceneFile> file_;
  std::set<std::string> files_;
  Scene scene_;
};

std::string output_path(const RenderRequest& request) {
  if (!request.output.path.empty()) return request.output.path;
  const std::string stem = request.input.empty() ? "tessera" : fs::path(request.input).stem().string();
  return stem + (request.frames > 1 ? "_{frame}.png" : ".png");
}

void print_explanations(const Scene& scene, const Frame& frame) {
  std::size_t index = 0;
  const auto print = [&](const std::string& name) {
    std::string text = frame.explain(index);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::cout << "draw " << index++ << ", " << name << ":\n" << text << "\n";
  };
  for (const SceneCommand& command : scene.frame) {
    if (const auto* draw = std::get_if<DrawCommand>(&command.what))
      print("\"" + scene.meshes[draw->mesh].name + "\"");
    if (std::holds_alternative<BitmapCommand>(command.what)) print("a bitmap");
    if (std::holds_alternative<ImageCommand>(command.what)) print("an image");
  }
}

std::string plane_path(const fs::path& folder, Buffer which, int k) {
  char name[32];
  std::snprintf(name, sizeof name, "%s_%02d.pbm", buffer_name(which), k);
  return (folder / name).string();
}

// Buffers that the format has but the frame never touched hold what new buffers hold.
void write_planes(const FrameBuffer& buffer, const fs::path& folder, const FileGuard& guard) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error("cannot make the folder \"" + folder.string() + "\": " + error.message());
  for (const Buffer which : kBuffers)
    for (int k = 0; k < buffer.plane_count(which); ++k) {
      const std::string file = plane_path(folder, which, k);
      guard.check_plane(file);
      write_plane(buffer.plane(which, k), file);
    }
}

/// Frames of at most 8 bits a pixel are PNG files of that many bits.
bool is_indexed_png(const FrameBufferFormat& format, const std::string& path) {
  const bool few = format.color_mode == ColorMode::index ? format.color_bits <= 8 : format.color_bits <= 2;
  return few && lower_case_extension(path) == ".png";
}

IndexedPicture indexed_picture(const FrameBuffer& buffer) {
  const FrameBufferFormat& format = buffer.format();
  IndexedPicture picture{.width = format.width, .height = format.height};
  while (picture.bits / 2 >= format.color_bits) picture.bits /= 2;
  std::vector<std::uint32_t> words(static_cast<std::size_t>(format.width) *
                                   static_cast<std::size_t>(format.height));
  buffer.read_color_words(words);
  picture.indices.assign(words.begin(), words.end());
  if (format.color_mode == ColorMode::index) {
    // Entries that are not set show black.
    picture.palette.resize(std::size_t{3} << format.color_bits);
    for (std::size_t i = 0; i < format.palette.size(); ++i) {
      const Color& c = format.palette[i];
      const float components[3] = {c.r, c.g, c.b};
      for (std::size_t k = 0; k < 3; ++k)
        picture.palette[3 * i + k] = static_cast<std::uint8_t>(components[k] * 255 + 0.5f);
    }
  }
  return picture;
}

/// What has to be read after the frame.
void keep(bool planes, bool words, Frame& frame) {
  if (planes) frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
  else if (words) frame.keep({Buffer::color});
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void print_log(LogLevel min_level, LogLevel level, std::string_view message) {
  constexpr const char* kNames[] = {"debug", "info", "warning"};
  if (level >= min_level)
    std::cerr << "tessera: " << kNames[static_cast<int>(level)] << ": " << printable(message) << "\n";
}

// In a rendering of its own, which nobody times.
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
  const Difference difference = compare(picture, reference, request.threshold);
  char share[32];
  std::snprintf(share, sizeof share, "%.4f %%", 100 * difference.share);
  std::cerr << "tessera: " << difference.pixels << " pixels (" << share << ") are more than "
            << request.threshold << " of 255 levels from \"" << request.reference
            << "\"; the largest difference is " << difference.largest << "\n";
  return difference.pixels == 0 ? 0 : kDiffers;
}

// Before anything is rendered.
void check_files(const RenderRequest& request, const std::string& path, const FileGuard& guard) {
  for (int f = 0; f < request.frames; ++f) {
    if (Interrupt::pressed()) throw Cancelled("the look at the files to be written was interrupted");
    if (!is_stream(path)) guard.check_picture(frame_path(path, f, request.frames));
    if (request.planes_folder.empty()) continue;
    const std::string folder = frame_path(request.planes_folder, f, request.frames);
    std::error_code error;
    if (!fs::exists(fs::weakly_canonical(folder, error), error)) continue;
    for (const Buffer which : kBuffers)
      for (int k = 0; k < max_planes(which); ++k) guard.check_plane(plane_path(folder, which, k));
  }
}

// What cannot go together is said before anything is rendered.
void check_outputs(const RenderRequest& request, const std::string& path) {
  const auto require_frame = [&](const std::string& name) {
    if (request.frames > 1 && name.find("{frame}") == std::string::npos)
      throw Error("--frames " + std::to_string(request.frames) + " would write \"" + name +
                  "\" again and again; put {frame} into the name");
  };
  if (!is_stream(path)) require_frame(path);
  if (!request.planes_folder.empty()) require_frame(request.planes_folder);
  const char* const rivals[] = {is_stream(path) ? "the picture" : "", request.explain ? "--explain" : "",
                                request.stats == StatsFormat::json ? "--stats=json" : ""};
  std::string found;
  for (const char* rival : rivals) {
    if (*rival == '\0') continue;
    if (!found.empty()) throw Error(found + " and " + rival + " cannot both go to the standard output");
    found = rival;
  }
}

}  // namespace

int render(RenderRequest request) {
  const auto start = std::chrono::steady_clock::now();
  const Interrupt interrupt;
  Input input(request);
  for (const std::string& warning : input.scene().warnings)
    std::cerr << "tessera: warning: " << printable(warning) << "\n";
  RunStats run;
  run.load_ms = milliseconds_since(start);

  const std::string path = output_path(request);
  check_outputs(request, path);
  const FileGuard guard(input.files(), request.reference, request.output.path.empty() ? path : "");
  check_files(request, path, guard);
  std::optional<Picture> reference;
  if (!request.reference.empty()) reference = read_picture(request.reference);

  std::optional<ThreadLimit> more_threads_than_cores;
  if (request.options.threads > available_cores()) more_threads_than_cores.emplace(request.options.threads);
  Progress progress(request.progress);
  int done_renders = 0;
  std::string what;
  request.options.progress = [&](double done) {
    progress.show((done_renders + done) / (static_cast<double>(request.frames) * request.repeat), what);
    return !Interrupt::pressed();
  };
  if (request.log)
    request.options.log = [&progress, min_level = *request.log](LogLevel level, std::string_view message) {
      progress.clear();
      print_log(min_level, level, message);
    };
  Renderer renderer(request.options);
  run.options = renderer.options();

  int exit_code = 0;
  for (int f = 0; f < request.frames; ++f) {
    what = request.frames > 1 ? "frame " + std::to_string(f + 1) + " of " + std::to_string(request.frames)
                              : "rendering";
    input.move_to(request.frames > 1 ? static_cast<double>(f) / (request.frames - 1) : 0);
    const Scene& scene = input.scene();
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer, renderer);
    Picture picture(scene.framebuffer.width, scene.framebuffer.height);
    const bool indexed = is_indexed_png(buffer.format(), path);
    if (request.explain && f == 0) {
      record(scene, frame);
      print_explanations(scene, frame);
      frame.reset();
    }
    for (int r = 0; r < request.repeat; ++r, ++done_renders) {
      const auto render_start = std::chrono::steady_clock::now();
      record(scene, frame);
      keep(!request.planes_folder.empty(), indexed, frame);
      run.frame = renderer.finish(frame, picture.target());
      run.render_ms.push_back(milliseconds_since(render_start));
    }
    progress.clear();
    const auto write_start = std::chrono::steady_clock::now();
    const std::string file = frame_path(path, f, request.frames);
    if (!is_stream(path)) guard.check_picture(file);
    if (indexed) write_indexed_png(indexed_picture(buffer), file, request.output.compression);
    else write_output(picture, file, request.output.compression);
    if (!request.planes_folder.empty())
      write_planes(buffer, frame_path(request.planes_folder, f, request.frames), guard);
    run.write_ms += milliseconds_since(write_start);
    for (std::size_t i = 0; i < run.buffer_bytes.size(); ++i)
      run.buffer_bytes[i] = buffer.allocated_bytes(kBuffers[i]);
    if (request.output.path.empty()) std::cerr << "tessera: wrote " << printable(file) << "\n";
    if (request.stats != StatsFormat::none && f + 1 == request.frames)
      run.frame.fragments = count_fragments(scene, run.options);
    if (reference && f + 1 == request.frames) exit_code = report_difference(picture, *reference, request);
  }
  if (request.stats == StatsFormat::text) std::cerr << stats_text(run);
  if (request.stats == StatsFormat::json) std::cout << stats_json(run);
  return exit_code;
}

}  // namespace tessera::program::cli
