// Finds equal elements of a list: a hash table of their indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tessera::program {

/// Open addressing with linear probing; 8 bytes a slot, at most 5/8 of them used.
class IndexTable {
 public:
  /// Returns the index of an element that is equal to a new one; if there is none, adds `next` for it.
  /// @param hash  of the new element; equal elements have equal hashes
  /// @param next  index that the new element gets, 0 to 2^32 - 2
  /// @param is_same  whether the element with an index is equal to the new one
  template <class IsSame>
  std::uint32_t find_or_add(std::uint32_t hash, std::uint32_t next, const IsSame& is_same) {
    if (8 * (used_ + 1) > 5 * slots_.size()) grow();
    std::size_t at = hash & (slots_.size() - 1);
    for (; slots_[at].index != kFree; at = (at + 1) & (slots_.size() - 1))
      if (slots_[at].hash == hash && is_same(slots_[at].index)) return slots_[at].index;
    slots_[at] = {next, hash};
    ++used_;
    return next;
  }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  struct Slot {
    std::uint32_t index = kFree;
    std::uint32_t hash = 0;
  };

  void grow() {
    std::vector<Slot> larger(2 * slots_.size());
    for (const Slot& slot : slots_) {
      if (slot.index == kFree) continue;
      std::size_t at = slot.hash & (larger.size() - 1);
      while (larger[at].index != kFree) at = (at + 1) & (larger.size() - 1);
      larger[at] = slot;
    }
    slots_ = std::move(larger);
  }

  std::vector<Slot> slots_ = std::vector<Slot>(64);
  std::size_t used_ = 0;
};

/// Mixes a word into a hash [the 64-bit finalizer of MurmurHash3].
constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash ^= word;
  hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdu;
  hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53u;
  return hash ^ hash >> 33;
}

}  // namespace tessera::program
