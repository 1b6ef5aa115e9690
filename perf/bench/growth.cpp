#include "perf/bench/growth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "perf/bench/columns.h"
#include "perf/bench/mesh_workloads.h"
#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

struct Step {
  double count;
  WorkloadEntry entry;
};

std::vector<Step> triangles() {
  std::vector<Step> steps;
  for (const int side : {71, 141, 224, 447, 707, 1414, 2236, 3162})
    steps.push_back({2.0 * side * side, grid_of(side)});
  return steps;
}
std::vector<Step> pixels() {
  std::vector<Step> steps;
  for (const auto& [width, height] :
       {std::pair{320, 200}, {640, 480}, {1280, 720}, {1920, 1080}, {3840, 2160}, {7680, 4320}})
    steps.push_back({static_cast<double>(width) * height, sphere_in_frame(width, height)});
  return steps;
}
std::vector<Step> lights() {
  std::vector<Step> steps;
  for (const int count : {1, 2, 4, 8, 16, 32})
    steps.push_back({static_cast<double>(count), sphere_with_lights(count)});
  return steps;
}
std::vector<Step> draws() {
  std::vector<Step> steps;
  for (const int count : {10, 32, 100, 316, 1000, 3162, 10000})
    steps.push_back({static_cast<double>(count), patches_in_separate_draws(count)});
  return steps;
}

Growth measured(const std::string& quantity, const std::string& description, const std::vector<Step>& steps,
                const WorkloadSetup& setup, const MeasureOptions& options, const HardwareCounters& counters) {
  Growth growth{.quantity = quantity, .description = description, .points = {}};
  for (const Step& step : steps) {
    const Candidate candidate{.name = step.entry.name,
                              .make = [&] { return step.entry.make(setup); },
                              .threads = setup.options.threads};
    const Row row = measure(std::vector{candidate}, options, counters).front();
    if (!row.fault.empty()) throw Error(row.name + ": " + row.fault);
    growth.points.push_back({step.count, row.ms.median, static_cast<double>(row.peak_bytes) / (1 << 20)});
  }
  return growth;
}

// Layout of the plot in SVG units.
constexpr double kPanelWidth = 200, kPanelHeight = 150;
constexpr double kLeft = 50, kTop = 30;
constexpr double kPitchX = 270, kPitchY = 215;
constexpr double kNote = 20;  // height of the line of text below

/// Logarithmic axis between two powers of ten.
class LogAxis {
 public:
  LogAxis(const Growth& growth, double GrowthPoint::*value) {
    double min = INFINITY;
    double max = 0;
    for (const GrowthPoint& point : growth.points) {
      min = std::min(min, point.*value);
      max = std::max(max, point.*value);
    }
    first_ = static_cast<int>(std::floor(std::log10(min)));
    last_ = std::max(static_cast<int>(std::ceil(std::log10(max))), first_ + 1);
  }
  int first() const { return first_; }
  int last() const { return last_; }
  /// 0 at the start of the axis, 1 at its end.
  double at(double value) const { return (std::log10(value) - first_) / (last_ - first_); }

 private:
  int first_;  // exponents of ten
  int last_;
};

std::string label_of(int power) {
  if (power >= 6) return formatted("%.0f M", std::pow(10, power - 6));
  if (power >= 3) return formatted("%.0f k", std::pow(10, power - 3));
  return formatted("%g", std::pow(10, power));
}

std::string panel(const Growth& growth, double GrowthPoint::*value, const std::string& title, double x0,
                  double y0) {
  const LogAxis across(growth, &GrowthPoint::count);
  const LogAxis up(growth, value);
  const auto x = [&](double count) { return x0 + kPanelWidth * across.at(count); };
  const auto y = [&](double v) { return y0 + kPanelHeight * (1 - up.at(v)); };
  std::string svg =
      formatted("<text x='%.1f' y='%.1f' font-weight='bold'>%s</text>\n", x0, y0 - 8, title.c_str());
  for (int power = across.first(); power <= across.last(); ++power)
    svg += formatted(
        "<path class='grid' d='M%.1f %.1fv%.1f'/><text x='%.1f' y='%.1f' text-anchor='middle'>%s</text>\n",
        x(std::pow(10, power)), y0, kPanelHeight, x(std::pow(10, power)), y0 + kPanelHeight + 14,
        label_of(power).c_str());
  for (int power = up.first(); power <= up.last(); ++power)
    svg += formatted(
        "<path class='grid' d='M%.1f %.1fh%.1f'/><text x='%.1f' y='%.1f' text-anchor='end'>%s</text>\n", x0,
        y(std::pow(10, power)), kPanelWidth, x0 - 5, y(std::pow(10, power)) + 4, label_of(power).c_str());
  // Proportional growth through the last point, down to an edge of the panel.
  const GrowthPoint& end = growth.points.back();
  const double start =
      std::max(std::pow(10, across.first()), end.count * std::pow(10, up.first()) / (end.*value));
  svg += formatted("<path class='linear' d='M%.1f %.1fL%.1f %.1f'/>\n", x(start),
                   y(end.*value * start / end.count), x(end.count), y(end.*value));
  std::string line;
  for (const GrowthPoint& point : growth.points) {
    line += formatted("%c%.1f %.1f", line.empty() ? 'M' : 'L', x(point.count), y(point.*value));
    svg += formatted("<circle cx='%.1f' cy='%.1f' r='2.5'/>\n", x(point.count), y(point.*value));
  }
  return svg + "<path class='line' d='" + line + "'/>\n";
}

}  // namespace

std::vector<Growth> measure_growth(const WorkloadSetup& setup, const MeasureOptions& options,
                                   const HardwareCounters& counters) {
  return {measured("triangles", "a full-screen grid, colours interpolated, depth", triangles(), setup,
                   options, counters),
          measured("pixels", "a sphere of 20k triangles, lit per pixel by one light", pixels(), setup,
                   options, counters),
          measured("lights", "a sphere of 20k triangles, lit per pixel by point lights", lights(), setup,
                   options, counters),
          measured("draws", "patches of 32 triangles, all with different states", draws(), setup, options,
                   counters)};
}

namespace {

constexpr Column kGrowthColumns[] = {
    {"median ms", "time of a frame after the warm-up, milliseconds: half of the frames took at most this"},
    {"peak MiB", "resident memory after the first frame minus that before the set-up, 2^20 bytes"},
    {"ns, us per ...", "time that each one more takes, from the line before to this one"},
};

/// Factor for twice the count, from the last two points.
double factor_of_doubling(const Growth& growth, double GrowthPoint::*value) {
  const GrowthPoint& a = growth.points[growth.points.size() - 2];
  const GrowthPoint& b = growth.points.back();
  return std::exp2(std::log(b.*value / (a.*value)) / std::log(b.count / a.count));
}

std::string singular(const Growth& growth) { return growth.quantity.substr(0, growth.quantity.size() - 1); }

/// Whether memory grows with the quantity: by more than pages that happen to be touched.
bool grows_in_memory(const Growth& growth) {
  constexpr double kMinGrowth = 1;  // MiB
  return growth.points.back().mebibytes - growth.points.front().mebibytes >= kMinGrowth;
}

/// The slopes at the large end.
std::string growth_in_words(const Growth& growth) {
  if (growth.points.size() < 2) return {};
  const GrowthPoint& first = growth.points.front();
  const GrowthPoint& last = growth.points.back();
  const std::string& quantity = growth.quantity;
  std::string text = formatted(
      "From %.0f to %.0f %s, twice the %s take %.2f times the time and %.2f times the memory (2: in "
      "proportion; "
      "less: fixed costs still count).\n",
      growth.points[growth.points.size() - 2].count, last.count, quantity.c_str(), quantity.c_str(),
      factor_of_doubling(growth, &GrowthPoint::ms), factor_of_doubling(growth, &GrowthPoint::mebibytes));
  if (!grows_in_memory(growth)) return text + "Memory does not grow with the " + quantity + ".\n";
  return text + formatted("Over the whole range, each %s adds %.1f bytes, all buffers included.\n",
                          singular(growth).c_str(),
                          (last.mebibytes - first.mebibytes) * (1 << 20) / (last.count - first.count));
}

/// Time of each one more between two points, in ns.
double ns_per_added(const GrowthPoint& from, const GrowthPoint& to) {
  return 1e6 * (to.ms - from.ms) / (to.count - from.count);
}

std::string table_of(const Growth& growth) {
  constexpr double kMaxNs = 10000;  // above, microseconds are easier to read
  bool is_in_us = false;
  for (std::size_t i = 1; i < growth.points.size(); ++i)
    is_in_us = is_in_us || ns_per_added(growth.points[i - 1], growth.points[i]) > kMaxNs;
  std::string text = formatted("\n%s: %s\n%12s %12s %12s %16s\n", growth.quantity.c_str(),
                               growth.description.c_str(), growth.quantity.c_str(), "median ms", "peak MiB",
                               ((is_in_us ? "us per " : "ns per ") + singular(growth)).c_str());
  for (std::size_t i = 0; i < growth.points.size(); ++i) {
    const GrowthPoint& point = growth.points[i];
    text += formatted("%12.0f %12.3f %12.1f", point.count, point.ms, point.mebibytes);
    if (i > 0)
      text += formatted(" %16.1f", ns_per_added(growth.points[i - 1], point) / (is_in_us ? 1000 : 1));
    text += "\n";
  }
  return text + growth_in_words(growth);
}

}  // namespace

std::string growth_table(const std::vector<Growth>& all) {
  std::string text;
  for (const Growth& growth : all) text += table_of(growth);
  return text + column_lines(kGrowthColumns);
}

std::string growth_svg(const std::vector<Growth>& all) {
  const double width = kPitchX * static_cast<double>(all.size());
  const double height = 2 * kPitchY + kNote;
  std::string svg = formatted(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' font-family='sans-serif' "
      "font-size='11'>\n",
      width, height);
  svg +=
      "<style>.grid{stroke:#ccc;fill:none}.linear{stroke:#888;stroke-dasharray:4 "
      "3;fill:none}.line{stroke:#b03020;stroke-width:1.5;fill:none}circle{fill:#"
      "b03020}</style>\n";
  svg += formatted("<rect width='%.0f' height='%.0f' fill='white'/>\n", width, height);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x0 = kLeft + kPitchX * static_cast<double>(i);
    svg += panel(all[i], &GrowthPoint::ms, "median ms, by " + all[i].quantity, x0, kTop);
    svg += panel(all[i], &GrowthPoint::mebibytes, "peak MiB, by " + all[i].quantity, x0, kTop + kPitchY);
  }
  svg += formatted(
      "<text x='%.1f' y='%.1f'>All axes are logarithmic. Dashed: growth in proportion to the last "
      "point.</text>\n",
      kLeft, height - 8);
  return svg + "</svg>\n";
}

}  // namespace tessera::bench
