#include "engine/program/cli/display_comparison.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/program/cli/contact_sheet.h"
#include "engine/program/cli/formatted.h"
#include "engine/program/cli/mode_pictures.h"
#include "engine/program/cli/output_folder.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/shown_pictures.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program::cli {
namespace {

constexpr int kSheetColumns = 5;

/// An image of a screen, and the gain it is exposed with.
struct ExposedImage {
  Picture picture;
  double gain;
};

/// Returns whether patterns of pixels become colours. A receiver then takes the mean of the signal over four
/// columns, one cycle of the subcarrier: those of bayer4 give even colours.
bool has_artifact_colors(const Display& display, const DisplayMode& mode) {
  return display.kind == DisplayKind::ntsc && mode.color_bits == 1;
}

std::string_view kind_name(DisplayKind kind) {
  const auto kinds = display_kinds();
  return std::ranges::find(kinds, kind, &NamedDisplayKind::kind)->name;
}

double diagonal_in(const Display& display) {
  switch (display.kind) {
    case DisplayKind::lcd: return display.lcd.diagonal_in;
    case DisplayKind::plasma: return display.plasma.diagonal_in;
    case DisplayKind::eink: return display.eink.diagonal_in;
    case DisplayKind::crt:
    case DisplayKind::ntsc:
    case DisplayKind::pal: break;
  }
  return display.crt.diagonal_in;
}

Picture middle_of(const Picture& source, const CellSize& cell) {
  Picture middle(std::min(source.width, cell.width), std::min(source.height, cell.height));
  const int left = (source.width - middle.width) / 2, top = (source.height - middle.height) / 2;
  for (int y = 0; y < middle.height; ++y) {
    const auto from = source.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(top + y) * source.width + left);
    std::copy(from, from + std::ptrdiff_t{4} * middle.width,
              middle.rgba.begin() + std::ptrdiff_t{4} * y * middle.width);
  }
  return middle;
}

/// Options of `tessera display` for the two images of a preset.
std::string views_line(const DisplayPreset& preset, double whole_gain, const ScreenView& near,
                       double near_gain) {
  return formatted("%-13s  %-10s  --gain %-5.2f  --part %.3f,%.3f,%.3f,%.3f --scale %.2f --gain %.2f\n",
                   std::string(preset.name).c_str(), std::string(preset.mode).c_str(), whole_gain, near.x_mm,
                   near.y_mm, near.width_mm, near.height_mm, near.scale_px_per_mm, near_gain);
}

class DisplayComparison {
 public:
  explicit DisplayComparison(const DisplayComparisonRequest& request);
  void run();

 private:
  Scene scene_on(const Display& display, const DisplayMode& mode);
  void add_preset(const DisplayPreset& preset);
  ExposedImage exposed(const Display& display, const VideoMode& mode, ScreenView view,
                       const Picture& picture) const;
  void write(Picture& image, const std::string& file) const;

  const DisplayComparisonRequest& request_;
  ModeScenes scenes_;
  Progress progress_{ShowProgress::automatic};
  Renderer renderer_;
  std::vector<SheetCell> cells_;
  std::string views_ = "preset         mode        whole screen  close-up\n";
};

DisplayComparison::DisplayComparison(const DisplayComparisonRequest& request)
    : request_(request),
      scenes_(request.input),
      renderer_({.threads = request.threads, .progress = [](double) { return !Interrupt::pressed(); }}) {}

/// Blue noise in light leaves the fewest patterns.
Scene DisplayComparison::scene_on(const Display& display, const DisplayMode& mode) {
  if (has_artifact_colors(display, mode)) return scenes_.in_mode(mode, Dither::bayer4, DitherSpace::levels);
  const Dither dither = mode.color_bits == 24 ? Dither::none : Dither::blue_noise;
  return scenes_.in_mode(mode, dither, DitherSpace::light);
}

ExposedImage DisplayComparison::exposed(const Display& display, const VideoMode& mode, ScreenView view,
                                        const Picture& picture) const {
  ShownPictures shown({.display = display, .view = view}, mode, "", request_.threads);
  shown.show(picture);
  view.gain = exposure_gain(shown.image(), shown.white_level());
  ShownPictures brightened({.display = display, .view = view}, mode, "", request_.threads);
  brightened.show(picture);
  return {brightened.image(), view.gain};
}

void DisplayComparison::write(Picture& image, const std::string& file) const {
  image.channels = 3;
  write_picture(image, (std::filesystem::path(request_.folder) / file).string());
}

void DisplayComparison::add_preset(const DisplayPreset& preset) {
  const std::string name(preset.name);
  const Display display = find_display(name);
  const DisplayMode mode = display_mode(std::string(preset.mode));
  const VideoMode video = video_mode(mode);
  const Picture picture = draw_in_mode(scene_on(display, mode), renderer_, FrameTimes::none).picture;
  const ScreenSize screen = ShownPictures({.display = display}, video, "", request_.threads).size();
  const ScreenView near = close_up_view(display, video, screen, request_.place);
  const CellSize cell = cell_size(kSheetColumns);
  const double cell_scale = std::min(cell.width / screen.width_mm, cell.height / screen.height_mm);
  ExposedImage whole = exposed(display, video, {}, picture);
  ExposedImage close_up = exposed(display, video, near, picture);
  ExposedImage small = exposed(display, video, {.scale_px_per_mm = cell_scale}, picture);
  write(whole.picture, name + ".png");
  write(close_up.picture, name + "-near.png");
  cells_.push_back({{std::move(small.picture), middle_of(close_up.picture, cell)},
                    {name, formatted("%s %g in, %s", std::string(kind_name(display.kind)).c_str(),
                                     diagonal_in(display), mode.name.c_str())}});
  views_ += views_line(preset, whole.gain, near, close_up.gain);
}

void DisplayComparison::run() {
  const auto presets = display_presets();
  const DisplayMode first_mode = display_mode(std::string(presets.front().mode));
  scenes_.in_mode(first_mode, Dither::none, DitherSpace::levels);  // a broken scene leaves no folder
  prepare_folder(request_.folder, "contact.png");
  for (std::size_t i = 0; i < presets.size(); ++i) {
    progress_.show(static_cast<double>(i) / static_cast<double>(presets.size()),
                   std::string(presets[i].name));
    if (Interrupt::pressed()) throw Cancelled("interrupted");
    add_preset(presets[i]);
  }
  Picture sheet = contact_sheet(cells_, kSheetColumns);
  write(sheet, "contact.png");
  progress_.clear();
  std::cout << views_;
}

}  // namespace

void compare_displays(const DisplayComparisonRequest& request) {
  const Interrupt interrupt;
  std::optional<ThreadLimit> raised_limit;
  if (request.threads > available_cores()) raised_limit.emplace(request.threads);
  DisplayComparison comparison(request);
  comparison.run();
}

}  // namespace tessera::program::cli
