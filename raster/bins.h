// The bins of one batch of elements: for each tile the list of those that it may show.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "raster/clip.h"

namespace tessera::detail {

// A bin entry is a triangle of the current draw, or a marker that makes another draw current; a bitmap or an
// image is a marker alone.
inline constexpr std::uint32_t kDrawMarker = 0x80000000u;
inline constexpr std::uint32_t kDerivedBit =
    0x40000000u;  ///< the id counts in the batch's own list of clipped triangles
inline constexpr std::uint32_t kMaxTriangles = kDerivedBit - 1;

/// A part of an element that has vertices of its own: what clipping left, or an edge or corner of a polygon.
struct DerivedPrimitive {
  WindowVertex vertices[3];
  std::size_t first_attribute = 0;  ///< see Bins::attributes()
  std::uint32_t source = 0;         ///< the element that it is a part of
};

struct BinCounts {
  std::uint64_t triangles_in = 0, non_finite = 0, outside = 0, culled = 0, zero_area = 0, clipped = 0,
                binned = 0, entries = 0;

  BinCounts& operator+=(const BinCounts& other) {
    for (std::uint64_t BinCounts::*const count :
         {&BinCounts::triangles_in, &BinCounts::non_finite, &BinCounts::outside, &BinCounts::culled,
          &BinCounts::zero_area, &BinCounts::clipped, &BinCounts::binned, &BinCounts::entries})
      this->*count += other.*count;
    return *this;
  }
};

/// Bytes that the bins of several batches may take together; batches that are filled at the same time share
/// it.
class BinBudget {
 public:
  explicit BinBudget(std::size_t bytes = 0) { start(bytes, 0); }
  /// Anew, when so much of it is taken, and nobody takes more at the same time.
  void start(std::size_t bytes, std::size_t taken) {
    left_ =
        static_cast<std::int64_t>(std::min(bytes, std::size_t{1} << 62)) - static_cast<std::int64_t>(taken);
    refused_ = false;
  }
  /// False, and nothing is taken, if there are not so many left.
  bool take(std::size_t bytes) {
    if (left_.fetch_sub(static_cast<std::int64_t>(bytes)) >= static_cast<std::int64_t>(bytes)) return true;
    give_back(bytes);
    refused_ = true;
    return false;
  }
  /// Takes what has to be there, left or not.
  void charge(std::size_t bytes) { left_.fetch_sub(static_cast<std::int64_t>(bytes)); }
  void give_back(std::size_t bytes) { left_.fetch_add(static_cast<std::int64_t>(bytes)); }
  /// Whether there was ever too little left, since it was started.
  bool refused() const { return refused_; }

 private:
  std::atomic<std::int64_t> left_;
  std::atomic<bool> refused_;
};

/// The boundary of what clipping leaves of a polygon.
struct ClippedBoundary {
  std::vector<ClipVertex> vertices;
  std::vector<WindowVertex> window;
  PolygonClipper clipper;
};

/// For each tile of a range a list of blocks of entries. Where they would take more than the budget has left,
/// what was stored is lost and nothing more is stored; they still count.
class Bins {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kBlockEntries = 62;
  static constexpr std::size_t kLineBytes = 64;
  struct alignas(kLineBytes) Block {
    std::uint32_t count, next;
    std::uint32_t entries[kBlockEntries];
  };
  static_assert(sizeof(Block) == (2 + kBlockEntries) * sizeof(std::uint32_t));  // full lines, no padding

  /// Empty bins of tiles first_tile, first_tile + 1, ... What `bytes()` says is already taken from the
  /// budget, which may be null: no limit. Throws std::bad_alloc.
  void reset(int tile_count, int first_tile = 0, BinBudget* budget = nullptr);
  /// Memory is kept from one reset to the next.
  std::size_t bytes() const;
  bool overflowed() const { return overflowed_; }

  void push(int tile, std::uint32_t draw, std::uint32_t id) { push(tile, draw, std::span(&id, 1)); }
  void push(int tile, std::uint32_t draw, std::span<const std::uint32_t> ids) {
    TileList& list = list_of(tile);
    if (list.draw != draw) push_draw_marker(list, draw);
    triangles_[index_of(tile)] += static_cast<std::uint32_t>(ids.size());
    counts.entries += ids.size();
    while (!ids.empty()) {
      Block& block = block_with_room(list);
      const std::size_t copied = std::min<std::size_t>(ids.size(), kBlockEntries - block.count);
      std::copy_n(ids.data(), copied, block.entries + block.count);
      block.count += static_cast<std::uint32_t>(copied);
      ids = ids.subspan(copied);
    }
  }
  /// A draw that is a bitmap or an image.
  void push_draw(int tile, std::uint32_t draw) {
    TileList& list = list_of(tile);
    push_draw_marker(list, draw);
    ++triangles_[index_of(tile)];
    ++counts.entries;
  }
  /// The first block of a tile, or kNone. @pre !overflowed()
  std::uint32_t first(int tile) const { return list_of(tile).first; }
  /// How many triangles a tile's bin holds, bitmaps and images counted as one each; 0: there are no entries.
  /// @pre !overflowed()
  std::uint32_t triangles(int tile) const { return *triangles_from(tile); }
  /// The same of that tile and those after it.
  const std::uint32_t* triangles_from(int tile) const { return triangles_.data() + index_of(tile); }
  const Block& block(std::uint32_t index) const { return blocks_[index]; }
  /// first() of a tile is asked for soon.
  void prefetch_first(int tile) const { __builtin_prefetch(&list_of(tile)); }
  /// That block is read soon, unless it is kNone.
  void prefetch_block(std::uint32_t index) const {
    if (index == kNone) return;
    const auto* const bytes = reinterpret_cast<const char*>(&blocks_[index]);
    for (std::size_t i = 0; i < sizeof(Block); i += kLineBytes) __builtin_prefetch(bytes + i);
  }

  /// A new derived primitive at the end of the list, with room for the attributes of its corners. After an
  /// overflow it is the only one. Throws std::bad_alloc.
  DerivedPrimitive& add_derived(std::uint32_t source, int corners, int attribute_count);
  void drop_last_derived();
  const DerivedPrimitive& last_derived() const { return derived_.back(); }
  std::uint32_t last_derived_id() const {
    return kDerivedBit | static_cast<std::uint32_t>(derived_.size() - 1);
  }
  const DerivedPrimitive& derived(std::uint32_t id) const { return derived_[id & ~kDerivedBit]; }
  /// Attributes of a derived primitive, corner by corner; behind the last one kAttributePadding more floats
  /// may be read.
  float* attributes(const DerivedPrimitive& derived) { return attributes_.data() + derived.first_attribute; }
  const float* attributes(const DerivedPrimitive& derived) const {
    return attributes_.data() + derived.first_attribute;
  }

  BinCounts counts;
  ClippedBoundary boundary;  ///< memory for one polygon after the other

 private:
  struct TileList {
    std::uint32_t first, last, draw;
  };
  std::size_t index_of(int tile) const { return static_cast<std::size_t>(tile - first_tile_) & tile_mask_; }
  TileList& list_of(int tile) { return tile_lists_[index_of(tile)]; }
  const TileList& list_of(int tile) const { return tile_lists_[index_of(tile)]; }
  Block& block_with_room(TileList& list) {
    if (list.last == kNone || blocks_[list.last].count == kBlockEntries) add_block(list);
    return blocks_[list.last];
  }
  void push_draw_marker(TileList& list, std::uint32_t draw) {
    Block& block = block_with_room(list);
    block.entries[block.count++] = kDrawMarker | draw;
    list.draw = draw;
  }
  void add_block(TileList& list);
  void overflow();
  template <class T>
  bool reserve(std::vector<T>& items, std::size_t count, std::size_t min_bytes = 16384);

  std::vector<DerivedPrimitive> derived_;
  std::vector<float> attributes_;  // of the derived primitives, and padding
  std::vector<TileList> tile_lists_;
  std::vector<std::uint32_t>
      triangles_;  // of each tile: beside each other, for those who look at some of many batches
  std::vector<Block> blocks_;
  std::size_t used_ = 0;
  int first_tile_ = 0;
  std::size_t tile_mask_ = 0;  // of indices of lists
  BinBudget* budget_ = nullptr;
  bool overflowed_ = false;
};

/// The batches of a frame in submission order, as its tiles read them.
class BinBatches {
 public:
  /// Batches of tiles first_tile, first_tile + 1, ..., which stay where they are. Throws std::bad_alloc.
  void set(std::span<const Bins> bins, int tile_count, int first_tile = 0);
  /// Notes what the batches hold of `count` tiles, before anything else is asked of these: often few batches
  /// hold anything, and the others need not be read. Different tiles may be indexed at the same time.
  void index_batches(int first_tile, int count);
  /// One after the other in one and the same place: `fill(b)` puts batch b there. For a single tile, whose
  /// batches together take too much. index_batches() is not called then.
  void set_streamed(const Bins& place, std::uint32_t count, std::function<void(std::uint32_t)> fill);

  std::uint32_t count() const { return count_; }
  bool is_streamed() const { return fill_ != nullptr; }
  /// How many triangles a tile's bins hold, bitmaps and images counted as one each; 0 one by one.
  std::uint64_t triangles(int tile) const { return is_streamed() ? 0 : triangles_[index_of(tile)]; }
  /// True where a tile has no entries, and that is known.
  bool known_empty(int tile) const { return !is_streamed() && triangles(tile) == 0; }
  /// The first batch from `batch` on that may hold something of a tile, or count().
  std::uint32_t next(int tile, std::uint32_t batch) const {
    if (is_streamed() || batch >= count_) return std::min(batch, count_);
    const std::uint64_t* const words = batch_mask_.data() + index_of(tile) * words_;
    std::uint32_t word = batch / 64;
    std::uint64_t left = words[word] & ~std::uint64_t{0} << batch % 64;
    while (left == 0 && ++word < words_) left = words[word];
    return left == 0 ? count_ : 64 * word + static_cast<std::uint32_t>(std::countr_zero(left));
  }
  /// Batch b. One by one: what was read of another one is gone; throws what `fill` throws.
  const Bins& read(std::uint32_t b) const {
    if (!fill_) return bins_[b];
    fill_(b);
    return *bins_;
  }
  /// Batch b, if it is there already and may be read beside the one that was read last; otherwise null, as
  /// for count().
  const Bins* peek(std::uint32_t b) const { return is_streamed() || b >= count_ ? nullptr : bins_ + b; }

 private:
  std::size_t index_of(int tile) const { return static_cast<std::size_t>(tile - first_tile_); }

  const Bins* bins_ = nullptr;
  std::uint32_t count_ = 0, words_ = 0;
  int first_tile_ = 0;
  std::vector<std::uint64_t> triangles_;  // of each tile
  std::vector<std::uint64_t>
      batch_mask_;  // words_ for each tile: a bit for each batch that holds something of it
  std::function<void(std::uint32_t)> fill_;
};

}  // namespace tessera::detail
