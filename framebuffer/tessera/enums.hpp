// Public enumerations that the kernels share. They belong to the lowest floor, so that the public API and
// every floor use one set.
#pragma once

#include <cstdint>

namespace tessera {

/// Storage of a depth buffer: unsigned normalized integers or floats.
enum class DepthFormat : std::uint8_t { none, unorm16, unorm24, unorm32, float32 };

/// Order of the bytes of a pixel in memory.
enum class PixelOrder : std::uint8_t { rgba8, bgra8 };

/// Vector instructions that the kernels use. `automatic` selects the best set of this machine.
enum class InstructionSet : std::uint8_t { automatic, scalar, avx2, avx512 };

/// Passes if `a op b` [GL 2.1, 4.1]. Depth: fragment and stored value. Stencil: reference and stored value.
/// Alpha: fragment and reference.
enum class Compare : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };

/// Update of the stencil value after a test [GL 2.1, 4.1.5]. incr and decr saturate; incr_wrap and decr_wrap
/// wrap around.
enum class StencilOp : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };

/// Weight of the source or destination in a blend [GL 2.1, 4.1.8].
enum class BlendFactor : std::uint8_t {
  zero,
  one,
  src_color,
  one_minus_src_color,
  dst_color,
  one_minus_dst_color,
  src_alpha,
  one_minus_src_alpha,
  dst_alpha,
  one_minus_dst_alpha,
  constant_color,
  one_minus_constant_color,
  constant_alpha,
  one_minus_constant_alpha,
  src_alpha_saturate
};

/// Combination of the weighted source and destination in a blend [GL 2.1, 4.1.8].
enum class BlendEquation : std::uint8_t {
  add,               ///< source + destination
  subtract,          ///< source - destination
  reverse_subtract,  ///< destination - source
  min,               ///< min(source, destination), without the factors
  max                ///< max(source, destination), without the factors
};

/// Bitwise operation on stored bits, in OpenGL's order [GL 2.1, 4.1.10].
enum class LogicOp : std::uint8_t {
  clear,
  bit_and,
  and_reverse,
  copy,
  and_inverted,
  noop,
  bit_xor,
  bit_or,
  nor,
  equiv,
  invert,
  or_reverse,
  copy_inverted,
  or_inverted,
  nand,
  set
};

/// Addressing of texture coordinates outside 0 .. 1.
enum class TextureWrap : std::uint8_t { repeat, clamp_to_edge, mirrored_repeat };

/// Combination of a texel with a fragment's shaded and clamped colour [GL 1.5, table 3.22]. C, A: colour and
/// alpha of the fragment. Ct, At: colour and alpha of the texel; luminance counts as red, green and blue, and
/// At is 1 for textures without alpha.
enum class TextureEnv : std::uint8_t {
  modulate,  ///< C Ct, A At
  replace,   ///< Ct; At, or A for textures without alpha
  decal,     ///< C (1 - At) + Ct At, A
  blend,     ///< C (1 - Ct) + texture_env_color Ct, A At
  add        ///< min(C + Ct, 1), A At
};

/// Operation between the colour and the accumulation buffer [GL 2.1, 4.2.4].
enum class AccumOp : std::uint8_t {
  accum,        ///< acc += value * colour
  load,         ///< acc = value * colour
  add,          ///< acc += value
  mult,         ///< acc *= value
  return_color  ///< colour = value * acc, clamped to 0 .. 1, with the buffer's dither
};

/// Dither of colours that draws, clears and AccumOp::return_color store. Indices are not dithered.
/// - bayer2 to bayer8, blue_noise, pattern: ordered. Each write is rounded by its position alone.
/// - floyd_steinberg, jarvis: error diffusion. It runs once over the finished frame; until then the frame
///   buffer keeps 8 bits per component.
enum class Dither : std::uint8_t {
  none,
  bayer2,           ///< thresholds of a 2x2 pattern
  bayer4,           ///< 4x4
  bayer8,           ///< 8x8
  blue_noise,       ///< 64x64, void and cluster [Ulichney 1993]
  floyd_steinberg,  ///< error to 4 neighbours, serpentine rows [Floyd and Steinberg 1976]
  jarvis,           ///< error to 12 neighbours, serpentine rows [Jarvis, Judice and Ninke 1976]
  pattern  ///< the two palette entries whose mix in sixteenths is nearest, placed by bayer4; RGB: bayer4
};

/// Whether a dither passes the rounding error of a pixel to its neighbours.
constexpr bool is_error_diffusion(Dither dither) {
  return dither == Dither::floyd_steinberg || dither == Dither::jarvis;
}

/// Quantity that a dither preserves on average.
enum class DitherSpace : std::uint8_t {
  levels,  ///< stored values
  light    ///< the light that a display emits for them: a dithered grey is as bright as the grey
};

/// Rasterization of polygons: filled, as the lines of their boundary, or as points at their corners. Edges
/// made by clipping belong to the boundary.
enum class PolygonMode : std::uint8_t { fill, line, point };

}  // namespace tessera
