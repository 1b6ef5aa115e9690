// Bins of one batch of elements: per tile, the list of elements that may touch it.
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

// A bin entry is an element of the current draw, or a marker that makes another draw current. A bitmap or an
// image is a marker without elements.
inline constexpr std::uint32_t kDrawMarker = 0x80000000u;
/// Set in ids that index the derived primitives of the batch.
inline constexpr std::uint32_t kDerivedBit = 0x40000000u;
inline constexpr std::uint32_t kMaxTriangles = kDerivedBit - 1;

/// A primitive with its own vertices: a result of clipping, or an edge or corner of a polygon.
struct DerivedPrimitive {
  WindowVertex vertices[3];
  std::size_t first_attribute = 0;  ///< see Bins::attributes()
  std::uint32_t source = 0;         ///< the element it derives from
};

/// Statistics of binning. Elements are triangles, lines or points.
struct BinCounts {
  std::uint64_t triangles_in = 0;  ///< all elements
  std::uint64_t non_finite = 0;
  std::uint64_t outside = 0;
  std::uint64_t culled = 0;
  std::uint64_t zero_area = 0;
  std::uint64_t clipped = 0;
  std::uint64_t binned = 0;
  std::uint64_t entries = 0;  ///< bin entries over all tiles, without markers of draws with elements

  BinCounts& operator+=(const BinCounts& other) {
    triangles_in += other.triangles_in;
    non_finite += other.non_finite;
    outside += other.outside;
    culled += other.culled;
    zero_area += other.zero_area;
    clipped += other.clipped;
    binned += other.binned;
    entries += other.entries;
    return *this;
  }
};

/// Memory limit shared by the bins of several batches, which may be filled concurrently.
class BinBudget {
 public:
  explicit BinBudget(std::size_t bytes = 0) { start(bytes, 0); }
  /// Resets the budget to `bytes`, of which `taken` are in use. Not concurrently with other calls.
  void start(std::size_t bytes, std::size_t taken) {
    constexpr std::size_t kMaxBudget = std::size_t{1} << 62;
    left_ = static_cast<std::int64_t>(std::min(bytes, kMaxBudget)) - static_cast<std::int64_t>(taken);
    refused_ = false;
  }
  /// Takes `bytes`; returns false and takes nothing if fewer are left.
  bool take(std::size_t bytes) {
    if (left_.fetch_sub(static_cast<std::int64_t>(bytes)) >= static_cast<std::int64_t>(bytes)) return true;
    give_back(bytes);
    refused_ = true;
    return false;
  }
  /// Takes `bytes` unconditionally.
  void charge(std::size_t bytes) { left_.fetch_sub(static_cast<std::int64_t>(bytes)); }
  void give_back(std::size_t bytes) { left_.fetch_add(static_cast<std::int64_t>(bytes)); }
  /// True if take() has failed since start().
  bool refused() const { return refused_; }

 private:
  std::atomic<std::int64_t> left_;
  std::atomic<bool> refused_;
};

/// Boundary of a clipped polygon, and the clipper's memory.
struct ClippedBoundary {
  std::vector<ClipVertex> vertices;
  std::vector<WindowVertex> window;
  PolygonClipper clipper;
};

/// Per tile of a range, a list of blocks of entries. If the budget is exceeded, the bins overflow: stored
/// entries are lost, and further entries are counted but not stored.
class Bins {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kBlockEntries = 62;
  static constexpr std::size_t kLineBytes = 64;
  struct alignas(kLineBytes) Block {
    std::uint32_t count;  ///< used entries
    std::uint32_t next;   ///< next block of the tile, or kNone
    std::uint32_t entries[kBlockEntries];
  };
  static_assert(sizeof(Block) == (2 + kBlockEntries) * sizeof(std::uint32_t));  // full lines, no padding

  /// Makes the bins of tiles first_tile .. first_tile + tile_count - 1 empty. Throws std::bad_alloc.
  /// @param budget  null: no limit. Must already account for bytes().
  void reset(int tile_count, int first_tile = 0, BinBudget* budget = nullptr);
  /// Memory in use; kept from one reset to the next.
  std::size_t bytes() const;
  bool overflowed() const { return overflowed_; }

  void push(int tile, std::uint32_t draw, std::uint32_t id) { push(tile, draw, std::span(&id, 1)); }
  void push(int tile, std::uint32_t draw, std::span<const std::uint32_t> ids) {
    TileList& list = list_of(tile);
    if (list.draw != draw) push_draw_marker(list, draw);
    element_counts_[index_of(tile)] += static_cast<std::uint32_t>(ids.size());
    counts.entries += ids.size();
    while (!ids.empty()) {
      Block& block = block_with_room(list);
      const std::size_t copied = std::min<std::size_t>(ids.size(), kBlockEntries - block.count);
      std::copy_n(ids.data(), copied, block.entries + block.count);
      block.count += static_cast<std::uint32_t>(copied);
      ids = ids.subspan(copied);
    }
  }
  /// Adds a draw that is a bitmap or an image.
  void push_draw(int tile, std::uint32_t draw) {
    TileList& list = list_of(tile);
    push_draw_marker(list, draw);
    ++element_counts_[index_of(tile)];
    ++counts.entries;
  }
  /// First block of a tile, or kNone. @pre !overflowed()
  std::uint32_t first(int tile) const { return list_of(tile).first; }
  /// Number of elements in a tile's bin; bitmaps and images count as one each. 0: the bin has no entries.
  /// @pre !overflowed()
  std::uint32_t element_count(int tile) const { return *element_counts_from(tile); }
  /// element_count() of `tile` and of the tiles after it, as an array.
  const std::uint32_t* element_counts_from(int tile) const { return element_counts_.data() + index_of(tile); }
  const Block& block(std::uint32_t index) const { return blocks_[index]; }
  /// Prefetches the memory that first() reads.
  void prefetch_first(int tile) const { __builtin_prefetch(&list_of(tile)); }
  /// Prefetches a block; kNone is allowed.
  void prefetch_block(std::uint32_t index) const {
    if (index == kNone) return;
    const auto* const bytes = reinterpret_cast<const char*>(&blocks_[index]);
    for (std::size_t i = 0; i < sizeof(Block); i += kLineBytes) __builtin_prefetch(bytes + i);
  }

  /// Appends a derived primitive with room for the attributes of its corners. After an overflow it replaces
  /// the others. Throws std::bad_alloc.
  DerivedPrimitive& add_derived(std::uint32_t source, int corners, int attribute_count);
  void drop_last_derived();
  const DerivedPrimitive& last_derived() const { return derived_.back(); }
  std::uint32_t last_derived_id() const {
    return kDerivedBit | static_cast<std::uint32_t>(derived_.size() - 1);
  }
  const DerivedPrimitive& derived(std::uint32_t id) const { return derived_[id & ~kDerivedBit]; }
  /// Attributes of a derived primitive, corner by corner. kAttributePadding floats beyond the last are
  /// readable.
  float* attributes(const DerivedPrimitive& derived) { return attributes_.data() + derived.first_attribute; }
  const float* attributes(const DerivedPrimitive& derived) const {
    return attributes_.data() + derived.first_attribute;
  }

  BinCounts counts;
  ClippedBoundary boundary;  ///< scratch memory, reused for every polygon

 private:
  struct TileList {
    std::uint32_t first;  // first block, or kNone
    std::uint32_t last;   // last block, or kNone
    std::uint32_t draw;   // current draw, or kNone
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
  std::vector<float> attributes_;  // attributes of the derived primitives, then padding
  std::vector<TileList> tile_lists_;
  // Element count per tile. A separate array, because index_batches() scans the counts of all batches.
  std::vector<std::uint32_t> element_counts_;
  std::vector<Block> blocks_;
  std::size_t used_ = 0;  // blocks
  int first_tile_ = 0;
  std::size_t tile_mask_ = 0;  // applied to list indices; 0: all tiles share list 0
  BinBudget* budget_ = nullptr;
  bool overflowed_ = false;
};

/// The batches of a frame in submission order, for reading by the tiles.
class BinBatches {
 public:
  /// Sets batches whose bins cover tiles from first_tile on. The bins must outlive this object. Throws
  /// std::bad_alloc.
  void set(std::span<const Bins> bins, int tile_count, int first_tile = 0);
  /// Builds the mask of non-empty batches for `count` tiles; call before any query of these tiles. Often only
  /// few batches hold entries of a tile. Distinct tiles may be indexed concurrently.
  void index_batches(int first_tile, int count);
  /// Streams the batches through one place: `fill(b)` stores batch b in `place`. For a single tile whose
  /// batches exceed the memory limit. index_batches() has no effect then.
  void set_streamed(const Bins& place, std::uint32_t count, std::function<void(std::uint32_t)> fill);

  std::uint32_t count() const { return count_; }
  bool is_streamed() const { return fill_ != nullptr; }
  /// Number of elements in a tile's bins; bitmaps and images count as one each. 0 if streamed.
  std::uint64_t element_count(int tile) const { return is_streamed() ? 0 : element_counts_[index_of(tile)]; }
  /// True if a tile has no entries; false if streamed.
  bool known_empty(int tile) const { return !is_streamed() && element_count(tile) == 0; }
  /// First batch from `batch` on that may have entries of a tile, or count().
  std::uint32_t next(int tile, std::uint32_t batch) const {
    if (is_streamed() || batch >= count_) return std::min(batch, count_);
    const std::uint64_t* const words = batch_mask_.data() + index_of(tile) * words_;
    std::uint32_t word = batch / 64;
    std::uint64_t left = words[word] & ~std::uint64_t{0} << batch % 64;
    while (left == 0 && ++word < words_) left = words[word];
    return left == 0 ? count_ : 64 * word + static_cast<std::uint32_t>(std::countr_zero(left));
  }
  /// Batch b. If streamed, it replaces the batch read before; throws what `fill` throws.
  const Bins& read(std::uint32_t b) const {
    if (!fill_) return bins_[b];
    fill_(b);
    return *bins_;
  }
  /// Batch b if it can be read without invalidating the batch read last; null if streamed or b >= count().
  const Bins* peek(std::uint32_t b) const { return is_streamed() || b >= count_ ? nullptr : bins_ + b; }

 private:
  std::size_t index_of(int tile) const { return static_cast<std::size_t>(tile - first_tile_); }

  const Bins* bins_ = nullptr;
  std::uint32_t count_ = 0;
  std::uint32_t words_ = 0;  // 64-bit words of batch_mask_ per tile
  int first_tile_ = 0;
  std::vector<std::uint64_t> element_counts_;  // per tile
  std::vector<std::uint64_t> batch_mask_;  // per tile, one bit per batch: the batch has entries of the tile
  std::function<void(std::uint32_t)> fill_;
};

}  // namespace tessera::detail
