// Stages of a fragment in order: alpha test, stencil, depth, blend, dither, logic operation, masks. The
// scissor was applied during rasterization.
#pragma once

#include <functional>

#include "sample_buffers.h"
#include "shade.h"
#include "window.h"

namespace tessera::reference {

/// Processes the fragments of one primitive.
class FragmentPipeline {
 public:
  /// State that is constant over the primitive.
  struct Source {
    std::int32_t command = 0;    ///< index in Scene::frame
    std::int32_t primitive = 0;  ///< index in the mesh; 0 for bitmaps and images
    bool is_back = false;
  };

  /// Returns the colour of a fragment; called at most once per fragment.
  using Shader = std::function<Shade(const Fragment&)>;

  /// `state` and `buffers` must outlive this.
  FragmentPipeline(const FragmentState& state, Shader shader, Source source, SampleBuffers& buffers);

  void take(const Fragment& fragment);

 private:
  bool passes_stencil_and_depth(SampleBuffers::Sample& stored, double depth) const;
  bool passes_depth(SampleBuffers::Sample& stored, double depth) const;
  std::uint32_t new_word(const Shade& shade, std::uint32_t stored, double dither) const;

  /// @param word  as stored by this fragment
  Vec4 new_unrounded(const Shade& shade, std::uint32_t word, Vec4 stored) const;

  const FragmentState& state_;
  Shader shader_;
  Source source_;
  SampleBuffers& buffers_;
  std::uint32_t planes_;  // writable planes
};

}  // namespace tessera::reference
