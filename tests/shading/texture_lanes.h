// The parts of texturing on each instruction set.
#pragma once

#include "framebuffer/instruction_set.h"
#include "raster/fixed_point.h"
#include "shading/lighting.h"
#include "shading/texture.h"

namespace tessera::test {
using namespace detail;

/// Texels of the first `count` points of the batch, a multiple of 16.
using SampleTexture = void(const TextureLevels& texture, ShadingBatch& batch, int count);
SampleTexture* sample_texture(InstructionSet isa);

/// What 16 components, 0 .. 65280, come to: as numbers 0..1, and as words of 8 bits a component whose three
/// components they all are.
using TexelComponents = void(const std::uint16_t (&components)[16], float (&units)[16],
                             std::uint32_t (&words)[16]);
TexelComponents* texel_components(InstructionSet isa);

/// colors[c] becomes what they are under texels[c]; 16 of each of r g b a.
using TextureColors = void(const DrawTexture& texture, float (&colors)[4][16], const float (&texels)[4][16]);
TextureColors* texture_colors(InstructionSet isa);

/// Fills s, t and the squared texels gone by, tile_size^2 each, in rows. False where the triangle has no
/// pixel in the tile.
using TileCoordinates = bool(const WindowVertex (&vertices)[3], const float* const (&attributes)[3],
                             const DrawTexture& texture, int tile_size, float* s, float* t, float* squared);
TileCoordinates* tile_coordinates(InstructionSet isa);

/// Of `count` squared footprints, a multiple of 16, in a texture with all levels, which are blended: with 16
/// fraction bits.
using LevelsOfDetail = void(const float* footprints, std::int32_t* levels, std::size_t count);
LevelsOfDetail* levels_of_detail(InstructionSet isa);

}  // namespace tessera::test
