// What `tessera bench` measures: frames that draw the same again and again, each of which knows what has to
// come out.
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
  std::uint32_t seed = 1;  ///< of what is random in it
};

/// What the machine does at best with a frame's bytes.
enum class Roofline : std::uint8_t {
  none,
  l1_stores,      ///< memset of 16 KiB for each thread, again and again
  tile_stores,    ///< memset of as many bytes as a tile's words for each thread, again and again: the first
                  ///< cache may be too small for them
  memory_stores,  ///< memset of as many bytes as the frame stores
  memory_copies,  ///< memcpy of them: bytes read and bytes written both count
  memory_loads    ///< memchr of them, for what is not there
};

/// What a frame was made of, for rates.
struct FrameWork {
  std::uint64_t pixels = 0;     ///< of the frame buffer
  std::uint64_t triangles = 0;  ///< or lines, or points
  std::uint64_t vertices = 0;
  std::uint64_t fragments = 0;  ///< shaded, or blended, or tested: as the workload counts them
  std::uint64_t bytes = 0;      ///< read and written in memory by its nature: meshes, planes, the image
  std::uint64_t frame_buffer_bytes = 0;  ///< of the frame buffer's planes and the image
  Roofline roofline = Roofline::none;    ///< what it is held against
  std::uint64_t roofline_bytes = 0;
  std::uint64_t tile_bytes = 0;  ///< a tile's words, where they are what the roofline stores
};

class Workload {
 public:
  virtual ~Workload() = default;
  /// Records and finishes one frame.
  virtual FrameStats draw() = 0;
  /// Draws a frame and says what is wrong with it, in one line; empty: nothing.
  virtual std::string fault() = 0;
  /// Of the last frame.
  virtual const Picture& picture() = 0;
  virtual FrameWork work(const FrameStats& stats) const = 0;
};

struct WorkloadEntry {
  std::string name;
  std::string what;        ///< one line, for the list
  bool is_in_mean = true;  ///< of ratios to rivals
  std::function<std::unique_ptr<Workload>(const WorkloadSetup&)> make{};
  std::function<std::optional<GlWorkload>(const WorkloadSetup&)>
      gl_workload{};                       ///< the same for rivals, where they can draw it
  std::function<std::string()> lacks{};    ///< what it needs and is not installed, or nothing. May be empty
  std::function<std::string()> prepare{};  ///< reads what it needs, before any thread runs; says why it
                                           ///< cannot, or nothing. May be empty
};

/// All of them, in the order of the tables.
const std::vector<WorkloadEntry>& workloads();

}  // namespace tessera::bench
