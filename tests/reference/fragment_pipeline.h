// The way of a fragment into the buffers: alpha test, stencil, depth, blend, dither, logic operation, masks,
// in this order. The scissor is done before, by what is rasterized.
#pragma once

#include <functional>

#include "sample_buffers.h"
#include "shade.h"
#include "window.h"

namespace tessera::reference {

/// Takes the fragments of one primitive.
class FragmentPipeline {
 public:
  /// What stays the same over the primitive.
  struct Source {
    std::int32_t command = 0;    ///< index in Scene::frame
    std::int32_t primitive = 0;  ///< index in the mesh; 0 for what is none
    bool is_back = false;
  };

  /// Says the colour of a fragment; asked at most once for each.
  using Shader = std::function<Shade(const Fragment&)>;

  /// `state` and `buffers` must outlive this.
  FragmentPipeline(const FragmentState& state, Shader shader, Source source, SampleBuffers& buffers);

  void take(const Fragment& fragment);

 private:
  bool passes_stencil_and_depth(SampleBuffers::Sample& stored, double depth) const;
  bool passes_depth(SampleBuffers::Sample& stored, double depth) const;
  std::uint32_t new_word(const Shade& shade, std::uint32_t stored, double dither) const;

  const FragmentState& state_;
  Shader shader_;
  Source source_;
  SampleBuffers& buffers_;
  std::uint32_t planes_;  // that may change
};

}  // namespace tessera::reference
