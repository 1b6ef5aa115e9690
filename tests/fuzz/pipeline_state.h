// States, cameras and lights from a fuzzer's bytes.
#pragma once

#include <deque>
#include <optional>

#include "engine/tessera/tessera.hpp"
#include "tests/fuzz/fuzz_input.h"

namespace tessera::fuzz {

class StateReader {
 public:
  /// @param window  bounds of every pixel that the states may touch; absent: no bounds
  StateReader(FuzzInput& from, const FrameBufferFormat& format, std::optional<Rect> window)
      : from_(from), format_(format), window_(window) {}

  Color any_color();
  /// Components are 0 .. 1.
  Color unit_color();
  Matrix matrix();
  Camera camera();
  Light light();
  LightModel light_model();
  /// Mostly within or around the buffer.
  Rect rect();
  /// A scissor, if there is a window.
  std::optional<Rect> scissor();
  DrawState draw_state(const std::deque<Texture>& textures);
  FragmentState fragment_state();
  Clear clear();
  Accum accum();

 private:
  bool is_index() const { return format_.color_mode == ColorMode::index; }
  /// Nearly always supported by the buffer.
  bool wants(bool possible) { return possible ? from_.byte() % 3 == 0 : from_.rarely(); }
  float size();
  Material material();
  StencilFace stencil_face();
  std::array<bool, 4> color_mask();
  DepthState depth_state();
  void read_operations(DrawState& state);

  FuzzInput& from_;
  const FrameBufferFormat& format_;
  std::optional<Rect> window_;
};

}  // namespace tessera::fuzz
