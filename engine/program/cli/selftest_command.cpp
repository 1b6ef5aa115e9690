#include "engine/program/cli/selftest_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <vector>

#include "engine/program/cli/machine_text.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/progress.h"
#include "engine/program/cli/selftest_oracles.h"
#include "engine/program/cli/selftest_scenes.h"
#include "engine/program/scene/picture_hashes.h"
#include "engine/program/scene/scene.h"
#include "engine/program/scene/text_file.h"
#include "engine/program/threads/thread_limit.h"

namespace tessera::program::cli {
namespace {

/// A scene, and where it is not what it should be.
struct SceneReport {
  std::string about;
  Scene scene;
  PictureHash expected;
  std::optional<Fingerprint> found;  ///< by the first configuration
  std::size_t failed_configurations = 0;
  std::string first_failure;
};

std::string count(std::size_t number, const char* what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

// Colours and depths: as much as a row of a terminal holds.
std::string short_text(const PictureHash& hash) { return to_text(hash).substr(0, 33); }

// One row of the tables.
std::string row(const std::string& what, const std::string& found, bool good, const char* otherwise) {
  char text[256];
  std::snprintf(text, sizeof text, "%-29s  %-45s  %s\n", what.c_str(), found.c_str(),
                good ? "ok" : otherwise);
  return text;
}

std::string wrong_text(std::size_t wrong, std::size_t all, const std::string& first) {
  return std::to_string(wrong) + " of " + count(all, "rendering") +
         " are wrong; the first: " + printable(first) + "\n";
}

std::vector<SceneReport> scenes_with(const PictureHashes& hashes, const std::string& file) {
  std::vector<SceneReport> scenes;
  for (const SelftestScene& each : kSelftestScenes) {
    const auto expected = hashes.find(each.name);
    if (expected == hashes.end())
      throw Error(file + ": there is no hash of the scene \"" + std::string(each.name) + "\"");
    scenes.push_back({.about = std::string(each.about),
                      .scene = parse_scene(each.json, std::string(each.name)),
                      .expected = expected->second,
                      .found = {},
                      .first_failure = {}});
  }
  return scenes;
}

Fingerprint rendered(const Scene& scene, Renderer& renderer) {
  FrameBuffer buffer(scene.framebuffer);
  Frame frame(buffer);
  record(scene, frame);
  renderer.finish(frame);
  return fingerprint(buffer);
}

/// What is wrong with a fingerprint; empty: nothing. The list has no hashes of planes: they have to be as
/// they were by the first configuration.
std::string difference(const Fingerprint& f, const SceneReport& scene) {
  const PictureHash hash = picture_hash(f);
  if (hash != scene.expected)
    return "colours, depths, stencil and accumulation come to " + to_text(hash) + ", expected " +
           to_text(scene.expected);
  return f == scene.found ? "" : "planes are not what they were by the first configuration";
}

void render_with(const RendererOptions& configuration, Renderer& renderer, SceneReport& scene) {
  std::string wrong;
  try {
    const Fingerprint f = rendered(scene.scene, renderer);
    if (!scene.found) scene.found = f;
    wrong = difference(f, scene);
  } catch (const Error& error) {
    wrong = error.what();
  }
  if (!wrong.empty() && scene.failed_configurations++ == 0)
    scene.first_failure = wrong + ", by " + to_text(configuration);
}

/// How many of a kind are right.
struct Tally {
  std::size_t right = 0, all = 0;
  std::string text(const char* kind) const { return std::to_string(right) + " of " + count(all, kind); }
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
  for (const SceneReport& each : scenes) {
    const bool right = each.failed_configurations == 0;
    tally.right += right ? 1 : 0;
    std::cout << row(each.scene.name, each.found ? short_text(picture_hash(*each.found)) : "", right,
                     "DIFFERS");
    if (!right)
      std::cout << "  " << each.about << ": "
                << wrong_text(each.failed_configurations, configurations.size(), each.first_failure);
  }
  return tally;
}

Tally run_oracles(const Configurations& configurations) {
  Tally tally;
  for (const auto& check : {check_coverage, check_powers, check_levels}) {
    const OracleReport report = check(configurations);
    const bool right = report.failed_configurations == 0;
    ++tally.all;
    tally.right += right ? 1 : 0;
    std::cout << row(report.oracle, report.measured, right, "WRONG");
    if (!right)
      std::cout << "  "
                << wrong_text(report.failed_configurations, configurations.size(), report.first_failure);
  }
  return tally;
}

void print_hashes(const std::vector<SceneReport>& scenes) {
  Renderer renderer;
  for (const SceneReport& each : scenes)
    std::cout << each.scene.name << " " << to_text(picture_hash(rendered(each.scene, renderer))) << "\n";
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
  std::cout << machine_text() << "each scene         " << configurations.size() << " times: by each set, "
            << (threads == 1 ? "" : "1 and ") << count(static_cast<std::size_t>(threads), "thread")
            << ", tiles of 32, 64 and 128, shaded late and at once\n\n"
            << std::flush;
  const Tally right_scenes = run_scenes(scenes, configurations);
  std::cout << "\n" << std::flush;
  const Tally right_oracles = run_oracles(few_configurations(threads));

  const bool good = right_scenes.right == right_scenes.all && right_oracles.right == right_oracles.all;
  const std::string verdict =
      right_scenes.text("scene") + " and " + right_oracles.text("oracle") + " are right";
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f s",
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  std::cout << "\nverdict            " << (good ? "all is well: " : "NOT WELL: ") << verdict << ", in "
            << seconds << "\n";
  if (good) return 0;
  std::cerr << "tessera: error: the self-test failed: " << verdict << "\n";
  return kSelftestFailed;
}

}  // namespace tessera::program::cli
