#include "engine/program/cli/selftest_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <vector>

#include "engine/program/cli/exit_codes.h"
#include "engine/program/cli/machine_text.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/selftest_checks.h"
#include "engine/program/cli/selftest_scenes.h"
#include "engine/program/scene/picture_hashes.h"
#include "engine/program/scene/scene.h"
#include "engine/program/scene/text_file.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program::cli {
namespace {

struct SceneReport {
  std::string description;
  Scene scene;
  PictureHash expected;
  std::optional<Fingerprint> found;  ///< result of the first configuration
  std::size_t failed_configurations = 0;
  std::string first_failure;
};

std::string count(std::size_t number, const char* what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

/// The hashes of colour and depth. All four do not fit a row of a terminal.
std::string short_text(const PictureHash& hash) { return to_text(hash).substr(0, 33); }

std::string table_row(const std::string& name, const std::string& found, bool passed) {
  char text[256];
  std::snprintf(text, sizeof text, "%-29s  %-45s  %s\n", name.c_str(), found.c_str(), passed ? "ok" : "FAIL");
  return text;
}

std::string failure_text(std::size_t failed, std::size_t all, const std::string& first) {
  return std::to_string(failed) + " of " + count(all, "rendering") +
         " failed; the first: " + printable(first) + "\n";
}

std::vector<SceneReport> scenes_with(const PictureHashes& hashes, const std::string& file) {
  std::vector<SceneReport> scenes;
  for (const SelftestScene& scene : kSelftestScenes) {
    const auto expected = hashes.find(scene.name);
    if (expected == hashes.end())
      throw Error(file + ": the hashes of scene \"" + std::string(scene.name) + "\" are missing");
    scenes.push_back({.description = std::string(scene.description),
                      .scene = parse_scene(scene.json, std::string(scene.name)),
                      .expected = expected->second,
                      .found = {},
                      .first_failure = {}});
  }
  return scenes;
}

Fingerprint render_fingerprint(const Scene& scene, Renderer& renderer) {
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}

/// Describes how a fingerprint differs from the expected one; empty: it does not. The expected hashes contain
/// none of planes: planes must match those of the first configuration.
std::string difference(const Fingerprint& f, const SceneReport& scene) {
  const PictureHash hash = picture_hash(f);
  if (hash != scene.expected)
    return "the hashes of colour, depth, stencil and accumulation are " + to_text(hash) + ", expected " +
           to_text(scene.expected);
  return f == scene.found ? "" : "the planes differ from those of the first configuration";
}

void render_with(const RendererOptions& configuration, Renderer& renderer, SceneReport& scene) {
  std::string failure;
  try {
    const Fingerprint f = render_fingerprint(scene.scene, renderer);
    if (!scene.found) scene.found = f;
    failure = difference(f, scene);
  } catch (const Error& error) {
    failure = error.what();
  }
  if (!failure.empty() && scene.failed_configurations++ == 0)
    scene.first_failure = failure + ", by " + to_text(configuration);
}

struct Tally {
  std::size_t passed = 0;
  std::size_t all = 0;

  bool all_passed() const { return passed == all; }
  std::string text(const char* kind) const { return std::to_string(passed) + " of " + count(all, kind); }
};

Tally run_scenes(std::vector<SceneReport>& scenes, const Configurations& configurations) {
  Progress progress(ShowProgress::automatic);
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    progress.show(static_cast<double>(i) / static_cast<double>(configurations.size()), "scenes");
    Renderer renderer(configurations[i]);
    for (SceneReport& scene : scenes) render_with(configurations[i], renderer, scene);
  }
  progress.clear();
  Tally tally{.all = scenes.size()};
  for (const SceneReport& report : scenes) {
    const bool passed = report.failed_configurations == 0;
    tally.passed += passed ? 1 : 0;
    std::cout << table_row(report.scene.name, report.found ? short_text(picture_hash(*report.found)) : "",
                           passed);
    if (!passed)
      std::cout << "  " << report.description << ": "
                << failure_text(report.failed_configurations, configurations.size(), report.first_failure);
  }
  return tally;
}

Tally run_checks(const Configurations& configurations) {
  Tally tally;
  for (const auto& check : {check_coverage, check_powers, check_levels}) {
    const CheckReport report = check(configurations);
    const bool passed = report.failed_configurations == 0;
    ++tally.all;
    tally.passed += passed ? 1 : 0;
    std::cout << table_row(report.name, report.measured, passed);
    if (!passed)
      std::cout << "  "
                << failure_text(report.failed_configurations, configurations.size(), report.first_failure);
  }
  return tally;
}

void print_hashes(const std::vector<SceneReport>& scenes) {
  Renderer renderer;
  for (const SceneReport& report : scenes)
    std::cout << report.scene.name << " " << to_text(picture_hash(render_fingerprint(report.scene, renderer)))
              << "\n";
}

PictureHashes expected_hashes(const std::string& file) {
  constexpr std::size_t kMaxListBytes = 1 << 20;
  return parse_picture_hashes(read_text_file(file, kMaxListBytes), file);
}

}  // namespace

int selftest(const SelftestRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<SceneReport> scenes =
      request.expected.empty()
          ? scenes_with(parse_picture_hashes(kSelftestHashes, "the program"), "the program")
          : scenes_with(expected_hashes(request.expected), request.expected);
  if (request.hashes) {
    print_hashes(scenes);
    return 0;
  }
  constexpr int kMaxThreads = 1024;
  const int threads = request.threads != 0 ? request.threads : std::clamp(available_cores(), 2, kMaxThreads);
  std::optional<ThreadLimit> more_threads_than_cores;
  if (threads > available_cores()) more_threads_than_cores.emplace(threads);
  const Configurations configurations = all_configurations(threads);
  std::cout << machine_text() << "configurations     " << configurations.size() << ": each instruction set, "
            << (threads == 1 ? "" : "1 and ") << count(static_cast<std::size_t>(threads), "thread")
            << ", tiles of 32, 64 and 128, deferred and immediate shading\n\n"
            << std::flush;
  const Tally scene_tally = run_scenes(scenes, configurations);
  std::cout << "\n" << std::flush;
  const Tally check_tally = run_checks(few_configurations(threads));

  const bool passed = scene_tally.all_passed() && check_tally.all_passed();
  const std::string summary = scene_tally.text("scene") + ", " + check_tally.text("exact check");
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f s",
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  std::cout << "\nresult             " << (passed ? "PASS: " : "FAIL: ") << summary << ", in " << seconds
            << "\n";
  if (passed) return 0;
  std::cerr << "tessera: error: the self-test failed: " << summary << " passed\n";
  return kDiffers;
}

}  // namespace tessera::program::cli
