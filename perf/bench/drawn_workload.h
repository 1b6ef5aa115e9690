// A workload that draws into a frame buffer and scans the picture out into an image, judged by the scalar
// kernels' bits and by what its kind knows of it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "perf/bench/gl_workload.h"
#include "perf/bench/workload.h"

namespace tessera::bench {

/// A frame's commands, and all that they borrow.
struct Drawing {
  FrameBufferFormat format{};
  std::vector<MeshData> meshes{};
  std::vector<Texture> textures{};
  std::function<void(const Drawing&, Frame&)> record{};
  std::function<void(const Drawing&, Frame&)>
      before{};  ///< drawn once, into planes that the frames start from; may be empty
  std::function<void(const Drawing&, Frame&)> reveal{};  ///< drawn after it in the frame that is judged
                                                         ///< alone: shows what is in no colour. May be empty
  bool immediate_shading = false;                        ///< also what is hidden later on
  bool stores_planes =
      false;  ///< the picture stays in the frame buffer's planes; otherwise it leaves by an image
  std::uint64_t fragments = 0;  ///< what FrameStats::shaded_pixels of the judged frame has to be; 0: anything
  std::uint64_t tested_fragments =
      0;  ///< what counts as fragments where depth is all that is drawn; 0: FrameStats::shaded_pixels
  Roofline roofline = Roofline::none;
  std::uint64_t roofline_bytes =
      0;  ///< what that roofline counts; 0: the planes, where a frame reads or keeps them, and the image
  std::uint64_t pixel_bytes =
      0;  ///< of the words of a tile's pixel that are stored, where tiles are what the roofline stores
  std::function<std::string(const Picture&)> fault{};       ///< of the picture; may be empty
  std::function<GlWorkload(const Drawing&)> gl_workload{};  ///< empty: rivals do not draw it
};

/// Makes a drawing of a size in pixels and a seed.
using MakeDrawing = std::function<Drawing(int width, int height, std::uint32_t seed)>;

/// An entry of the list, by what it draws.
WorkloadEntry drawn(const std::string& name, const std::string& what, MakeDrawing make);
/// The same beside the mean of ratios.
WorkloadEntry drawn_outside_mean(const std::string& name, const std::string& what, MakeDrawing make);

}  // namespace tessera::bench
