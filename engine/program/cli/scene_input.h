// The scene that a command works on: a scene file, a model, or the built-in scene.
#pragma once

#include <optional>
#include <string>

#include "engine/program/cli/progress.h"
#include "engine/program/scene/scene.h"

namespace tessera::program::cli {

/// How models are read.
struct ImportRequest {
  int memory_mib = 0;  ///< limit of the process that reads a model; 0: a quarter of the machine's memory
  int seconds = 10;    ///< limit without progress
  std::string
      format{};  ///< format of standard input: "json", or a model's file name extension without its dot
};

/// A scene, evaluated at the time of each frame.
class SceneInput {
 public:
  /// @param path       a scene or a model; empty: the built-in scene; "-": standard input
  /// @param overrides  replace values of the scene
  /// @param progress   whether to show how much of a model is read
  /// @throws UsageError  for overrides that contradict each other or the scene
  /// @throws Error       for a file that cannot be read
  /// @throws Cancelled   if the user interrupts
  SceneInput(const std::string& path, const SceneOverrides& overrides, const ImportRequest& import = {},
             ShowProgress progress = ShowProgress::automatic);

  const Scene& scene() const { return scene_; }
  /// Returns whether the scene changes over time.
  bool is_animated() const { return overrides_.turntable || (file_ && file_->is_animated()); }
  /// Returns whether the scene is a model or contains models.
  bool has_models() const { return scene_.is_model || (file_ && file_->has_models()); }
  /// Time of a frame, 0 .. 1: the last one is 1, except on a turntable, which ends where it begins.
  double frame_time(int frame, int frames) const;
  /// Evaluates the scene at `time`, 0 .. 1.
  void move_to(double time);
  /// Prints the scene's warnings on stderr.
  void print_warnings() const;

 private:
  /// @param copy  file with the bytes of standard input
  void load_standard_input(const std::string& copy, const ImportOptions& options);
  void load_model(const std::string& path, const ImportOptions& options);

  SceneOverrides overrides_;
  // Before a turntable turns; models and the built-in scene only.
  SceneCamera camera_;
  LightList lights_;
  std::optional<SceneFile> file_;
  Scene scene_;
};

}  // namespace tessera::program::cli
