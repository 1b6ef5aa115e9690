// Frames with many odd numbers at a time: random fields of the table in odd_fields.h and random mesh values.
// The result is identical on every instruction set and tile size, with immediate and deferred shading.
#include <gtest/gtest.h>

#include "tests/numerics/odd_fields.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::odd_frames_test {
namespace {

// A number with any exponent that its type allows.
double of_any_size(Random& random, int lowest, int highest) {
  const double size =
      std::ldexp(1.0 + random.between(0, 1),
                 lowest + static_cast<int>(random.next() % static_cast<unsigned>(highest - lowest)));
  return random.next() % 2 == 0 ? size : -size;
}

void spoil_mesh(MeshData& mesh, Random& random) {
  static const std::vector<float> odd = odd_values<float>();
  for (std::vector<float>* const numbers :
       {&mesh.positions, &mesh.normals, &mesh.colors, &mesh.texcoords, &mesh.color_indices}) {
    if (random.next() % 6 == 0) numbers->clear();
    if (numbers == &mesh.positions && numbers->empty()) continue;
    for (float& number : *numbers) {
      if (random.next() % 12 != 0) continue;
      number = random.next() % 2 == 0 ? odd[random.next() % odd.size()]
                                      : static_cast<float>(of_any_size(random, -149, 127));
    }
  }
  if (mesh.positions.empty()) mesh = {};
}

TEST(OddFrames, AreTheSameOnEveryInstructionSetAndTileSize) {
  const std::vector<InterfaceCase> all = interface_cases();
  std::vector<Field> fields = all_fields();
  std::erase_if(fields, [](const Field& f) {
    return f.name.starts_with("format.") || f.name.starts_with("options.") || f.name.starts_with("target.") ||
           f.name.starts_with("texture.");
  });
  std::size_t finished = 0;
  std::size_t rounds = long_tests() ? 40000 : 600;
  constexpr std::size_t kWrongOnce = 26531;
  for (std::size_t n = 0; n <= rounds; ++n) {
    const std::size_t round = n < rounds ? n : kWrongOnce;
    Random random(1000 + round);
    InterfaceCase world = all[random.next() % all.size()];
    SCOPED_TRACE("round " + std::to_string(round) + ", " + world.name);
    world.data.primitive = static_cast<Primitive>(random.next() % 10);
    if (random.next() % 2 == 0) {
      world.state.front_mode = static_cast<PolygonMode>(random.next() % 3);
      world.state.back_mode = static_cast<PolygonMode>(random.next() % 3);
    }
    spoil_mesh(world.data, random);
    for (std::size_t k = random.next() % 12; k > 0; --k) {
      const Field& field = fields[random.next() % fields.size()];
      const std::size_t value = random.next() % field.values;
      if (field.verdict(value) != Verdict::refused) field.set(world, value);
    }
    if (random.next() % 4 == 0)
      for (double& element : world.camera.projection.m)
        element = random.next() % 2 == 0 ? of_any_size(random, -1022, 1023) : element;
    if (random.next() % 8 == 0) {
      const double scale = std::ldexp(1.0, static_cast<int>(random.next() % 2000) - 1000);
      for (double& element : world.camera.projection.m) element = std::clamp(element * scale, -1e308, 1e308);
    }
    std::optional<Outcome> first;
    for (const InstructionSet set : available_instruction_sets())
      for (const int tile_size : {32, 128}) {
        InterfaceCase copy = world;
        copy.options.tile_size = tile_size;
        copy.options.debug.defer_shading = tile_size == 32;
        const Outcome outcome = run(copy, set);
        if (!first) first = outcome;
        ASSERT_EQ(outcome.message, first->message);
        ASSERT_EQ(outcome.fingerprint, first->fingerprint)
            << "on " << name(set) << ", tiles of " << tile_size;
        ASSERT_TRUE(outcome.shown == first->shown);
        finished += outcome.refused_by.empty();
      }
  }
  EXPECT_GT(3 * finished, 4 * rounds * available_instruction_sets().size());
}

}  // namespace
}  // namespace tessera::test::odd_frames_test
