#include "engine/program/cli/display_command.h"

#include <iostream>

#include "engine/program/cli/display_list.h"
#include "engine/program/cli/file_guard.h"
#include "engine/program/cli/formatted.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/shown_pictures.h"
#include "engine/program/cli/usage_error.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/float_picture.h"

namespace tessera::program::cli {
namespace {

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

int frame_count(const DisplayCommandRequest& request) { return static_cast<int>(request.pictures.size()); }

/// Refuses a file that would overwrite itself or a picture.
void check_file(const std::string& path, const std::string& option, const DisplayCommandRequest& request) {
  const int frames = frame_count(request);
  if (frames > 1 && path.find("{frame}") == std::string::npos)
    throw UsageError(std::to_string(frames) + " pictures would overwrite \"" + path +
                     "\" with every frame; put {frame} into the name");
  for (int f = 0; f < frames; ++f)
    for (const std::string& picture : request.pictures)
      refuse_overwriting(frame_path(path, f, frames), picture, "input", option);
  require_writable_picture(frame_path(path, 0, frames));
}

/// Refuses wrong outputs before anything is read.
void check_outputs(const DisplayCommandRequest& request) {
  if (!is_stream(request.output.path)) check_file(request.output.path, "-o", request);
  if (!request.signal.empty()) check_file(request.signal, "--signal", request);
  if (request.signal == request.output.path)
    throw UsageError("the image and --signal are both \"" + request.signal + "\"");
}

/// Writes the lines of the frame that begins with a picture; with S-Video those of luma, then of chroma.
void write_signal(const VideoSignal& signal, const std::string& path) {
  std::vector<float> samples = signal.samples;
  samples.insert(samples.end(), signal.chroma.begin(), signal.chroma.end());
  const int rows = static_cast<int>(samples.size()) / signal.samples_per_line;
  write_file_atomically(path, encode_pfm(signal.samples_per_line, rows, 1, samples));
}

void print_signal_note(const VideoSignal& signal) {
  std::cerr << "tessera: note: the signal has " << signal.lines << " lines of " << signal.samples_per_line
            << " samples in " << signal.unit << ", " << formatted("%.9g", signal.sample_rate_hz / 1e6)
            << " MHz; pixels begin at sample " << signal.first_sample << " and take "
            << formatted("%.6g", signal.samples_per_pixel) << " samples; the first row is line "
            << signal.row_lines.front() << "\n";
}

/// @param expected  what the size belongs to: "display mode \"cga\""
void require_size(const Picture& picture, const std::string& name, const VideoMode& mode,
                  const std::string& expected) {
  if (picture.width != mode.width || picture.height != mode.height)
    throw Error("\"" + name + "\" is " + size_text(picture.width, picture.height) + ", expected " +
                size_text(mode.width, mode.height) + ", the size of " + expected);
}

void show_pictures(const DisplayCommandRequest& request) {
  check_outputs(request);
  const Interrupt interrupt;
  const int frames = frame_count(request);
  Picture picture = read_picture(request.pictures.front());
  const VideoMode mode =
      request.mode ? video_mode(*request.mode) : VideoMode{.width = picture.width, .height = picture.height};
  const std::string sized = request.mode ? "display mode " + cli::quoted(request.mode->name)
                                         : "the first picture " + cli::quoted(request.pictures.front());
  require_size(picture, request.pictures.front(), mode, sized);
  ShownPictures shown(request.display, mode, request.output.path, request.threads);
  shown.print_notes();
  for (int f = 0; f < frames; ++f) {
    if (Interrupt::pressed()) throw Cancelled("interrupted");
    if (f > 0) {
      const std::string& name = request.pictures[static_cast<std::size_t>(f)];
      picture = read_picture(name);
      require_size(picture, name, mode, sized);
    }
    if (!request.signal.empty()) {
      const VideoSignal signal = video_signal(*request.display.display, mode,
                                              {.rgb = picture.rgba, .pixel_bytes = 4}, shown.next_ms());
      write_signal(signal, frame_path(request.signal, f, frames));
      if (f == 0) print_signal_note(signal);
    }
    shown.show(picture);
    shown.write(frame_path(request.output.path, f, frames), request.output.compression);
  }
}

}  // namespace

void display(const DisplayCommandRequest& request) {
  if (request.list) std::cout << (request.json ? display_list_json() : display_list_text());
  else if (request.presets)
    compare_displays({.input = request.pictures.empty() ? "" : request.pictures.front(),
                      .folder = request.output.path,
                      .place = request.place,
                      .threads = request.threads});
  else show_pictures(request);
}

}  // namespace tessera::program::cli
