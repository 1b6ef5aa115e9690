// The frames that prices are measured with: a grid over the whole window, seen in perspective.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "perf/bench/drawn_workload.h"

namespace tessera::bench {

/// How the grid is placed.
enum class Placement : std::uint8_t {
  window,      ///< covers every pixel of the window once
  outside,     ///< to the right of the view volume
  across_near  ///< one row of squares, each cut by the near plane
};
/// Content of the frame, in place of the grid.
enum class Subject : std::uint8_t {
  grid,
  nothing,
  corners,      ///< the first and the last triangle of the grid; all of its vertices are transformed
  triangles,    ///< the grid without shared vertices
  small_draws,  ///< a separate draw for each of these triangles
  points,       ///< the vertices of the grid as points of one pixel
  one_point,    ///< as many points in one place
  lines,        ///< lines of 16 pixels
  image         ///< an image over the whole window
};

/// A frame of which a price is measured: the members that pairs vary. Its defaults are an unlit grid in one
/// colour, without depth.
struct PriceFrame {
  FrameBufferFormat format{.width = 1280, .height = 960, .depth = DepthFormat::none, .stencil_bits = 0};
  double triangle_pixels = 4096;  ///< mean size
  int copies = 1;                 ///< how often the mesh lists each of its triangles
  Subject subject = Subject::grid;
  Placement placement = Placement::window;
  bool has_colors = false;
  bool has_normals = true;
  DrawState state{};
  std::vector<Light> lights{};
  LightModel light_model{};
  std::optional<TextureSampler> texture{};
  std::optional<Buffer> kept{};  ///< stored in planes, in addition to the image
  bool loads = false;            ///< starts from stored planes instead of a clear
  int accumulations = 0;         ///< an AccumOp::load, then AccumOp::accum
  int returns = 0;               ///< AccumOp::return_color

  PriceFrame();
};

/// @throws Error  if the frame cannot be recorded
Drawing price_drawing(const PriceFrame& frame);

/// Units of each PriceUnit in a frame.
using UnitCounts = std::array<double, 7>;
UnitCounts units_of(const PriceFrame& frame);

}  // namespace tessera::bench
