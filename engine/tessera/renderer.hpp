// The renderer: options, statistics, and the call that runs a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <tessera/enums.hpp>

#include "executor.hpp"
#include "frame.hpp"
#include "prices.hpp"
#include "types.hpp"

namespace tessera {

/// Instruction sets of this build that this machine can run, best first; never empty.
TESSERA_API std::vector<InstructionSet> available_instruction_sets();
TESSERA_API std::string_view name(InstructionSet set);

/// Counts and times of a frame. "Triangles" include those of quads and polygons, lines, and points. Bitmaps
/// and images count in bin_entries only.
struct FrameStats {
  std::uint64_t vertices = 0;  ///< vertices of the meshes that were drawn
  std::uint64_t triangles_in = 0;
  std::uint64_t dropped_non_finite = 0;  ///< triangles with a NaN or infinite vertex
  std::uint64_t trivially_rejected = 0;  ///< outside the view volume or scissor, or between sample points
  std::uint64_t culled = 0;              ///< dropped by DrawState::cull
  std::uint64_t zero_area = 0;           ///< no area after snapping to 1/256 pixel
  std::uint64_t clipped = 0;             ///< cut by the near plane, the far plane or the guard band
  std::uint64_t binned = 0;              ///< triangles that reached a bin; clipped pieces count singly
  std::uint64_t bin_entries = 0;         ///< sum over tiles of triangles, bitmaps and images
  std::uint64_t bin_passes = 0;          ///< binning passes; more than 1 if bin_memory was too small
  std::uint64_t tiles = 0;
  std::uint64_t tiles_rendered = 0;  ///< tiles in tile memory; the others are one colour of the image
  std::uint64_t tiles_touched = 0;   ///< tiles in which a draw changed a pixel
  int tile_size = 0;                 ///< pixels
  std::uint64_t fragments = 0;       ///< pixels covered before any test; with DebugOptions::count_fragments
  std::uint64_t shaded_pixels = 0;   ///< colour evaluations
  /// Fragments for which a FragmentStage gave a colour or a depth that is not finite.
  std::uint64_t non_finite_fragments = 0;
  /// Bin entries of triangles behind everything in their tile, which were left out before their setup. Found
  /// in groups: the number depends on the tile size and on bin_memory.
  std::uint64_t hidden_triangles = 0;
  // Wall time per stage, seconds. tile_seconds includes scan-out and store.
  double plan_seconds = 0;
  double vertex_seconds = 0;
  double binning_seconds = 0;
  double tile_seconds = 0;
};

/// Cost of a draw of a frame; with DebugOptions::measure_draws.
/// - Times are sums over the threads, in seconds, of the work on the draw alone.
/// - Loads, clears, scan-out and stores of tiles and waiting belong to no draw.
/// - Measurements of a draw that is skipped as a whole are 0.
struct DrawMeasurement {
  double vertex_seconds = 0;   ///< elements, generated normals, vertices, colours of whole triangles
  double binning_seconds = 0;  ///< clipping and culling included
  double tile_seconds = 0;     ///< coverage, tests and colours
  std::uint64_t vertices = 0;
  std::uint64_t vertex_batches = 0;  ///< runs of up to 64 vertices that are processed together
  // Triangles, lines and points, as in FrameStats; more than there if the frame takes several binning passes.
  std::uint64_t triangles_in = 0;
  std::uint64_t trivially_rejected = 0;
  std::uint64_t culled = 0;
  std::uint64_t clipped = 0;
  std::uint64_t binned = 0;
  std::uint64_t tiles = 0;          ///< tiles that the draw may touch, after binning
  std::uint64_t shaded_pixels = 0;  ///< colour evaluations; their sum is FrameStats::shaded_pixels
  std::uint64_t fragments = 0;      ///< pixels covered before any test; with DebugOptions::count_fragments
};

enum class LogLevel : std::uint8_t { debug, info, warning };

/// Stages of a frame, in this order. Each waits for the one before. With little bin_memory, frames return
/// from tiles to binning.
enum class FrameStage : std::uint8_t {
  vertices,     ///< assembly of primitives, generated normals, positions and colours
  flat_colors,  ///< colours of whole triangles
  binning,      ///< batches of triangles into the bins of tiles
  tiles         ///< pixels
};
/// One task of one worker.
struct FrameTask {
  FrameStage stage = FrameStage::vertices;
  int worker = 0;    ///< 0 to RendererOptions::threads - 1
  double begin = 0;  ///< seconds since finish() was called
  double end = 0;    ///< seconds since finish() was called
  Rect pixels{};     ///< tiles: their part of the frame
  int pass = 0;      ///< tasks of one pass may run concurrently; a pass begins after the one before has ended
};

inline constexpr std::size_t kMinBinMemory = std::size_t{64} << 10;  ///< bytes

/// Switches for tests and measurements. They change no bit of any picture.
struct DebugOptions {
  bool defer_shading = true;     ///< shade once per visible pixel where that is cheaper; false: immediately
  bool count_fragments = false;  ///< fill in FrameStats::fragments; costs one more pass over the tiles
  /// Fill in Renderer::draw_measurements. Time stamps around the parts of each draw: frames take longer the
  /// more draws their tiles hold.
  bool measure_draws = false;
  std::uint32_t task_order = 0;  ///< seed of the order of tasks; 0: the scheduler's own order
};

struct RendererOptions {
  /// Worker threads, 1 to 1024. 0: all cores that the process may use, or all workers of the executor, up to
  /// 1024. Larger values are reduced to the number of workers.
  int threads = 0;
  int tile_size = 0;  ///< pixels: 32, 64 or 128; 0: chosen per frame from its size and the threads
  InstructionSet instruction_set = InstructionSet::automatic;
  /// Leave out effects that the data of a draw make unnecessary: lights that reach none of its points,
  /// blending where alpha is 1, and others (EffectReason). Changes no bit of any picture. False: for
  /// comparison, run every effect that the state requests. Frames with captures run every effect.
  bool elide = true;
  /// Memory of the bins (triangle lists of tiles), bytes, at least kMinBinMemory.
  /// Frames that need more are rendered in several parts: slower, same bits.
  std::size_t bin_memory = std::size_t{256} << 20;
  DebugOptions debug{};
  std::shared_ptr<Executor> executor{};  ///< absent: oneTBB
  /// Progress callback; `done` rises to 1 in frames that have tiles to render. Returns whether to go on.
  /// - Called at the end of each stage, and at most about 100 times per second in between.
  /// - Runs on any worker thread, one call at a time per renderer.
  /// - May record frames and finish them with other renderers; finishing with its own throws Error.
  /// - Must not modify, reset or destroy the running frame.
  /// - If it returns false, finish() throws Cancelled. If it throws, finish() rethrows (std::bad_alloc as
  ///   Error). Either way it is not called again.
  /// - After that the frame buffer is unchanged, except for tiles of kept buffers that were already stored;
  ///   images and captures may be partly written. Finishing the frame again repairs the picture if its first
  ///   commands clear whole buffers.
  std::function<bool(double done)> progress{};
  /// Receives messages; the library never prints.
  /// - Called on the thread that calls the renderer.
  /// - Exceptions propagate from that call. From finish(): the picture is complete, and the frame keeps its
  ///   commands.
  std::function<void(LogLevel level, std::string_view message)> log{};
  /// For profilers: receives the tasks of each frame at its end, ordered by begin.
  /// - Threads and exceptions as for `log`. The list is empty if it could not be allocated.
  std::function<void(std::span<const FrameTask> tasks)> trace{};
};

/// Owns worker threads and the working memory of frames. Create one and use it for many frames and frame
/// buffers. A renderer that was moved from may only be assigned to or destroyed.
/// @code
/// Renderer renderer({.threads = 4});
/// FrameBuffer buffer({.width = 640, .height = 480});
/// Frame frame(buffer);
/// std::vector<std::uint8_t> pixels(4 * 640 * 480);
/// for (int i = 0; i < 100; ++i) {
///   frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
///   frame.draw(mesh, {.transform = rotate(3.6 * i, 0, 1, 0)});
///   const FrameStats stats = renderer.finish(frame, {.pixels = pixels.data(), .width = 640, .height = 480});
///   std::printf("%.1f ms\n", 1000 * stats.tile_seconds);
/// }
/// @endcode
class TESSERA_API Renderer {
 public:
  /// @throws Error  for options out of range, an instruction set that this machine lacks, or out of memory
  explicit Renderer(RendererOptions options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Renders the frame and empties it; camera, lights and light model stay.
  /// @throws Error  if a buffer that the frame loads was not kept, or out of memory. The frame then stays
  ///                recorded: it may be finished again, or reset
  FrameStats finish(Frame& frame);
  /// Also writes the picture to the caller's memory, directly from the tiles.
  FrameStats finish(Frame& frame, const ImageTarget& target);

  /// Costs of the draws of the last frame, in the order of recording; bitmaps and images count.
  /// - Empty without DebugOptions::measure_draws, and after a frame that was cancelled or threw.
  /// - Valid until the next finish(), and until the renderer is moved or destroyed.
  std::span<const DrawMeasurement> draw_measurements() const noexcept;

  /// The work of the last frame, for predicted_seconds(). All 0 where draw_measurements() is empty, and
  /// without DebugOptions::count_fragments.
  const WorkCounts& work_counts() const noexcept;

  /// The options in effect: threads and instruction_set as chosen.
  const RendererOptions& options() const noexcept;

 private:
  friend class Frame;
  friend class FrameBuffer;
  std::unique_ptr<detail::RendererState> state_;
};

}  // namespace tessera
