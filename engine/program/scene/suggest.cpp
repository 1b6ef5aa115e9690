#include "engine/program/scene/suggest.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tessera::program {
namespace {

// Optimal string alignment distance (Levenshtein, Damerau): swapping two neighbours counts as one change.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;  // the rows for i - 2, i - 1 and i
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> candidates) {
  constexpr std::size_t kMaxNameLength = 64;  // the distance costs length^2
  if (typed.size() < 2 || typed.size() > kMaxNameLength)
    return {};  // any letter is one change away from another
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(1, typed.size() / 3) + 1;
  for (const std::string_view candidate : candidates)
    if (const std::size_t d = distance(typed, candidate); d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  return best;
}

std::string did_you_mean(std::string_view typed, std::span<const std::string_view> candidates) {
  const std::string_view name = nearest_name(typed, candidates);
  return name.empty() ? "" : "; did you mean \"" + std::string(name) + "\"?";
}

}  // namespace tessera::program
