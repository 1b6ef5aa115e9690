// Cost of storing tiles to planes, without drawing them: calls the kernels as the renderer does.
#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/runtime/worker_pool.h"
#include "framebuffer/bit_transpose.h"
#include "framebuffer/bitplane.h"
#include "framebuffer/tile_grid.h"
#include "perf/bench/mesh_workloads.h"

namespace tessera::bench {
using namespace detail;
namespace {

InstructionSet resolved(InstructionSet set) {
  return set == InstructionSet::automatic ? available_isas().front() : set;
}

struct alignas(kTileAlignment) Tile {
  std::uint32_t words[kMaxTileSize * kMaxTileSize];
};

/// Every worker has as many tiles as the renderer stores at once, filled with random pixels, and stores them
/// at all tile positions of the window.
class TileStoreWorkload : public Workload {
 public:
  TileStoreWorkload(const WorkloadSetup& setup, int bits)
      : grid_{setup.width, setup.height,
              setup.options.tile_size != 0 ? setup.options.tile_size : kMaxTileSize},
        worker_pool_(setup.options.threads, setup.options.executor),
        store_(store_planes_for(resolved(setup.options.instruction_set))),
        planes_(setup.width, setup.height, bits),
        tiles_per_store_(tiles_per_store(resolved(setup.options.instruction_set), grid_.tile_size)),
        tiles_(static_cast<std::size_t>(setup.options.threads * tiles_per_store_)),
        picture_(setup.width, setup.height) {
    std::mt19937 random(setup.seed);
    for (int t = 0; t < tiles_per_store_; ++t)
      for (std::uint32_t& word : tiles_[static_cast<std::size_t>(t)].words)
        word = static_cast<std::uint32_t>(random());
    for (std::size_t t = static_cast<std::size_t>(tiles_per_store_); t < tiles_.size(); ++t)
      tiles_[t] = tiles_[t - static_cast<std::size_t>(tiles_per_store_)];
    for (const Tile& tile : tiles_) tile_pixels_.push_back(tile.words);
    planes_.allocate(0);
  }

  FrameStats draw() override {
    const int tiles_per_line = kLinePixels / grid_.tile_size;
    const int strips = (grid_.columns() + tiles_per_line - 1) / tiles_per_line;
    worker_pool_.for_each(static_cast<std::size_t>(strips * grid_.rows()), [&](std::size_t task, int worker) {
      const int row = static_cast<int>(task) / strips;
      const int first = static_cast<int>(task) % strips * tiles_per_line;
      const int last = std::min(first + tiles_per_line, grid_.columns());
      const std::uint32_t* const* const tiles = tile_pixels_.data() + worker * tiles_per_store_;
      for (int column = first; column < last; column += tiles_per_store_)
        store_(
            {tiles, static_cast<std::size_t>(std::min(tiles_per_store_, last - column))},
            {.x0_px = column * grid_.tile_size, .y0_px = row * grid_.tile_size, .tile_size = grid_.tile_size},
            planes_, ~std::uint32_t{0});
    });
    return {};
  }

  std::string fault() override {
    draw();
    for (int y = 0; y < grid_.height_px; ++y)
      for (int x = 0; x < grid_.width_px; ++x)
        if (planes_.pixel(x, y) != expected(x, y))
          return "pixel " + std::to_string(x) + " of row " + std::to_string(y) + " differs from its tile";
    return {};
  }

  const Picture& picture() override {
    const int shift_to_24_bits = 24 - planes_.plane_count();
    for (int y = 0; y < grid_.height_px; ++y)
      for (int x = 0; x < grid_.width_px; ++x) {
        const std::uint32_t word = planes_.pixel(x, y) << shift_to_24_bits;
        std::uint8_t* const pixel = picture_.rgba.data() + 4 * (static_cast<std::size_t>(y) *
                                                                    static_cast<std::size_t>(grid_.width_px) +
                                                                static_cast<std::size_t>(x));
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(word >> (16 - 8 * c));
        pixel[3] = 255;
      }
    return picture_;
  }

  FrameWork work(const FrameStats&) const override {
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(grid_.width_px) * static_cast<std::uint64_t>(grid_.height_px);
    const std::uint64_t bytes = planes_.needed_bytes();
    // The roofline is a copy: reads the words of the tiles and writes the planes.
    return {.pixels = pixels,
            .bytes = bytes,
            .frame_buffer_bytes = bytes,
            .roofline = Roofline::memory_copies,
            .roofline_bytes = bytes + pixels * sizeof(std::uint32_t)};
  }

 private:
  std::uint32_t expected(int x, int y) const {
    return tiles_[static_cast<std::size_t>(x / grid_.tile_size % tiles_per_store_)]
               .words[tile_index(x % grid_.tile_size, y % grid_.tile_size, grid_.tile_size)] &
           planes_.value_mask();
  }

  TileGrid grid_;
  WorkerPool worker_pool_;
  StorePlanesFn* store_;
  BitplaneStack planes_;
  int tiles_per_store_;
  std::vector<Tile> tiles_;
  std::vector<const std::uint32_t*> tile_pixels_;  // per tile
  Picture picture_;
};

}  // namespace

std::vector<WorkloadEntry> plane_store_workloads() {
  std::vector<WorkloadEntry> list;
  for (const int bits : {1, 4, 8, 16, 24}) {
    WorkloadEntry entry{
        .name = "store-" + std::to_string(bits),
        .description = "existing tiles stored to " + std::to_string(bits) + (bits > 1 ? " planes" : " plane"),
        .is_in_mean = false};
    entry.make = [bits](const WorkloadSetup& setup) {
      return std::make_unique<TileStoreWorkload>(setup, bits);
    };
    entry.gl_workload = [](const WorkloadSetup&) { return std::nullopt; };
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace tessera::bench
