#include "engine/program/cli/picture_output.h"

#include <algorithm>
#include <utility>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/float_picture.h"
#include "engine/program/imageio/pbm.h"
#include "engine/program/imageio/png.h"
#include "engine/program/scene/file_extension.h"

namespace tessera::program::cli {
namespace {

/// Bytes of a waiting picture: RGBA, its filtered rows and their compressed form.
constexpr std::size_t kBytesPerPixel = 4 + 3 + 3;

int max_waiting(int threads, std::size_t pixels) {
  const std::size_t fitting =
      PictureOutput::kMaxWaitingBytes / (kBytesPerPixel * std::max<std::size_t>(pixels, 1));
  return static_cast<int>(std::clamp<std::size_t>(fitting, 1, static_cast<std::size_t>(threads) + 1));
}

void write_file(const FinishedPicture& finished, const std::string& path, int compression) {
  const Picture& picture = *finished.picture;
  if (finished.indexed) write_indexed_png(*finished.indexed, path, compression);
  else if (finished.one_bit) write_file_atomically(path, encode_pbm(*finished.one_bit));
  else if (!finished.light.empty())
    write_file_atomically(path, encode_pfm(picture.width, picture.height, 3, finished.light));
  else write_output(picture, path, compression);
}

/// The palette of a grey picture, so that it is one of indices: ffmpeg 5.1 decodes no animations of 1-bit
/// greys.
void add_gray_palette(IndexedPicture& picture) {
  const int levels = 1 << picture.bits;
  for (int i = 0; i < levels; ++i)
    picture.palette.insert(picture.palette.end(), 3, static_cast<std::uint8_t>(255 * i / (levels - 1)));
}

PngImage content_as_png(const FinishedPicture& finished) {
  if (finished.indexed) return as_png(*finished.indexed);
  return as_png(*finished.picture, finished.picture->keeps_alpha ? 4 : 3);
}

}  // namespace

bool is_animated_png(const std::string& path, int frames) {
  return frames > 1 && !names_frames(path) && lower_case_extension(path) == ".png";
}

PictureOutput::PictureOutput(const OutputRequest& request, int frames, int threads, std::size_t pixels)
    : request_(request), frames_(frames), queue_(std::min(threads, frames), max_waiting(threads, pixels)) {
  if (is_animated_png(request.path, frames))
    animation_.emplace(request.path, frames, request.delay_ms.value_or(kDefaultDelayMs));
}

std::shared_ptr<Picture> PictureOutput::spare_picture(int width, int height) {
  while (!spare_.empty()) {
    const std::shared_ptr<Picture> picture = std::move(spare_.back());
    spare_.pop_back();
    if (picture->width == width && picture->height == height) return picture;
  }
  return std::make_shared<Picture>(width, height);
}

void PictureOutput::add(FinishedPicture picture, int frame, const std::function<void()>& last_step) {
  if (animation_ && picture.indexed && picture.indexed->palette.empty()) add_gray_palette(*picture.indexed);
  const auto finished = std::make_shared<const FinishedPicture>(std::move(picture));
  if (animation_) return add_to_animation(finished, last_step);
  const auto write = [finished, path = frame_path(request_.path, frame, frames_),
                      compression = request_.compression] { write_file(*finished, path, compression); };
  const auto end = [this, finished, last_step] {
    spare_.push_back(finished->picture);
    last_step();
  };
  if (!is_stream(request_.path) && !is_written_by_module(request_.path)) return queue_.add(write, end);
  write();
  end();
}

void PictureOutput::add_to_animation(const std::shared_ptr<const FinishedPicture>& finished,
                                     const std::function<void()>& last_step) {
  const auto image = std::make_shared<const PngImage>(content_as_png(*finished));
  const auto data = std::make_shared<std::string>();
  const auto compress = [finished, image, data, compression = request_.compression] {
    *data = compress_pixels(*image, compression);
  };
  const auto end = [this, finished, image, data, last_step] {
    animation_->add(*image, *data);
    spare_.push_back(finished->picture);
    last_step();
  };
  queue_.add(compress, end);
}

void PictureOutput::finish() {
  queue_.finish();
  if (animation_) animation_->finish();
}

}  // namespace tessera::program::cli
