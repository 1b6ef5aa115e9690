#include "framebuffer/display/television_signal.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "framebuffer/display/television_sync.h"
#include "framebuffer/instruction_set.h"

namespace tessera::detail {
namespace {

InstructionSet resolved(InstructionSet isa) {
  return isa == InstructionSet::automatic ? available_isas().front() : isa;
}

/// The picture's samples, rounded up, and the reach of the receiver's filters on both sides.
SampleRange wire_range(int samples, int reach) {
  const int lead = rounded_up(reach, 4);  // the subcarrier repeats after four samples
  return {-lead, rounded_up(samples, kSampleGroup) + rounded_up(2 * lead, kSampleGroup)};
}

/// The last lines that were computed. Comb and delay line reach back by at most two lines, which are four
/// rows of an interlaced frame. The first four rows of a call need the lines before them, too; with eight and
/// four more entries, each line is computed once.
template <class Line>
class LineCache {
 public:
  /// @param make  computes a line into its argument
  template <class Make>
  const Line& get(const ScanLine& scan_line, const Make& make) {
    for (Entry& entry : entries_)
      if (entry.scan_line == scan_line) return entry.line;
    Entry& entry = entries_[next_];
    next_ = (next_ + 1) % entries_.size();
    entry.scan_line.reset();
    make(entry.line);
    entry.scan_line = scan_line;
    return entry.line;
  }

 private:
  struct Entry {
    std::optional<ScanLine> scan_line;
    Line line;
  };
  std::array<Entry, 12> entries_;
  std::size_t next_ = 0;
};

/// Pixels of 8 bits per component; rows from the top.
struct LevelRows {
  const std::uint8_t* rgb;
  std::ptrdiff_t stride_bytes;
  int pixel_bytes;

  PixelRow row(int y) const { return {rgb + y * stride_bytes, pixel_bytes}; }
};

}  // namespace

/// Lines of one frame, each computed once while rows are decoded from top to bottom.
class TelevisionSignal::Lines {
 public:
  Lines(const TelevisionSignal& signal, const LevelRows& picture, std::int64_t frame)
      : signal_(signal), picture_(picture), frame_(frame), encoder_scratch_(signal.encoder_.make_scratch()) {}

  const WireLine& encoded(const ScanLine& scan_line) {
    return encoded_.get(scan_line, [&](WireLine& line) {
      signal_.encoder_.encode(picture_.row(scan_line.row), degrees(scan_line), v_sign(scan_line),
                              encoder_scratch_, line);
    });
  }

  const YuvLine& decoded(const ScanLine& scan_line) {
    return decoded_.get(scan_line, [&](YuvLine& line) {
      const WireLine& wires = encoded(scan_line);
      const int distance = signal_.decoder_.comb_distance();
      const WireLine* before = nullptr;
      if (distance > 0) before = &encoded(signal_.raster_.line_before_row(scan_line.row, distance));
      signal_.decoder_.decode(signal_.range_, wires, before, degrees(scan_line), v_sign(scan_line),
                              decoder_scratch_, line);
    });
  }

  void decode_row(int row, float* out) {
    const int count = rounded_up(signal_.samples(), kSampleGroup);
    const YuvLine& line = decoded(signal_.raster_.line_of_row(row));
    const float* u = line.u.data();
    const float* v = line.v.data();
    if (signal_.decoder_.averages_lines()) {
      const YuvLine& before = decoded(signal_.raster_.line_before_row(row, 1));
      u_.resize(static_cast<std::size_t>(count));
      v_.resize(static_cast<std::size_t>(count));
      signal_.kernels_.half_sum(u, before.u.data(), u_.data(), count);
      signal_.kernels_.half_sum(v, before.v.data(), v_.data(), count);
      u = u_.data();
      v = v_.data();
    }
    rgb_.resize(3 * static_cast<std::size_t>(count));
    signal_.kernels_.to_rgb({line.y.data(), u, v},
                            {rgb_.data(), rgb_.data() + count, rgb_.data() + 2 * count}, count);
    const int samples = signal_.samples();
    for (int component = 0; component < 3; ++component)
      std::copy_n(rgb_.data() + component * count, samples, out + component * samples);
  }

 private:
  double degrees(const ScanLine& line) const {
    return signal_.raster_.subcarrier_degrees(frame_, line.number);
  }
  int v_sign(const ScanLine& line) const { return signal_.raster_.v_sign(frame_, line.number); }

  const TelevisionSignal& signal_;
  LevelRows picture_;
  std::int64_t frame_;
  TelevisionEncoder::Scratch encoder_scratch_;
  TelevisionDecoder::Scratch decoder_scratch_;
  LineCache<WireLine> encoded_;
  LineCache<YuvLine> decoded_;
  std::vector<float> u_, v_, rgb_;
};

TelevisionSignal::TelevisionSignal(DisplayKind kind, const Television& television, const VideoMode& mode,
                                   InstructionSet isa)
    : system_(television_system(kind)),
      television_(television),
      height_(mode.height),
      kernels_(television_kernels(resolved(isa))),
      raster_(system_, mode),
      decoder_(system_, television, raster_, kernels_),
      range_(wire_range(raster_.samples(), decoder_.reach())),
      encoder_(system_, television, raster_, mode, range_, kernels_) {}

void TelevisionSignal::decode_rows(const std::uint8_t* rgb, std::ptrdiff_t stride_bytes, int pixel_bytes,
                                   std::int64_t frame, int first_row, int last_row, float* out) const {
  Lines lines(*this, {rgb, stride_bytes, pixel_bytes}, frame);
  for (int row = first_row; row < last_row; ++row, out += std::ptrdiff_t{3} * samples())
    lines.decode_row(row, out);
}

VideoSignal TelevisionSignal::encode_frame(const std::uint8_t* rgb, std::ptrdiff_t stride_bytes,
                                           int pixel_bytes, std::int64_t frame) const {
  VideoSignal signal = blank_frame(system_, television_, raster_, frame);
  const SignalLevels levels = signal_levels(system_, television_);
  Lines lines(*this, {rgb, stride_bytes, pixel_bytes}, frame);
  for (int row = 0; row < height_; ++row) {
    signal.row_lines.push_back(raster_.line_of_row(row).number);
    for (int repeat = 0; repeat < raster_.lines_per_row(); ++repeat) {
      const ScanLine line = raster_.line_of_row(row, repeat);
      insert_picture(system_, levels, raster_, range_, lines.encoded(line), line.number, signal);
    }
  }
  return signal;
}

}  // namespace tessera::detail
