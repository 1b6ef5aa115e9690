#include "engine/program/cli/mode_comparison.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>

#include "engine/program/cli/contact_sheet.h"
#include "engine/program/cli/mode_pictures.h"
#include "engine/program/cli/mode_selection.h"
#include "engine/program/cli/mode_table.h"
#include "engine/program/cli/output_folder.h"
#include "engine/program/cli/progress.h"
#include "engine/program/compare/flip.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/scene/dither_names.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program::cli {
namespace {

namespace fs = std::filesystem;

/// One mode per family, from few to many colours: the rows of a sheet of all modes.
constexpr std::string_view kFamilies[] = {"hercules", "gray2",  "cga",   "ega",
                                          "amiga",    "vga13h", "vga15", "vga24"};

/// Row of a group on the sheet of all modes; absent: it is not shown there.
std::optional<std::size_t> family_of(const ModeGroup& group) {
  for (std::size_t row = 0; row < std::size(kFamilies); ++row)
    if (std::ranges::find(group.names, kFamilies[row]) != group.names.end()) return row;
  return std::nullopt;
}

std::size_t pixel_count(const ModeGroup& group) {
  return static_cast<std::size_t>(group.mode.width) * static_cast<std::size_t>(group.mode.height);
}

/// The name of a mode as part of a file name.
std::string file_stem(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == ':' || c == ','; }, '_');
  return name;
}

/// Sizes are not enough: the aspect of a pixel changes what the camera sees.
std::string reference_name(const DisplayMode& mode) {
  const AspectRatio aspect = mode.pixel_aspect;
  const std::string shape =
      aspect.numerator == aspect.denominator
          ? ""
          : "-pixels-" + std::to_string(aspect.numerator) + "x" + std::to_string(aspect.denominator);
  return "reference-" + std::to_string(mode.width) + "x" + std::to_string(mode.height) + shape + ".png";
}

/// Names such as 640x480x12 contain the size.
std::vector<std::string> label_of(const ModeRow& row) {
  const DisplayMode& mode = row.group.mode;
  const std::string size = std::to_string(mode.width) + "x" + std::to_string(mode.height);
  const std::string bits = std::to_string(mode.color_bits) + (mode.color_bits == 1 ? " bit" : " bits");
  return {mode.name + (mode.name.starts_with(size) ? "" : " " + size) + ", " + bits,
          std::string(dither_name(row.dither))};
}

class ModeComparison {
 public:
  explicit ModeComparison(const ModeComparisonRequest& request);
  void run();
  const std::vector<ModeRow>& rows() const { return rows_; }

 private:
  Scene scene_in(const DisplayMode& mode, Dither dither) {
    return scenes_.in_mode(mode, dither, request_.dither_in);
  }
  ModePicture draw_reference(const DisplayMode& mode);
  const Picture& reference(const DisplayMode& mode);
  void add_row(const ModeGroup& group, Dither dither);
  std::optional<std::size_t> sheet_row(const ModeGroup& group) const;
  int sheet_columns() const;
  void write_sheet();
  double flip(const Picture& picture, const Picture& reference, double pixels_per_degree) const;
  std::string path_of(const std::string& file) const { return (fs::path(request_.folder) / file).string(); }

  const ModeComparisonRequest& request_;
  std::vector<ModeGroup> groups_;
  std::vector<Dither> dithers_;
  ModeScenes scenes_;
  Progress progress_{ShowProgress::automatic};
  Renderer renderer_;
  std::map<std::string, Picture> references_;  ///< by file name
  std::vector<ModeRow> rows_;
  std::map<std::size_t, std::vector<SheetCell>> cells_;  ///< by sheet_row()
};

ModeComparison::ModeComparison(const ModeComparisonRequest& request)
    : request_(request),
      groups_(grouped(request.modes.empty() ? modes_with_pixels() : request.modes)),
      dithers_(request.dithers.empty() ? all_dithers() : request.dithers),
      scenes_(request.input, request.import),
      renderer_({.threads = request.threads, .progress = [](double) { return !Interrupt::pressed(); }}) {}

/// @throws Error  also for scenes of palette indices
ModePicture ModeComparison::draw_reference(const DisplayMode& mode) {
  try {
    return draw_in_mode(scene_in(reference_mode(mode), Dither::none), renderer_, FrameTimes::none);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(error.code(),
                std::string("the scene cannot be drawn at 24 bits, to compare with: ") + error.what());
  }
}

/// The picture at 24 bits, drawn when it is first needed.
const Picture& ModeComparison::reference(const DisplayMode& mode) {
  const std::string name = reference_name(mode);
  if (const auto found = references_.find(name); found != references_.end()) return found->second;
  ModePicture drawn = draw_reference(mode);
  drawn.picture.channels = 3;
  write_picture(drawn.picture, path_of(name));
  return references_.emplace(name, std::move(drawn.picture)).first->second;
}

double ModeComparison::flip(const Picture& picture, const Picture& reference,
                            double pixels_per_degree) const {
  return flip_errors(pixels_of(picture), pixels_of(reference),
                     {.pixels_per_degree = pixels_per_degree, .threads = request_.threads})
      .mean;
}

void ModeComparison::add_row(const ModeGroup& group, Dither dither) {
  const DisplayMode& mode = group.mode;
  const Picture& exact = reference(mode);
  ModePicture drawn = draw_in_mode(scene_in(mode, dither), renderer_);
  drawn.picture.channels = 3;
  ModeRow row{.group = group,
              .dither = dither,
              .reduced = drawn.reduced,
              .mode_bytes = memory_bytes(mode),
              .buffer_bytes = drawn.buffer_bytes,
              .frame_ms = drawn.frame_ms,
              .flip_monitor = flip(drawn.picture, exact, kDefaultPixelsPerDegree),
              .flip_own = flip(drawn.picture, exact, own_pixels_per_degree(mode)),
              .picture = file_stem(mode.name) + "-" + std::string(dither_name(dither)) + ".png",
              .reference = reference_name(mode)};
  if (drawn.indexed) write_indexed_png(*drawn.indexed, path_of(row.picture));
  else write_picture(drawn.picture, path_of(row.picture));
  if (const auto sheet_row = this->sheet_row(group)) {
    Picture shown = cell_picture(drawn.picture, mode.screen_aspect(), cell_size(sheet_columns()));
    cells_[*sheet_row].push_back({{std::move(shown)}, label_of(row)});
  }
  rows_.push_back(std::move(row));
}

/// Groups that the user chose have the order in which they were named.
std::optional<std::size_t> ModeComparison::sheet_row(const ModeGroup& group) const {
  if (request_.modes.empty()) return family_of(group);
  return static_cast<std::size_t>(&group - groups_.data());
}

/// One per dither; a single dither fills a grid of modes.
int ModeComparison::sheet_columns() const {
  constexpr std::size_t kGridColumns = 3;
  return static_cast<int>(dithers_.size() > 1 ? dithers_.size() : std::min(kGridColumns, groups_.size()));
}

void ModeComparison::write_sheet() {
  std::vector<SheetCell> cells;
  for (auto& [row, list] : cells_) std::ranges::move(list, std::back_inserter(cells));
  write_picture(contact_sheet(cells, sheet_columns()), path_of("contact.png"));
}

void ModeComparison::run() {
  scene_in(groups_.front().mode, dithers_.front());  // a broken scene leaves no folder
  prepare_folder(request_.folder, "modes.csv");
  double all = 0, done = 0;
  for (const ModeGroup& group : groups_) all += static_cast<double>(pixel_count(group));
  for (const ModeGroup& group : groups_)
    for (const Dither dither : dithers_) {
      progress_.show(done / all, group.mode.name + ", " + std::string(dither_name(dither)));
      if (Interrupt::pressed()) throw Cancelled("interrupted");
      add_row(group, dither);
      done += static_cast<double>(pixel_count(group)) / static_cast<double>(dithers_.size());
    }
  write_sheet();
  write_file_atomically(path_of("modes.csv"), table_csv(rows_));
  write_file_atomically(path_of("modes.json"), table_json(rows_, request_.input));
  progress_.clear();
}

}  // namespace

int compare_modes(const ModeComparisonRequest& request) {
  const Interrupt interrupt;
  std::optional<ThreadLimit> raised_limit;
  if (request.threads > available_cores()) raised_limit.emplace(request.threads);
  ModeComparison comparison(request);
  comparison.run();
  std::cout << (request.json ? table_json(comparison.rows(), request.input) : table_text(comparison.rows()));
  return 0;
}

}  // namespace tessera::program::cli
