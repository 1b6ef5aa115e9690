// A simulated screen: turns pictures into the light that a person sees. Part of the library tessera::display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "display.hpp"
#include "display_export.h"
#include "enums.hpp"
#include "scan_timing.hpp"

namespace tessera {

/// Size and timing of the pictures that a screen shows.
struct VideoMode {
  int width = 640, height = 480;  ///< pixels, 1 to 16384
  double pixel_aspect = 1;        ///< width of a pixel to its height, 0.1 to 10
  /// Absent: 60 frames per second with 25 % of a line and 5 % of a frame blank.
  std::optional<ScanTiming> timing{};
};

/// The part of a screen that an image shows, and the size of the image.
struct ScreenView {
  double scale_px_per_mm = 0;          ///< above 0; 0: 1440 rows for the part's height
  double x_mm = 0, y_mm = 0;           ///< upper left corner of the part, from that of the screen
  double width_mm = 0, height_mm = 0;  ///< size of the part; 0: up to the lower right corner of the screen
  /// Exposure: the brightest pixel of a white picture has this value in its largest component, 0.01 to 100.
  /// Above 1, sRGB images clip it.
  double gain = 1;
};

/// A picture, as levels or as bitplanes. Exactly one of `rgb` and `planes` is set.
struct VideoPicture {
  /// Levels of 8 bits, red, green, blue and pixel_bytes - 3 more bytes per pixel; rows from the top.
  std::span<const std::uint8_t> rgb{};
  int pixel_bytes = 3;              ///< 3 or 4
  std::ptrdiff_t stride_bytes = 0;  ///< from a row of `rgb` to the next; 0: width * pixel_bytes
  /// Plane k holds bit k of each pixel, bit 7 of a byte leftmost; 1 to 24 planes.
  std::vector<std::span<const std::uint8_t>> planes{};
  std::ptrdiff_t plane_stride_bytes = 0;  ///< 0: (width + 7) / 8
  /// Colours of pixel values: red << 16 | green << 8 | blue. Values beyond it are black. Empty: luminance at
  /// 1 and 2 planes, else red, green and blue levels as a frame buffer stores them.
  std::span<const std::uint32_t> palette{};
};

/// Where an image goes. Either pointer may be null.
struct ScreenImage {
  std::uint8_t* rgb = nullptr;      ///< sRGB, 3 bytes per pixel, rows from the top
  std::ptrdiff_t stride_bytes = 0;  ///< from a row of `rgb` to the next; 0: 3 * width
  /// Linear light of the primaries of BT.709, 3 floats per pixel without gaps. Light outside of its gamut has
  /// components below 0.
  float* light = nullptr;
};

/// Threads that run parts of a picture: any object with the members workers() and run() of
/// tessera::Executor. Default: the calling thread.
struct ScreenWorkers {
  int count = 1;
  void* executor = nullptr;
  void (*run)(void* executor, int count, void (*work)(void* context, int worker), void* context) = nullptr;

  ScreenWorkers() = default;
  /// @param runner  must outlive the object
  template <class Executor>
  requires requires(Executor& e) { e.workers(); }
  explicit ScreenWorkers(Executor& runner)
      : count(runner.workers()),
        executor(&runner),
        run([](void* self, int n, void (*work)(void*, int), void* context) {
          static_cast<Executor*>(self)->run(n, work, context);
        }) {}
};

/// A display that shows pictures of one mode, seen through one view. Keeps the afterglow of phosphors, the
/// state of liquid crystals and the ghosts of paper between pictures.
///
/// Steps: pixels -> levels -> signal -> light of the display's primaries -> geometry -> image -> sRGB. All
/// averages are taken of linear light.
/// - The brightest pixel of a white picture is ScreenView::gain in its largest component; white_level() tells
///   how bright white is on average. Structure costs brightness: phosphors emit on a third of the area.
/// - The same bits on every machine, for every number of workers and every instruction set.
/// - One call at a time per object.
/// @code
/// Screen screen(find_display("crt:pitch=0.31,mask=grille"), {.width = 640, .height = 480});
/// std::vector<std::uint8_t> image(std::size_t{3} * screen.width() * screen.height());
/// for (int frame = 0; frame < 3; ++frame)  // `pixels`: 4 bytes per pixel
///   screen.show({.rgb = pixels, .pixel_bytes = 4}, frame * screen.frame_ms(), {.rgb = image.data()});
/// @endcode
class TESSERA_DISPLAY_API Screen {
 public:
  /// @throws DisplayError  if a value is out of range, or the image would have more than 16384 rows or
  /// columns
  Screen(const Display& display, const VideoMode& mode, const ScreenView& view = {},
         ScreenWorkers workers = {}, InstructionSet instruction_set = InstructionSet::automatic);
  ~Screen();
  Screen(Screen&&) noexcept;
  Screen& operator=(Screen&&) noexcept;

  int width() const;         ///< columns of the image
  int height() const;        ///< rows of the image
  double width_mm() const;   ///< size of the whole screen
  double height_mm() const;  ///< size of the whole screen
  double frame_ms() const;   ///< time from one frame of the mode to the next

  /// Mean light of a white picture in the image, relative to the light of an image that is white throughout.
  double white_level() const;

  /// Facts about the view that a user should know: a mask that is too fine for the image, more columns than
  /// the tube can show.
  const std::vector<std::string>& notes() const;

  /// Shows a picture and collects its light from `time_ms` on, for the exposure time of the display.
  /// - The picture replaces the one before at the last frame that begins at or before `time_ms`. The one
  ///   before was shown by every frame in between.
  /// - `time_ms` must not be smaller than in the call before.
  /// @throws DisplayError  for a picture that does not have the mode's size, and for times that are not
  ///                       finite or run backwards
  void show(const VideoPicture& picture, double time_ms, const ScreenImage& image);

  /// Forgets all pictures that were shown.
  void reset();

 private:
  struct __attribute__((visibility("hidden"))) State;
  std::unique_ptr<State> state_;
};

/// A frame as the signal of ntsc or pal: all lines in the order of time, with sync, burst and blanking.
/// - A line begins with its sync. On S-Video, one wire has luma and sync, the other chroma and burst.
/// - Lines begin at their own times: PAL's have 1135.0064 samples, of which the last fraction is left out.
/// - Television's phase_deg and gain are applied to the signal; receivers' filters are not.
struct VideoSignal {
  int samples_per_line = 0;
  int lines = 0;
  double sample_rate_hz = 0;   ///< four times the subcarrier
  std::string_view unit;       ///< "IRE" or "mV"; blanking is 0
  std::vector<float> samples;  ///< line after line; S-Video: luma
  std::vector<float> chroma;   ///< S-Video: as many samples of chroma; composite: empty
  int first_sample = 0;        ///< sample of a line at the left edge of the picture
  double samples_per_pixel = 0;
  std::vector<int> row_lines;  ///< for each row of pixels, the first line that shows it, from 0
};

/// The signal that brings a picture to a television.
/// @param time_ms  selects the frame, by which the subcarrier's phase changes; from 0, when frame 0 begins
/// @throws DisplayError  for displays other than ntsc and pal, values out of range, and pictures that do not
///                       have the mode's size
TESSERA_DISPLAY_API VideoSignal video_signal(const Display& display, const VideoMode& mode,
                                             const VideoPicture& picture, double time_ms = 0);

}  // namespace tessera
