// Workloads described as a Drawing: what to record, and how to check the picture. The renderer's picture must
// also match that of another instruction set bit for bit.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "perf/bench/gl_workload.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

/// A frame's commands and everything that they borrow.
struct Drawing {
  using Record = std::function<void(const Drawing&, Frame&)>;

  FrameBufferFormat format{};
  std::vector<MeshData> meshes{};
  std::vector<Texture> textures{};
  Record record{};
  /// Drawn once, before the first frame: initial content of the planes. Optional.
  Record initial_frame{};
  /// Draws that show depth or stencil as colour, recorded after `record` in checked frames only. Optional.
  Record reveal{};
  bool immediate_shading = false;  ///< turns deferred shading off: hidden fragments are shaded, too
  bool runs_in_full = false;       ///< leaves out no effect because of the data (RendererOptions::elide)
  bool stores_planes = false;      ///< keeps the picture in the planes instead of writing an image

  /// Expected FrameStats::shaded_pixels of a checked frame; 0: not checked.
  std::uint64_t fragments = 0;
  /// FrameWork::fragments of a frame that only tests depth; 0: FrameStats::shaded_pixels.
  std::uint64_t tested_fragments = 0;
  /// Returns the fault of a picture, or an empty string. Optional.
  std::function<std::string(const Picture&)> fault{};

  Roofline roofline = Roofline::none;
  /// Bytes per frame that count towards the roofline.
  /// 0: the image, and the planes if a frame loads or stores them.
  std::uint64_t roofline_bytes = 0;
  /// Tile data stored per pixel; Roofline::tile_stores only.
  std::uint64_t pixel_bytes = 0;
  /// Equivalent OpenGL workload. Empty if rivals cannot draw it.
  std::function<GlWorkload(const Drawing&)> gl_workload{};
};

/// Makes the drawing for a frame size in pixels. `seed` determines random content.
using MakeDrawing = std::function<Drawing(int width, int height, std::uint32_t seed)>;

/// Workload that draws what `make` returns.
WorkloadEntry drawn(const std::string& name, const std::string& description, MakeDrawing make);
/// Like drawn(), but excluded from the geometric mean of --rivals.
WorkloadEntry drawn_outside_mean(const std::string& name, const std::string& description, MakeDrawing make);

}  // namespace tessera::bench
