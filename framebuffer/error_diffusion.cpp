#include "framebuffer/error_diffusion.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "framebuffer/color_dither.h"
#include "framebuffer/component_table.h"
#include "framebuffer/palette_search.h"

namespace tessera::detail {
namespace {

/// Red, green and blue, or the luminance alone, and a lane without use. Operations act on each lane.
using Values [[gnu::vector_size(16)]] = float;
using Levels4 [[gnu::vector_size(16)]] = std::int32_t;

Values lesser(Values a, Values b) { return a < b ? a : b; }
Values greater(Values a, Values b) { return a > b ? a : b; }
Values all(float value) { return Values{} + value; }

constexpr int kPad = 2;  ///< entries beyond each end of a row that receive shares

/// A packed colour and its values.
struct Rounded {
  std::uint32_t packed;
  Values values;
};

/// Rounds to the nearest levels, equally spaced. Values are in levels.
class Levels {
 public:
  explicit Levels(const ColorLayout& layout) {
    const auto set = [this](int k, int bits, int shift) {
      max_[k] = static_cast<float>((1 << bits) - 1);
      shift_[k] = shift;
    };
    if (layout.luminance) {
      set(0, layout.bits, 0);
      return;
    }
    set(0, layout.r_bits, layout.r_shift());
    set(1, layout.g_bits, layout.g_shift());
    set(2, layout.b_bits, 0);
  }
  Rounded operator()(Values wanted) const {
    // Errors are at most half a level: below 0 the conversion truncates to 0.
    const Levels4 level = __builtin_convertvector(lesser(wanted + 0.5f, max_), Levels4);
    return {static_cast<std::uint32_t>(level[0] << shift_[0] | level[1] << shift_[1] | level[2]),
            __builtin_convertvector(level, Values)};
  }
  /// Values of components 1.
  Values max() const { return max_; }

 private:
  Values max_{};
  int shift_[3] = {};
};

/// Rounds to the levels of the nearest light.
class LevelsByLight {
 public:
  LevelsByLight(const ColorLayout& layout, const LightCurve& curve) {
    if (layout.luminance) {
      components_.push_back(component(layout.bits, 0, curve));
      return;
    }
    components_.push_back(component(layout.r_bits, layout.r_shift(), curve));
    components_.push_back(component(layout.g_bits, layout.g_shift(), curve));
    components_.push_back(component(layout.b_bits, 0, curve));
  }
  Rounded operator()(Values wanted) const {
    Rounded result{};
    for (std::size_t k = 0; k < components_.size(); ++k) {
      const Component& c = components_[k];
      const float value = wanted[static_cast<int>(k)];
      const float inside = std::min(std::max(value, 0.0f), 1.0f);
      std::size_t level = c.first_level[static_cast<std::size_t>(inside * kCells)];
      while (level < c.middle.size() && value >= c.middle[level]) ++level;
      result.packed |= static_cast<std::uint32_t>(level) << c.shift;
      result.values[static_cast<int>(k)] = c.light[level];
    }
    return result;
  }

 private:
  static constexpr int kCells = 1024;
  struct Component {
    int shift;
    std::vector<float> light;                ///< light of each level
    std::vector<float> middle;               ///< between the light of a level and that of the next
    std::vector<std::uint16_t> first_level;  ///< the lowest level whose light can be nearest in a cell
  };
  static Component component(int bits, int shift, const LightCurve& curve) {
    Component c{.shift = shift, .light = {}, .middle = {}, .first_level = {}};
    const int max_level = (1 << bits) - 1;
    for (int level = 0; level <= max_level; ++level)
      c.light.push_back(static_cast<float>(curve.light(static_cast<double>(level) / max_level)));
    for (std::size_t level = 0; level + 1 < c.light.size(); ++level)
      c.middle.push_back((c.light[level] + c.light[level + 1]) / 2);
    for (int cell = 0; cell <= kCells; ++cell) {
      const auto first =
          std::upper_bound(c.middle.begin(), c.middle.end(), static_cast<float>(cell) / kCells);
      c.first_level.push_back(static_cast<std::uint16_t>(first - c.middle.begin()));
    }
    return c;
  }
  std::vector<Component> components_;
};

/// Takes the nearest palette entry.
class Entries {
 public:
  Entries(const Palette& palette, const std::optional<LightCurve>& light)
      : search_(palette, 0, level_values(light)) {
    const LevelValues value = level_values(light);
    for (const Rgb8 c : palette.entries) values_.push_back(Values{value[c.r], value[c.g], value[c.b], 0});
    if (values_.empty()) values_.push_back(Values{});
  }
  Rounded operator()(Values wanted) const {
    const std::uint32_t index = search_.nearest(wanted[0], wanted[1], wanted[2]);
    return {index, values_[index]};
  }

 private:
  PaletteSearch search_;
  std::vector<Values> values_;
};

/// Values with errors, limited for palettes.
Values limited(Values wanted, const Entries&) { return lesser(greater(wanted, Values{}), all(1)); }
template <class Quantizer>
Values limited(Values wanted, const Quantizer&) {
  return wanted;  // levels cover 0..1: errors stay within half a step
}

}  // namespace

class ErrorDiffusion::Rows {
 public:
  explicit Rows(const ErrorDiffusionOptions& options)
      : kind_(options.kind),
        stored_(options.stored),
        working_(working_layout(options.stored)),
        width_(options.width),
        value_(level_values(options.light)),
        errors_(3 * row_size()) {
    if (stored_.index) entries_.emplace(*options.palette, options.light);
    else if (options.light) by_light_.emplace(stored_, *options.light);
    else scale_ = levels_.emplace(stored_).max();
    if (stored_.luminance && options.light)
      luminance_light_.emplace(4096, [&](double c) { return options.light->light(c); });
  }

  void begin_picture() {
    std::fill(errors_.begin(), errors_.end(), Values{});
    y_ = 0;
  }
  void run(const std::uint32_t* words, std::uint32_t* stored) {
    if (entries_) run_with(words, stored, *entries_);
    else if (by_light_) run_with(words, stored, *by_light_);
    else run_with(words, stored, *levels_);
    if (stored_.alpha_bits > 0)
      for (int x = 0; x < width_; ++x) stored[x] |= words[x] >> working_.bits << stored_.bits;
  }

 private:
  std::size_t row_size() const { return static_cast<std::size_t>(width_) + 2 * kPad; }
  /// Errors for pixel 0 of the row dy below the current one.
  Values* errors(int dy) {
    return errors_.data() + static_cast<std::size_t>((y_ + dy) % 3) * row_size() + kPad;
  }

  template <class Quantizer>
  void run_with(const std::uint32_t* words, std::uint32_t* stored, const Quantizer& quantizer) {
    if (kind_ == Dither::jarvis) diffuse<kJarvis>(words, stored, quantizer);
    else diffuse<kFloydSteinberg>(words, stored, quantizer);
    end_row();
  }

  template <const auto& kShares, class Quantizer>
  void diffuse(const std::uint32_t* words, std::uint32_t* stored, const Quantizer& quantizer) {
    const int step = y_ % 2 == 0 ? 1 : -1;
    const int first = step > 0 ? 0 : width_ - 1;
    Values* const rows[3] = {errors(0), errors(1), errors(2)};
    Values next{}, second_next{};  // errors for the next two pixels of this row
    int x = first;
    for (int i = 0; i < width_; ++i, x += step) {
      if ((words[x] & working_.index_flag()) != 0) {
        stored[x] = words[x] & stored_.value_mask();
        next = second_next;
        second_next = Values{};
        continue;
      }
      Values wanted = values_of(words[x]);
      wanted += rows[0][x];
      wanted += next;
      wanted = limited(wanted, quantizer);
      const Rounded rounded = quantizer(wanted);
      stored[x] = rounded.packed;
      const Values error = wanted - rounded.values;
      next = error * kShares[0].share;
      if constexpr (kShares[1].dy == 0) {
        next += second_next;
        second_next = error * kShares[1].share;
      }
      for (const ErrorShare& to : kShares)
        if (to.dy > 0) rows[to.dy][x + step * to.dx] += error * to.share;
    }
    rows[1][x - step] += next;
    rows[1][x - step] += second_next;
  }

  Values values_of(std::uint32_t word) const {
    const float r = value_[word >> 16 & 0xff], g = value_[word >> 8 & 0xff], b = value_[word & 0xff];
    return (stored_.luminance ? Values{luminance(word), 0, 0, 0} : Values{r, g, b, 0}) * scale_;
  }
  float luminance(std::uint32_t word) const {
    const auto level = [](std::uint32_t bits) { return static_cast<float>(bits & 0xff) / 255.0f; };
    const float l = kLumaR * level(word >> 16) + kLumaG * level(word >> 8) + kLumaB * level(word);
    return luminance_light_ ? luminance_light_->at(std::min(l, 1.0f)) : l;
  }

  /// Moves shares beyond the edges to the edges, and releases the errors of the finished row.
  void end_row() {
    for (int dy = 1; dy <= 2; ++dy) {
      Values* const row = errors(dy);
      for (int x = 1; x <= kPad; ++x) {
        row[0] += std::exchange(row[-x], Values{});
        row[width_ - 1] += std::exchange(row[width_ - 1 + x], Values{});
      }
    }
    std::fill_n(errors(0) - kPad, row_size(), Values{});
    ++y_;
  }

  Dither kind_;
  ColorLayout stored_, working_;
  int width_;
  LevelValues value_;
  Values scale_ = all(1);
  std::optional<ComponentTable> luminance_light_;
  std::optional<Levels> levels_;
  std::optional<LevelsByLight> by_light_;
  std::optional<Entries> entries_;
  std::vector<Values> errors_;  ///< three rows, each with kPad entries beyond both ends
  int y_ = 0;
};

ErrorDiffusion::ErrorDiffusion(const ErrorDiffusionOptions& options)
    : rows_(std::make_unique<Rows>(options)) {}
ErrorDiffusion::~ErrorDiffusion() = default;
ErrorDiffusion::ErrorDiffusion(ErrorDiffusion&&) noexcept = default;
ErrorDiffusion& ErrorDiffusion::operator=(ErrorDiffusion&&) noexcept = default;

void ErrorDiffusion::begin_picture() { rows_->begin_picture(); }
void ErrorDiffusion::row(const std::uint32_t* words, std::uint32_t* stored) { rows_->run(words, stored); }

}  // namespace tessera::detail
