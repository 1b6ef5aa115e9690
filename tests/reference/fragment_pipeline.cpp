#include "fragment_pipeline.h"

#include <bit>

#include "fragment_ops.h"
#include "lighting.h"

namespace tessera::reference {

FragmentPipeline::FragmentPipeline(const FragmentState& state, Shader shader, Source source,
                                   SampleBuffers& buffers)
    : state_(state),
      shader_(std::move(shader)),
      source_(source),
      buffers_(buffers),
      planes_(buffers.colors().writable_planes(state.color_mask, state.plane_mask)) {}

void FragmentPipeline::take(const Fragment& fragment) {
  std::optional<Shade> shade;  // evaluated at most once per pixel
  const auto shaded = [&]() -> const Shade& {
    if (!shade) shade = shader_(fragment);
    return *shade;
  };
  if (state_.alpha_test && !passes(state_.alpha_test->func, shaded().color.w, state_.alpha_test->ref)) return;

  const double dither = dither_threshold(buffers_.format().dither, fragment.x, fragment.y);
  for (int s = 0; s < buffers_.format().samples; ++s) {
    if ((fragment.coverage >> s & 1) == 0) continue;
    if (!passes_stencil_and_depth(buffers_.sample(fragment.x, fragment.y, s),
                                  fragment.depth[static_cast<std::size_t>(s)]))
      continue;
    if (planes_ == 0) continue;
    std::uint32_t& word = buffers_.word(fragment.x, fragment.y, s);
    word = (word & ~planes_) | (new_word(shaded(), word, dither) & planes_);
    Vec4& unrounded = buffers_.sample(fragment.x, fragment.y, s).unrounded;
    unrounded = masked(new_unrounded(shaded(), word, unrounded), unrounded, state_.color_mask);
    buffers_.record_writer(fragment.x, fragment.y, source_.command, source_.primitive);
  }
}

bool FragmentPipeline::passes_stencil_and_depth(SampleBuffers::Sample& stored, double depth) const {
  if (!state_.stencil) return passes_depth(stored, depth);
  const int bits = buffers_.format().stencil_bits;
  const StencilFace& face = source_.is_back ? state_.stencil->back : state_.stencil->front;
  if (!passes_stencil(face, stored.stencil, bits)) {
    stored.stencil = stencil_after(face.fail, face, stored.stencil, bits);
    return false;
  }
  const bool passed = passes_depth(stored, depth);
  stored.stencil = stencil_after(passed ? face.zpass : face.zfail, face, stored.stencil, bits);
  return passed;
}

bool FragmentPipeline::passes_depth(SampleBuffers::Sample& stored, double depth) const {
  if (!state_.depth) return true;
  const DepthFormat format = buffers_.format().depth;
  const std::uint32_t level = depth_level(format, depth);
  const bool passed =
      format == DepthFormat::kFloat32
          ? passes(state_.depth->test, std::bit_cast<float>(level), std::bit_cast<float>(stored.depth_level))
          : passes(state_.depth->test, level, stored.depth_level);
  if (passed && state_.depth->write) {
    stored.depth_level = level;
    stored.depth = depth;
  }
  return passed;
}

std::uint32_t FragmentPipeline::new_word(const Shade& shade, std::uint32_t stored, double dither) const {
  const ColorFormat& colors = buffers_.colors();
  if (shade.index) return combined(state_.logic_op, colors.index_word(*shade.index), stored);
  const Vec4 color = state_.blend ? blended(*state_.blend, shade.color, colors.color(stored)) : shade.color;
  return combined(state_.logic_op, colors.word(color, dither), stored);
}

Vec4 FragmentPipeline::new_unrounded(const Shade& shade, std::uint32_t word, Vec4 stored) const {
  if (buffers_.format().color_mode == ColorMode::kIndex) return stored;
  if (state_.logic_op != LogicOp::kCopy) return buffers_.colors().color(word);
  return clamp01(state_.blend ? blended(*state_.blend, shade.color, stored) : shade.color);
}

}  // namespace tessera::reference
