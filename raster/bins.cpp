#include "raster/bins.h"

#include <algorithm>
#include <utility>

namespace tessera::detail {

std::size_t Bins::bytes() const {
  return tile_lists_.capacity() * sizeof(TileList) + element_counts_.capacity() * sizeof(std::uint32_t) +
         blocks_.capacity() * sizeof(Block) + derived_.capacity() * sizeof(DerivedPrimitive) +
         attributes_.capacity() * sizeof(float);
}

/// Reserves room for `count` more items; false if the budget refuses. Old memory is returned to the budget
/// after the new memory is charged, as both exist during the copy.
/// @param min_bytes  smallest size of an array that grows geometrically; 0: reserve exactly
template <class T>
bool Bins::reserve(std::vector<T>& items, std::size_t count, std::size_t min_bytes) {
  const std::size_t wanted = items.size() + count;
  const std::size_t before = items.capacity();
  if (wanted <= before) return true;
  const std::size_t after = min_bytes == 0 ? wanted : std::max({wanted, 2 * before, min_bytes / sizeof(T)});
  if (budget_ != nullptr && !budget_->take(after * sizeof(T))) return false;
  items.reserve(after);
  if (budget_ != nullptr) {
    budget_->charge((items.capacity() - after) * sizeof(T));
    budget_->give_back(before * sizeof(T));
  }
  return true;
}

void Bins::reset(int tile_count, int first_tile, BinBudget* budget) {
  const auto tiles = static_cast<std::size_t>(tile_count);
  budget_ = budget;
  first_tile_ = first_tile;
  used_ = 0;
  derived_.clear();
  counts = {};
  tile_lists_.clear();
  element_counts_.clear();
  const std::size_t before = bytes();
  if (blocks_.empty()) blocks_.resize(1);  // the block that takes the entries after an overflow
  attributes_.clear();
  attributes_.assign(kAttributePadding, 0.0f);
  if (budget_ != nullptr) budget_->charge(bytes() - before);
  overflowed_ = !reserve(tile_lists_, tiles, 0) || !reserve(element_counts_, tiles, 0);
  // Without room for a list per tile, all tiles share one list, which is never read.
  tile_mask_ = overflowed_ ? 0 : ~std::size_t{0};
  const std::size_t lists = overflowed_ ? 1 : tiles;
  tile_lists_.assign(lists, TileList{kNone, kNone, kNone});
  element_counts_.assign(lists, 0);
}

void Bins::overflow() {
  overflowed_ = true;
  derived_.clear();
  attributes_.resize(kAttributePadding);
}

void Bins::add_block(TileList& list) {
  if (!overflowed_ && used_ == blocks_.size()) {
    if (reserve(blocks_, 1)) blocks_.resize(blocks_.capacity());
    else overflow();
  }
  if (overflowed_) {  // entries of all tiles go into one block, which is never read
    blocks_.front().count = 0;
    list.last = 0;
    return;
  }
  const auto index = static_cast<std::uint32_t>(used_++);
  blocks_[index].count = 0;
  blocks_[index].next = kNone;
  if (list.last == kNone) list.first = index;
  else blocks_[list.last].next = index;
  list.last = index;
}

DerivedPrimitive& Bins::add_derived(std::uint32_t source, int corners, int attribute_count) {
  const auto floats = static_cast<std::size_t>(corners * attribute_count);
  if (overflowed_ || !reserve(derived_, 1) || !reserve(attributes_, floats)) overflow();
  const std::size_t first = attributes_.size() - kAttributePadding;
  attributes_.resize(attributes_.size() + floats);
  DerivedPrimitive& derived = derived_.emplace_back();
  derived.source = source;
  derived.first_attribute = first;
  return derived;
}

void Bins::drop_last_derived() {
  attributes_.resize(derived_.back().first_attribute + kAttributePadding);
  derived_.pop_back();
}

void BinBatches::set(std::span<const Bins> bins, int tile_count, int first_tile) {
  const auto tiles = static_cast<std::size_t>(tile_count);
  const std::size_t words = (bins.size() + 63) / 64;
  element_counts_.resize(tiles);
  batch_mask_.resize(tiles * words);
  bins_ = bins.data();
  count_ = static_cast<std::uint32_t>(bins.size());
  words_ = static_cast<std::uint32_t>(words);
  first_tile_ = first_tile;
  fill_ = nullptr;
}

void BinBatches::index_batches(int first_tile, int count) {
  if (is_streamed()) return;
  const auto tiles = static_cast<std::size_t>(count);
  std::uint64_t* const sums = element_counts_.data() + index_of(first_tile);
  std::uint64_t* const batch_mask = batch_mask_.data() + index_of(first_tile) * words_;
  std::fill_n(sums, tiles, 0);
  std::fill_n(batch_mask, tiles * words_, 0);
  for (std::uint32_t b = 0; b < count_; ++b) {
    const std::uint32_t* const element_counts = bins_[b].element_counts_from(first_tile);
    for (std::size_t t = 0; t < tiles; ++t) {
      sums[t] += element_counts[t];
      batch_mask[t * words_ + b / 64] |= std::uint64_t{element_counts[t] != 0} << b % 64;
    }
  }
}

void BinBatches::set_streamed(const Bins& place, std::uint32_t count,
                              std::function<void(std::uint32_t)> fill) {
  bins_ = &place;
  count_ = count;
  fill_ = std::move(fill);
}

}  // namespace tessera::detail
