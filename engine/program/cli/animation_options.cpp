#include "engine/program/cli/animation_options.h"

#include "engine/program/cli/picture_output.h"
#include "engine/program/cli/usage_error.h"
#include "engine/program/cli/validators.h"

namespace tessera::program::cli {
namespace {

constexpr int kMaxFrames = 1000000;

/// @param otherwise  another way out, for the message
void require_frame_name(const RenderRequest& request, const std::string& option, const std::string& path,
                        const std::string& otherwise) {
  if (request.frames > 1 && !path.empty() && !names_frames(path))
    throw UsageError(option + ": " + std::to_string(request.frames) + " frames would overwrite \"" + path +
                     "\"; put {frame} into the name" + otherwise);
}

}  // namespace

void add_animation(CLI::App& command, RenderRequest& request) {
  CLI::Option* const frames =
      command
          .add_option("--frames", request.frames,
                      "pictures of an animation, t = 0 .. 1; {frame} in names is the number; default: 1")
          ->option_text("N")
          ->transform(integer_from(1, kMaxFrames));
  const auto turn = [&request](int pictures) {
    request.frames = pictures;
    request.overrides.turntable = true;
  };
  command
      .add_option_function<int>(
          "--turntable", turn,
          "pictures of one turn of the scene around its vertical axis; after the last comes the first again; "
          "{frame} in names is the number; default: no turn")
      ->option_text("N")
      ->transform(integer_from(1, kMaxFrames))
      ->excludes(frames);
  command
      .add_option("--delay", request.output.delay_ms,
                  "milliseconds from frame to frame of an animated PNG, 1 .. 65535; default: 40")
      ->option_text("MS")
      ->transform(integer_from(1, kMaxDelayMs));
}

void check_animation(const RenderRequest& request) {
  const std::string& path = request.output.path;
  const bool is_animation = is_animated_png(path, request.frames);
  if (!is_stream(path) && !is_animation)
    require_frame_name(request, "-o", path, ", or write an animated .png");
  require_frame_name(request, "--dump", request.dump, "");
  require_frame_name(request, "--planes", request.planes_folder, "");
  request.given.require(
      {{"--delay", is_animation, "is for animated PNG files: several frames, -o FILE.png without {frame}"}});
}

}  // namespace tessera::program::cli
