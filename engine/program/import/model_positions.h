// Collects positions as precisely as a file gives them, and makes floats of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/program/import/index_table.h"
#include "engine/program/import/model.h"

namespace tessera::program {

struct Position {
  double x, y, z;
};

class ModelPositions {
 public:
  /// @param are_floats  the positions that will be added are floats, which take half the memory
  explicit ModelPositions(bool are_floats) : are_floats_(are_floats) {}

  std::size_t size() const { return (are_floats_ ? floats_.size() : doubles_.size()) / 3; }
  void reserve(std::size_t count);
  void add(const Position& p) {
    if (are_floats_)
      floats_.insert(floats_.end(),
                     {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    else doubles_.insert(doubles_.end(), {p.x, p.y, p.z});
  }
  Position operator[](std::size_t i) const {
    if (are_floats_) return {floats_[3 * i], floats_[3 * i + 1], floats_[3 * i + 2]};
    return {doubles_[3 * i], doubles_[3 * i + 1], doubles_[3 * i + 2]};
  }
  /// Returns an empty list that holds numbers of the same kind.
  ModelPositions without_positions() const { return ModelPositions(are_floats_); }

  /// Returns x y z of all positions and leaves this object empty.
  /// - ModelUse::mesh: rounded.
  /// - ModelUse::display: positions that are far from 0, compared with their extent, are moved by the center
  ///   of their bounds, which becomes `origin`; then rounded.
  std::vector<float> take_floats(ModelUse use, Vec3& origin);

 private:
  bool are_floats_;
  std::vector<float> floats_;
  std::vector<double> doubles_;
};

/// Whether two positions have the same bits, once -0 is 0.
inline bool is_same(const Position& a, const Position& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x + 0.0) == std::bit_cast<std::uint64_t>(y + 0.0);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

inline std::uint32_t hash_of(const Position& p, std::uint64_t seed = 0) {
  for (const double x : {p.x, p.y, p.z}) seed = mixed(seed, std::bit_cast<std::uint64_t>(x + 0.0));
  return static_cast<std::uint32_t>(seed >> 32);
}

}  // namespace tessera::program
