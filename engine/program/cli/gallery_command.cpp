#include "engine/program/cli/gallery_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/program/cli/command_options.h"
#include "engine/program/cli/contact_sheet.h"
#include "engine/program/cli/gallery_list.h"
#include "engine/program/cli/gallery_page.h"
#include "engine/program/cli/output_folder.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/render_command.h"
#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/picture.h"
#include "engine/program/scene/text_file.h"

namespace tessera::program::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "index.html";
constexpr const char* kSheet = "index.png";
constexpr int kMaxColumns = 10;

class Gallery {
 public:
  explicit Gallery(const GalleryRequest& request) : request_(request), folder_(request.folder) {}
  void run();

 private:
  std::string path_of(const std::string& file) const { return (folder_ / file).string(); }
  bool exists(const std::string& file) const;
  bool is_requested(const GalleryPicture& picture) const;
  void find_own_files();
  void choose_pictures();
  void refuse_other_files() const;
  void write_page() const;
  void draw(const GalleryPicture& picture) const;
  void write_sheet() const;

  const GalleryRequest& request_;
  fs::path folder_;
  std::set<std::string> own_files_;           ///< files that the page of an earlier run links
  std::vector<const GalleryPicture*> drawn_;  ///< in this run
  std::vector<const GalleryPicture*> shown_;  ///< on page and sheet
};

/// The request of the picture's command.
RenderRequest render_request(const GalleryPicture& picture) {
  RenderRequest request;
  CLI::App program;
  add_render(program, request);
  std::vector<std::string> words(picture.options.rbegin(),
                                 picture.options.rend());  // CLI11 takes the last first
  words.insert(words.end(), {picture.picture_file(), "-o", "render"});
  program.parse(std::move(words));
  return request;
}

/// Width to height of a picture on its screen, if it has the pixels of a display mode.
std::optional<double> mode_aspect(const GalleryPicture& picture) {
  const RenderRequest request = render_request(picture);
  const std::optional<DisplayMode>& mode = request.overrides.mode;
  if (!mode || request.display.display) return std::nullopt;
  return mode->pixel_aspect.value() * mode->width / mode->height;
}

/// Columns of a sheet about 1.6 times as wide as high, whose cells are 4:3 with a label.
int column_count(int pictures) {
  int columns = 1;
  while (columns < std::min(kMaxColumns, pictures) && columns * columns * 5 < pictures * 8) ++columns;
  return columns;
}

bool Gallery::exists(const std::string& file) const {
  std::error_code error;
  return fs::exists(folder_ / file, error);
}

bool Gallery::is_requested(const GalleryPicture& picture) const {
  return request_.names.empty() || std::ranges::find(request_.names, picture.name) != request_.names.end();
}

void Gallery::find_own_files() {
  if (exists(kPage)) own_files_ = files_of_page(read_text_file(path_of(kPage)));
}

void Gallery::choose_pictures() {
  for (const GalleryPicture& picture : gallery_pictures()) {
    const auto is_there = [this](const std::string& file) {
      return own_files_.contains(file) && exists(file);
    };
    if (is_requested(picture)) drawn_.push_back(&picture);
    if (is_requested(picture) || std::ranges::all_of(picture.files(), is_there)) shown_.push_back(&picture);
  }
}

void Gallery::refuse_other_files() const {
  std::vector<std::string> files{kPage, kSheet};
  for (const GalleryPicture* picture : drawn_) std::ranges::copy(picture->files(), std::back_inserter(files));
  for (const std::string& file : files)
    if (exists(file) && !own_files_.contains(file))
      throw Error(cli::quoted(path_of(file)) +
                  " exists and is not a file of a gallery; move it away, or name another folder");
}

void Gallery::run() {
  find_own_files();
  choose_pictures();
  refuse_other_files();
  prepare_folder(request_.folder, kPage);
  write_page();
  Progress progress(ShowProgress::automatic);
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    progress.show(static_cast<double>(i) / static_cast<double>(drawn_.size()), drawn_[i]->name);
    if (Interrupt::pressed()) throw Cancelled("interrupted");
    draw(*drawn_[i]);
  }
  write_sheet();
  progress.clear();
  std::cout << drawn_.size() << (drawn_.size() == 1 ? " picture" : " pictures") << " in "
            << printable(request_.folder) << "; " << kPage << " shows " << shown_.size() << "\n";
}

void Gallery::write_page() const {
  std::vector<ShownGalleryPicture> pictures;
  for (const GalleryPicture* picture : shown_) pictures.push_back({picture, mode_aspect(*picture)});
  write_file_atomically(path_of(kPage), gallery_page(pictures));
}

void Gallery::draw(const GalleryPicture& picture) const {
  write_file_atomically(path_of(picture.scene_file()), gallery_content(picture.scene_file()));
  for (const std::string& input : picture.inputs)
    write_file_atomically(path_of(input), gallery_content(input));
  RenderRequest request = render_request(picture);
  request.input = path_of(picture.scene_file());
  request.output.path = path_of(picture.picture_file());
  request.options.threads = request_.threads;
  request.progress = ShowProgress::never;
  render(std::move(request));
}

void Gallery::write_sheet() const {
  const int columns = column_count(static_cast<int>(shown_.size()));
  std::vector<SheetCell> cells;
  for (const GalleryPicture* picture : shown_) {
    const Picture drawn = read_picture(path_of(picture->picture_file()));
    const double aspect = mode_aspect(*picture).value_or(static_cast<double>(drawn.width) / drawn.height);
    cells.push_back({{cell_picture(drawn, aspect, cell_size(columns))}, {picture->name}});
  }
  write_picture(contact_sheet(cells, columns), path_of(kSheet));
}

}  // namespace

void gallery(const GalleryRequest& request) {
  if (request.list) {
    std::cout << gallery_list_text();
    return;
  }
  const Interrupt interrupt;
  Gallery(request).run();
}

}  // namespace tessera::program::cli
