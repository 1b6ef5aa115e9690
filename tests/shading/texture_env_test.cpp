// Texture environments, with and without alpha, against the tables of OpenGL 1.5 in double; bit-identical to
// the twin on every instruction set.
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "tests/raster/tile_harness.h"
#include "tests/shading/texture_lanes.h"

namespace tessera::test::texture_env_test {
namespace {

struct Rgba {
  double c[3], a;
};

// GL 1.5, tables 3.22 and 3.23: f the fragment, t the texture, k the environment colour.
Rgba by_the_table(TextureEnv function, bool has_alpha, const Rgba& f, const Rgba& t,
                  const std::array<float, 3>& k) {
  Rgba v = f;
  for (std::size_t i = 0; i < 3; ++i) {
    if (function == TextureEnv::modulate) v.c[i] = f.c[i] * t.c[i];
    if (function == TextureEnv::replace) v.c[i] = t.c[i];
    if (function == TextureEnv::decal) v.c[i] = has_alpha ? f.c[i] * (1 - t.a) + t.c[i] * t.a : t.c[i];
    if (function == TextureEnv::blend) v.c[i] = f.c[i] * (1 - t.c[i]) + double{k[i]} * t.c[i];
    if (function == TextureEnv::add) v.c[i] = std::min(1.0, f.c[i] + t.c[i]);
  }
  if (!has_alpha || function == TextureEnv::decal) return v;
  v.a = function == TextureEnv::replace ? t.a : f.a * t.a;
  return v;
}

TEST(TextureEnv, MatchesTheTableAndTheScalarTwin) {
  std::mt19937 random(3);
  const auto unit = [&] { return static_cast<float>(random() % 257) / 256.0f; };
  for (const auto function :
       {TextureEnv::modulate, TextureEnv::replace, TextureEnv::decal, TextureEnv::blend, TextureEnv::add})
    for (const bool has_alpha : {false, true})
      for (int round = 0; round < 50; ++round) {
        const DrawTexture texture{
            .function = function, .has_alpha = has_alpha, .constant = {unit(), unit(), unit()}};
        float colors[4][16], texels[4][16];
        for (int c = 0; c < 4; ++c)
          for (int i = 0; i < 16; ++i) {
            colors[c][i] = unit();
            texels[c][i] = c == 3 && !has_alpha ? 1.0f : unit();
          }
        for (const InstructionSet isa : available_isas()) {
          float out[4][16];
          std::copy(&colors[0][0], &colors[0][0] + 64, &out[0][0]);
          texture_colors(isa)(texture, out, texels);
          for (int i = 0; i < 16; ++i) {
            const auto twin =
                texture_env_reference(texture, {colors[0][i], colors[1][i], colors[2][i], colors[3][i]},
                                      {texels[0][i], texels[1][i], texels[2][i], texels[3][i]});
            const Rgba table =
                by_the_table(function, has_alpha, {{colors[0][i], colors[1][i], colors[2][i]}, colors[3][i]},
                             {{texels[0][i], texels[1][i], texels[2][i]}, texels[3][i]}, texture.constant);
            for (std::size_t c = 0; c < 4; ++c) {
              ASSERT_EQ(std::bit_cast<std::uint32_t>(out[c][i]), std::bit_cast<std::uint32_t>(twin[c]))
                  << name_of(isa) << ", function " << static_cast<int>(function) << ", component " << c;
              ASSERT_NEAR(out[c][i], c == 3 ? table.a : table.c[c], 2e-7)
                  << "function " << static_cast<int>(function) << ", component " << c;
            }
          }
        }
      }
}

}  // namespace
}  // namespace tessera::test::texture_env_test
