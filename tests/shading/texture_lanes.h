// The steps of texturing on each instruction set.
#pragma once

#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"
#include "shading/lighting.h"
#include "shading/texture.h"

namespace tessera::test {
using namespace detail;

/// Samples the texture at the first `count` points of the batch, a multiple of 16.
using SampleTexture = void(const TextureLevels& texture, ShadingBatch& batch, int count);
SampleTexture* sample_texture(InstructionSet isa);

/// Converts 16 texel components of 0 .. 65280 to floats 0..1, and to packed 8-bit RGB colours whose red,
/// green and blue are the component.
using TexelComponents = void(const std::uint16_t (&components)[16], float (&units)[16],
                             std::uint32_t (&packed)[16]);
TexelComponents* texel_components(InstructionSet isa);

/// Applies the texture environment to 16 colours, in place; both arrays are in the order r g b a.
using TextureColors = void(const DrawTexture& texture, float (&colors)[4][16], const float (&texels)[4][16]);
TextureColors* texture_colors(InstructionSet isa);

/// Fills s, t and the squared footprint in texels, tile_size^2 each, row by row. Returns false if the
/// triangle has no pixel in the tile.
using TileCoordinates = bool(const WindowVertex (&vertices)[3], const float* const (&attributes)[3],
                             const DrawTexture& texture, int tile_size, float* s, float* t, float* squared);
TileCoordinates* tile_coordinates(InstructionSet isa);

/// Levels of detail with 16 fraction bits for `count` squared footprints, a multiple of 16, in a texture with
/// all mipmaps and linear filtering between them.
using LevelsOfDetail = void(const float* footprints, std::int32_t* levels, std::size_t count);
LevelsOfDetail* levels_of_detail(InstructionSet isa);

}  // namespace tessera::test
