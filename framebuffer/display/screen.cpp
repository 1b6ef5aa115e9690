#include "framebuffer/tessera/screen.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "framebuffer/display/check_mode.h"
#include "framebuffer/display/image_rows.h"
#include "framebuffer/display/line_exposure.h"
#include "framebuffer/display/line_times.h"
#include "framebuffer/display/panel_source.h"
#include "framebuffer/display/parallel_parts.h"
#include "framebuffer/display/picture_levels.h"
#include "framebuffer/display/resample_rows.h"
#include "framebuffer/display/scattered_light.h"
#include "framebuffer/display/screen_layout.h"
#include "framebuffer/display/screen_rows.h"
#include "framebuffer/display/tube_source.h"
#include "framebuffer/exact_functions.h"
#include "framebuffer/instruction_set.h"

namespace tessera {

using namespace detail;

namespace {

bool is_tube(const Display& display) {
  return display.kind == DisplayKind::crt || display.kind == DisplayKind::ntsc ||
         display.kind == DisplayKind::pal;
}

void check_exposure(const Display& display, const VideoMode& mode) {
  double exposure_ms = 0;
  if (is_tube(display)) exposure_ms = display.crt.exposure_ms;
  if (display.kind == DisplayKind::plasma) exposure_ms = display.plasma.exposure_ms;
  if (const double frame_ms = frame_scan(mode, {}).frame_ms; exposure_ms > frame_ms)
    throw DisplayError("the exposure is " + short_number(exposure_ms) + " ms, at most one frame of " +
                       short_number(frame_ms) + " ms is possible");
}

InstructionSet chosen(InstructionSet wanted) {
  const std::vector<InstructionSet> available = available_isas();
  if (wanted == InstructionSet::automatic) return available.front();
  if (std::ranges::find(available, wanted) == available.end())
    throw DisplayError("this machine or build lacks the instruction set that was asked for");
  return wanted;
}

}  // namespace

struct Screen::State {
  Display display;
  VideoMode mode;
  ScreenWorkers workers;
  InstructionSet isa;
  FrameScan scan;
  ScreenLayout layout;
  ScreenRows rows;
  ScatteredLight scattered;
  std::unique_ptr<LightSource> source;
  std::optional<double> last_time_ms;

  State(const Display& shown, const VideoMode& video_mode, const ScreenView& view, ScreenWorkers threads,
        InstructionSet instruction_set)
      : display(shown),
        mode(video_mode),
        workers(threads),
        isa(chosen(instruction_set)),
        scan(frame_scan(video_mode, is_tube(shown) ? shown.crt : CrtTube{})),
        layout(is_tube(shown) ? tube_layout(shown, video_mode, view) : panel_layout(shown, video_mode, view)),
        rows(layout, video_mode.height, afterglow()),
        scattered(layout) {
    reset();
  }

  Afterglow afterglow() const {
    const bool is_kept = is_tube(display) && outlasts_frame(display.crt.phosphor);
    return {is_kept, exponential(-scan.frame_ms / decay_ms(display.crt.phosphor)[0])};
  }

  void reset() {
    source = is_tube(display) ? make_tube_source(display, mode, layout.sigma_px, isa)
                              : make_panel_source(display, mode, scan.frame_ms);
    last_time_ms.reset();
  }

  std::int64_t frame_at(double time_ms) const {
    // A frame that begins less than a millionth of a frame later has begun: times of frames are rounded.
    return static_cast<std::int64_t>(std::floor(time_ms / scan.frame_ms + 1e-6));
  }

  void check_time(double time_ms) const;
  void emit_rows(const std::uint8_t* levels, double time_ms);
  void draw_rows(const ScreenImage& image, const LineExposure& exposure);
  void collect_light(int row, const LineExposure& exposure, ImageRow& target) const;
};

void Screen::State::check_time(double time_ms) const {
  constexpr double kMaxMs = 1e12;
  if (!(time_ms >= 0 && time_ms <= kMaxMs))
    throw DisplayError("the time is " + short_number(time_ms) + " ms, expected 0 to 1e12");
  if (last_time_ms && time_ms < *last_time_ms)
    throw DisplayError("the time is " + short_number(time_ms) + " ms, before that of the last picture, " +
                       short_number(*last_time_ms) + " ms");
}

/// Steps pixels to columns: the light of each row of the mode.
void Screen::State::emit_rows(const std::uint8_t* levels, double time_ms) {
  const bool is_first = !last_time_ms.has_value();
  const double since_ms = is_first ? 0 : time_ms - *last_time_ms;
  const std::int64_t frame = frame_at(time_ms);
  const std::int64_t frames = is_first ? 0 : frame - frame_at(*last_time_ms);
  const double phase_ms = std::max(time_ms - static_cast<double>(frame) * scan.frame_ms, 0.0);
  source->begin({levels, frame, phase_ms, since_ms, is_first});
  ResampleRowsFn* const resample = resample_rows_for(isa);
  parallel_parts(workers, rows.blocks(),
                 [&](int block) { rows.emit(*source, layout, resample, block, is_first, frames); });
}

/// Light of the scan lines that reach a row of the image.
void Screen::State::collect_light(int row, const LineExposure& exposure, ImageRow& target) const {
  for (std::size_t color = 0; color < layout.colors; ++color) {
    target.light[color].clear();
    target.scattered[color].clear();
  }
  const auto unscattered = static_cast<float>(1 - layout.scatter.share);
  for (std::size_t plane = 0; plane < layout.planes.size(); ++plane) {
    const auto& [color, horizontal, vertical] = layout.planes[plane];
    const float* weights = vertical.weights_of(row);
    for (int tap = 0; tap < vertical.taps; ++tap) {
      if (weights[tap] == 0) continue;
      const int line = vertical.first[static_cast<std::size_t>(row)] + tap;
      const int source_row = line / layout.lines_per_row;
      const float weight = weights[tap] * unscattered;
      const auto factor = [&](const auto& factors) { return factors[color][static_cast<std::size_t>(line)]; };
      const float present = exposure.is_whole ? 1 : factor(exposure.present);
      target.light[color].push_back({rows.present(source_row, plane), weight * present});
      if (rows.has_afterglow())
        target.light[color].push_back({rows.earlier(source_row, plane), weight * factor(exposure.earlier)});
    }
  }
  if (layout.scatter.share > 0) scattered.add_to(target, layout, row);
}

/// Steps columns to image.
void Screen::State::draw_rows(const ScreenImage& image, const LineExposure& exposure) {
  parallel_parts(workers, scattered.grid_rows(),
                 [&](int row) { scattered.collect(row, layout, rows, exposure); });
  parallel_parts(workers, scattered.grid_rows(), [&](int row) { scattered.spread(row, layout); });
  constexpr int kRowsPerPart = 16;
  const int height = layout.rows.count;
  ImageRowFn* const draw = image_row_for(isa);
  const std::ptrdiff_t stride =
      image.stride_bytes != 0 ? image.stride_bytes : std::ptrdiff_t{3} * layout.columns.count;
  parallel_parts(workers, (height + kRowsPerPart - 1) / kRowsPerPart, [&](int part) {
    ImageRow target{.columns = layout.columns.count, .colors = static_cast<int>(layout.colors)};
    for (std::size_t component = 0; component < 3; ++component)
      for (std::size_t color = 0; color < 3; ++color)
        target.srgb_from_light[component][color] =
            static_cast<float>(layout.srgb_from_light[component][color] / layout.peak);
    for (std::size_t color = 0; color < 3; ++color)
      for (const std::vector<float>& factors : layout.pattern.column_factors[color])
        target.column_factors[color].push_back(factors.data());
    const int end = std::min(height, (part + 1) * kRowsPerPart);
    for (int row = part * kRowsPerPart; row < end; ++row) {
      collect_light(row, exposure, target);
      target.row_factors.clear();
      for (const std::vector<float>& factors : layout.pattern.row_factors)
        target.row_factors.push_back(factors[static_cast<std::size_t>(row)]);
      target.rgb = image.rgb != nullptr ? image.rgb + row * stride : nullptr;
      target.light_out =
          image.light != nullptr ? image.light + std::ptrdiff_t{3} * row * layout.columns.count : nullptr;
      draw(target);
    }
  });
}

Screen::Screen(const Display& display, const VideoMode& mode, const ScreenView& view, ScreenWorkers workers,
               InstructionSet instruction_set) {
  check(display);
  check_mode(mode);
  check_exposure(display, mode);
  state_ = std::make_unique<State>(display, mode, view, workers, instruction_set);
}
Screen::~Screen() = default;
Screen::Screen(Screen&&) noexcept = default;
Screen& Screen::operator=(Screen&&) noexcept = default;

int Screen::width() const { return state_->layout.columns.count; }
int Screen::height() const { return state_->layout.rows.count; }
double Screen::width_mm() const { return state_->layout.screen_width_mm; }
double Screen::height_mm() const { return state_->layout.screen_height_mm; }
double Screen::frame_ms() const { return state_->scan.frame_ms; }
double Screen::white_level() const { return 1 / state_->layout.peak; }
const std::vector<std::string>& Screen::notes() const { return state_->layout.notes; }
void Screen::reset() { state_->reset(); }

void Screen::show(const VideoPicture& picture, double time_ms, const ScreenImage& image) {
  State& state = *state_;
  state.check_time(time_ms);
  const std::vector<std::uint8_t> levels = read_levels(picture, state.mode.width, state.mode.height);
  state.emit_rows(levels.data(), time_ms);
  state.last_time_ms = time_ms;
  LineExposure exposure;
  if (is_tube(state.display)) {
    const double phase_ms = time_ms - static_cast<double>(state.frame_at(time_ms)) * state.scan.frame_ms;
    exposure = line_exposure(state.scan, state.display.crt.phosphor, std::max(phase_ms, 0.0),
                             state.display.crt.exposure_ms);
  }
  state.draw_rows(image, exposure);
}

}  // namespace tessera
