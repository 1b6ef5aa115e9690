// Random scenes by seed: the same files on every machine.
#pragma once

#include <cstdint>
#include <string>

namespace tessera::test {

/// A scene file (engine/program/scenes/README.md).
/// - 1 to 8 lights of every kind; in one scene of ten 32 to 64.
/// - About 1,000 to 200,000 triangles, in 1 to 12 draws with all kinds of state.
/// - A third of the scenes each has less than 4, 4 to 64, and more than 64 pixels per triangle.
/// Numbers are multiples of 1/1000, drawn from integers, so no host's arithmetic enters.
std::string random_scene(std::uint64_t seed);

/// A small variant of random_scene(), 200 x 150 pixels with meshes of at most detail 6, whose draws carry
/// user stages that move, recolour and discard, and write depth.
std::string random_scene_with_stages(std::uint64_t seed);

}  // namespace tessera::test
