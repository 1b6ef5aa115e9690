#include "perf/bench/rivalry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

constexpr int kLevelsOff = 2;

double share_that_differs(const Picture& a, const Picture& b) {
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c) most = std::max(most, std::abs(a.rgba[c] - b.rgba[c]));
    off += most > kLevelsOff ? 1 : 0;
  }
  return static_cast<double>(off) / (static_cast<double>(a.rgba.size()) / 4);
}

}  // namespace

Duel duel(Candidate ours, Candidate rival, double tolerated, const MeasureOptions& options,
          const HardwareCounters& counters) {
  Duel result;
  std::optional<Picture> picture;
  ours.judge = [&](const Picture& drawn) {
    picture = drawn;
    return std::string();
  };
  rival.judge = [&](const Picture& drawn) {
    if (!picture) return std::string();  // ours is wrong
    if (drawn.width != picture->width || drawn.height != picture->height)
      return std::string("the rival's picture has another size");
    result.share_off = share_that_differs(*picture, drawn);
    if (result.share_off <= tolerated) return std::string();
    return formatted(
        "the rival's picture differs by more than two levels in %.3f %% of the pixels, expected %.3f %% at "
        "most",
        100 * result.share_off, 100 * tolerated);
  };
  std::vector<Row> rows = measure(std::vector{ours, rival}, options, counters);
  result.ours = std::move(rows[0]);
  result.rivals = std::move(rows[1]);
  return result;
}

std::optional<Duel> duel(const WorkloadEntry& entry, const WorkloadSetup& setup, rivals::MesaDriver driver,
                         const MeasureOptions& options, const HardwareCounters& counters) {
  const std::optional<RivalForm> form = entry.rival(setup);
  if (!form) return std::nullopt;
  const int threads = setup.options.threads;
  const Candidate ours{.name = entry.name, .make = [&] { return entry.make(setup); }, .threads = threads};
  const Candidate rival{
      .name = entry.name,
      .make = [&] { return rivals::mesa_workload(*form, setup.width, setup.height, driver, threads); },
      .threads = threads};
  Duel result = duel(ours, rival, form->tolerated, options, counters);
  result.is_in_mean = entry.is_in_mean;
  return result;
}

std::string rivalry_heading() {
  return formatted("%-22s %9s %9s %7s  %-16s %12s\n", "workload", "ours, ms", "rival, ms", "ratio",
                   "interval", "pixels off %");
}

std::string rivalry_line(const Duel& duel) {
  if (!duel.fault().empty())
    return formatted("%-22s not compared: %s\n", duel.ours.name.c_str(), duel.fault().c_str());
  const Ratio ratio = duel.ratio();
  return formatted("%-22s %9.3f %9.3f %7.2f  %6.2f .. %-6.2f %12.4f\n", duel.ours.name.c_str(),
                   duel.ours.ms.median, duel.rivals.ms.median, ratio.value, ratio.low, ratio.high,
                   100 * duel.share_off);
}

std::string rivalry_ending(const Rivalry& rivalry) {
  double sum = 0;
  int count = 0;
  const Duel* least = nullptr;
  for (const Duel& duel : rivalry.duels) {
    if (!duel.is_in_mean || !duel.fault().empty()) continue;
    sum += std::log(duel.ratio().value);
    ++count;
    if (least == nullptr || duel.ratio().value < least->ratio().value) least = &duel;
  }
  std::string text = "\nrival: " + rivalry.rival +
                     formatted(
                         "; to change one pixel takes it %.3f ms, and %.3f in a window of one pixel: the "
                         "difference is its copy of the picture\n",
                         rivalry.finish_ms, rivalry.finish_pixel_ms);
  if (count != 0)
    text += formatted("geometric mean of %d ratios: %.2f; least: %.2f (%s)\n", count, std::exp(sum / count),
                      least->ratio().value, least->ours.name.c_str());
  return text;
}

nlohmann::ordered_json rivalry_json(const Rivalry& rivalry) {
  nlohmann::ordered_json json{{"rival", rivalry.rival},
                              {"finish_ms", rivalry.finish_ms},
                              {"finish_pixel_ms", rivalry.finish_pixel_ms}};
  json["workloads"] = nlohmann::ordered_json::array();
  for (const Duel& duel : rivalry.duels) {
    nlohmann::ordered_json entry{
        {"name", duel.ours.name}, {"threads", duel.ours.threads}, {"frames", duel.ours.frames}};
    if (!duel.fault().empty()) {
      entry["fault"] = duel.fault();
    } else {
      for (const auto& [prefix, row] : {std::pair("", &duel.ours), {"rival_", &duel.rivals}}) {
        entry[std::string(prefix) + "median_ms"] = row->ms.median;
        entry[std::string(prefix) + "low_quartile_ms"] = row->ms.low_quartile;
        entry[std::string(prefix) + "high_quartile_ms"] = row->ms.high_quartile;
      }
      entry["ratio"] = duel.ratio().value;
      entry["low_ratio"] = duel.ratio().low;
      entry["high_ratio"] = duel.ratio().high;
      entry["share_off"] = duel.share_off;
    }
    json["workloads"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace tessera::bench
