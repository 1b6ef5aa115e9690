#include "perf/prices/price_check.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/program/imageio/picture.h"
#include "perf/bench/statistics.h"
#include "perf/bench/text.h"

namespace tessera::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A scene with the renderer and the buffers that draw it.
class SceneFrames {
 public:
  SceneFrames(const program::Scene& scene, const RendererOptions& options)
      : scene_(scene),
        buffer_(scene.framebuffer),
        frame_(buffer_),
        renderer_(options),
        picture_(scene.framebuffer.width, scene.framebuffer.height) {}

  void draw() {
    record(scene_, frame_);
    renderer_.finish(frame_, picture_.target());
  }
  const Renderer& renderer() const { return renderer_; }

 private:
  const program::Scene& scene_;
  FrameBuffer buffer_;
  Frame frame_;
  Renderer renderer_;
  program::Picture picture_;
};

constexpr int kCheckPasses = 3;

/// Times of frames, after two that warm up.
void measure_pass(SceneFrames& frames, std::vector<double>& times) {
  constexpr double kSeconds = 0.1;
  constexpr int kMinFrames = 5;
  frames.draw();
  frames.draw();
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < kMinFrames || seconds_since(start) < kSeconds; ++i) {
    const Clock::time_point begin = Clock::now();
    frames.draw();
    times.push_back(seconds_since(begin));
  }
}

WorkCounts work_of(const program::Scene& scene, RendererOptions options) {
  options.debug.measure_draws = options.debug.count_fragments = true;
  SceneFrames frames(scene, options);
  frames.draw();
  return frames.renderer().work_counts();
}

/// Share of the scenes whose prediction differs by at most `allowed` of the measured time.
double share_within(const std::vector<CheckedScene>& scenes, double allowed) {
  const auto count = std::count_if(scenes.begin(), scenes.end(), [&](const CheckedScene& scene) {
    return std::abs(scene.predicted / scene.measured - 1) <= allowed;
  });
  return static_cast<double>(count) / static_cast<double>(scenes.size());
}

struct PairOrder {
  std::size_t pairs = 0, right = 0;
};
/// Pairs of scenes of which one takes at least 1.5 times as long as the other.
PairOrder pair_order(const std::vector<CheckedScene>& scenes) {
  PairOrder order;
  for (const CheckedScene& longer : scenes)
    for (const CheckedScene& shorter : scenes) {
      if (longer.measured < 1.5 * shorter.measured) continue;
      ++order.pairs;
      order.right += longer.predicted > shorter.predicted ? 1 : 0;
    }
  return order;
}

}  // namespace

std::vector<CheckedScene> check_prices(const std::vector<NamedScene>& scenes, const PriceList& list,
                                       InstructionSet instruction_set) {
  const RendererOptions options{.threads = 1, .instruction_set = instruction_set};
  std::vector<std::vector<double>> times(scenes.size());
  for (int pass = 0; pass < kCheckPasses; ++pass)
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      SceneFrames frames(scenes[i].scene, options);
      measure_pass(frames, times[i]);
    }
  std::vector<CheckedScene> checked;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    CheckedScene& scene = checked.emplace_back();
    scene.name = scenes[i].name;
    scene.measured = statistics_of(times[i]).median;
    scene.work = work_of(scenes[i].scene, options);
    scene.predicted = predicted_seconds(scene.work, list, 1);
  }
  return checked;
}

std::string checked_heading() {
  return formatted("%-44s %12s %12s %8s\n", "scene", "measured ms", "predicted ms", "ratio");
}

std::string checked_line(const CheckedScene& scene) {
  return formatted("%-44s %12.3f %12.3f %8.2f\n", scene.name.c_str(), 1e3 * scene.measured,
                   1e3 * scene.predicted, scene.predicted / scene.measured);
}

std::string predicted_items(const CheckedScene& scene, const PriceList& list) {
  std::vector<PriceItem> items;
  for (std::size_t i = 0; i < kPriceItems; ++i)
    if (scene.work.units[i] != 0) items.push_back(static_cast<PriceItem>(i));
  const auto ms_of = [&](PriceItem item) { return 1e-6 * scene.work[item] * list[item].nanoseconds; };
  std::sort(items.begin(), items.end(),
            [&](PriceItem a, PriceItem b) { return std::abs(ms_of(a)) > std::abs(ms_of(b)); });
  std::string text = formatted("\n%-32s %12s %10s %10s   %s\n", "item", "units", "ns", "ms", "unit");
  for (const PriceItem item : items)
    text += formatted("%-32s %12.0f %10.3g %10.3f   %s\n", std::string(code(item)).c_str(), scene.work[item],
                      list[item].nanoseconds, ms_of(item), std::string(name(unit(item))).c_str());
  return text;
}

std::string checked_summary(const std::vector<CheckedScene>& scenes) {
  if (scenes.empty()) return "";
  const PairOrder order = pair_order(scenes);
  return formatted(
      "\n%zu scenes: %.0f %% predicted within 25 %%, %.0f %% within 60 %%; %.1f %% of %zu pairs whose times "
      "differ by half or more in the right order\n",
      scenes.size(), 100 * share_within(scenes, 0.25), 100 * share_within(scenes, 0.6),
      order.pairs == 0 ? 100.0 : 100.0 * static_cast<double>(order.right) / static_cast<double>(order.pairs),
      order.pairs);
}

}  // namespace tessera::bench
