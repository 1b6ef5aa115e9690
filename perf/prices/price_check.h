// Compares the times that prices predict with measured times, for frames that no price was measured on.
#pragma once

#include <string>
#include <vector>

#include "engine/program/scene/scene.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::bench {

struct CheckedScene {
  std::string name;
  double measured = 0;   ///< seconds of a frame on one thread, median
  double predicted = 0;  ///< seconds
  WorkCounts work{};
};

struct NamedScene {
  std::string name;
  program::Scene scene;
};
/// Measures the frames of scenes on one thread, and predicts their times from the counts of the same frames.
/// All scenes are measured in each of several passes, so that a clock that changes affects all of them alike.
std::vector<CheckedScene> check_prices(const std::vector<NamedScene>& scenes, const PriceList& list,
                                       InstructionSet instruction_set);

std::string checked_heading();
std::string checked_line(const CheckedScene& scene);
/// The items of a scene's predicted time, the largest first.
std::string predicted_items(const CheckedScene& scene, const PriceList& list);
/// Shares of scenes that are predicted within 25 and 60 %, and of pairs in the right order among those whose
/// times differ by half or more.
std::string checked_summary(const std::vector<CheckedScene>& scenes);

}  // namespace tessera::bench
