// A workload that draws into a frame buffer and writes the picture to an image. Its pictures must match those
// of another instruction set bit for bit, and pass the check of the drawing.
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
  /// Recorded after `record` in checked frames only: shows depth or stencil as colour. Optional.
  Record reveal{};
  bool immediate_shading = false;      ///< shades hidden fragments, too (no deferred shading)
  bool stores_planes = false;          ///< keeps the picture in the planes instead of writing an image
  std::uint64_t fragments = 0;         ///< expected FrameStats::shaded_pixels of a checked frame; 0: any
  std::uint64_t tested_fragments = 0;  ///< fragments of a depth-only frame; 0: FrameStats::shaded_pixels
  Roofline roofline = Roofline::none;
  /// Bytes per frame that count towards the roofline.
  /// 0: the image, and the planes if a frame loads or stores them.
  std::uint64_t roofline_bytes = 0;
  std::uint64_t pixel_bytes = 0;  ///< tile data stored per pixel; Roofline::tile_stores only
  /// Returns the fault of a picture, or an empty string. Optional.
  std::function<std::string(const Picture&)> fault{};
  /// Empty: rivals cannot draw it.
  std::function<GlWorkload(const Drawing&)> gl_workload{};
};

/// Makes a drawing of a size in pixels, with random content from `seed`.
using MakeDrawing = std::function<Drawing(int width, int height, std::uint32_t seed)>;

/// Workload that draws what `make` returns.
WorkloadEntry drawn(const std::string& name, const std::string& description, MakeDrawing make);
/// The same, excluded from the mean of ratios.
WorkloadEntry drawn_outside_mean(const std::string& name, const std::string& description, MakeDrawing make);

}  // namespace tessera::bench
