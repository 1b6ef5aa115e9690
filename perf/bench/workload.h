// Workloads of `tessera bench`: they draw the same frame repeatedly and can check its picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"
#include "perf/bench/gl_workload.h"

namespace tessera::bench {
using namespace program;

struct WorkloadSetup {
  int width = 1920, height = 1080;  ///< pixels
  RendererOptions options{};
  std::uint32_t seed = 1;  ///< for random content
};

/// Upper bound on the rate at which this machine can move a frame's bytes.
enum class Roofline : std::uint8_t {
  none,
  l1_stores,      ///< repeated memset of 16 KiB per thread
  tile_stores,    ///< repeated memset of one tile's pixel data per thread; may exceed the L1 cache
  memory_stores,  ///< memset of as many bytes as the frame stores
  memory_copies,  ///< memcpy of as many bytes as the frame moves; reads and writes both count
  memory_loads    ///< memchr, without a match, over as many bytes as the frame reads
};

/// Amount of work in one frame, for rates.
struct FrameWork {
  std::uint64_t pixels = 0;     ///< pixels of the frame buffer
  std::uint64_t triangles = 0;  ///< triangles, lines or points
  std::uint64_t vertices = 0;
  std::uint64_t fragments = 0;           ///< shaded, blended or tested, as the workload defines
  std::uint64_t bytes = 0;               ///< minimum memory traffic: meshes, planes, image
  std::uint64_t frame_buffer_bytes = 0;  ///< size of the frame buffer's planes and the image
  Roofline roofline = Roofline::none;
  std::uint64_t roofline_bytes = 0;  ///< bytes per frame that count towards the roofline
  std::uint64_t tile_bytes = 0;      ///< pixel data of one tile; Roofline::tile_stores only
};

class Workload {
 public:
  virtual ~Workload() = default;
  /// Records and finishes one frame.
  virtual FrameStats draw() = 0;
  /// Draws a frame and checks it. Returns the fault in one line, or an empty string.
  virtual std::string fault() = 0;
  /// Picture of the last frame.
  virtual const Picture& picture() = 0;
  virtual FrameWork work(const FrameStats& stats) const = 0;
};

struct WorkloadEntry {
  std::string name;
  std::string description;  ///< one line, for --list
  bool is_in_mean = true;   ///< whether its ratio to a rival counts in the geometric mean
  std::string baseline{};   ///< workload to which this one's time is compared, in turns; empty: none
  std::function<std::unique_ptr<Workload>(const WorkloadSetup&)> make{};
  /// Equivalent OpenGL workload; std::nullopt if rivals cannot draw it.
  std::function<std::optional<GlWorkload>(const WorkloadSetup&)> gl_workload{};
  /// Returns what has to be installed first, or an empty string. Optional.
  std::function<std::string()> missing_requirement{};
  /// Reads input files; called before any thread starts. Returns why it failed, or an empty string. Optional.
  std::function<std::string()> prepare{};
};

/// All workloads, in table order.
const std::vector<WorkloadEntry>& workloads();
/// The workload of exactly this name, or nullptr.
const WorkloadEntry* find_workload(std::string_view name);

}  // namespace tessera::bench
