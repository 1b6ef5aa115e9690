// Fragment operations: lanes against the scalar twin bit for bit, and the twin against the reference
// renderer, over complete truth tables.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "shading/fragment_ops_reference.h"
#include "tests/reference/fragment_ops.h"
#include "tests/shading/fragment_ops_lanes.h"

namespace tessera::detail::fragment_ops_test {
namespace {

// Numbers of enumerators.
constexpr int kCompareOps = 8;
constexpr int kStencilOps = 8;
constexpr int kFactors = 15;
constexpr int kEquations = 5;
constexpr int kLogicOps = 16;

reference::StencilFace reference_face(const StencilSide& side) {
  return {.func = static_cast<reference::Compare>(side.func),
          .ref = static_cast<std::uint32_t>(side.reference),
          .mask = static_cast<std::uint32_t>(side.mask),
          .fail = static_cast<reference::StencilOp>(side.fail),
          .zfail = static_cast<reference::StencilOp>(side.zfail),
          .zpass = static_cast<reference::StencilOp>(side.zpass),
          .write_mask = static_cast<std::uint32_t>(side.write_mask)};
}

// 8 functions x 8 actions, in each outcome, over every stored value, with masks, for 1, 3 and 8 bits.
TEST(FragmentOps, StencilTruthTables) {
  std::vector<std::int32_t> stored;
  std::vector<std::int32_t> outcome;
  for (int value = 0; value < 256; ++value)
    for (const int o : {0, 1, 2, 2}) {
      stored.push_back(value);
      outcome.push_back(o);
    }
  std::vector<std::int32_t> results(stored.size());
  std::size_t checked = 0;
  for (const int bits : {1, 3, 8}) {
    const std::int32_t max_value = (1 << bits) - 1;
    for (int func = 0; func < kCompareOps; ++func)
      for (int action = 0; action < kStencilOps; ++action)
        for (const auto& [reference_value, mask, write_mask] : {std::array<std::int32_t, 3>{0, 255, 255},
                                                                {1, 255, 255},
                                                                {max_value, 255, 255},
                                                                {5, 6, 255},
                                                                {200, 255, 0x55},
                                                                {77, 0, 0}}) {
          // Each action occurs once per outcome, together with others.
          const StencilSide side{.func = static_cast<Compare>(func),
                                 .reference = std::min(reference_value, max_value),
                                 .mask = mask & max_value,
                                 .fail = static_cast<StencilOp>(action),
                                 .zfail = static_cast<StencilOp>((action + 3) % kStencilOps),
                                 .zpass = static_cast<StencilOp>((action + 5) % kStencilOps),
                                 .write_mask = write_mask & max_value};
          const reference::StencilFace face = reference_face(side);
          for (const InstructionSet isa : available_isas()) {
            test::test_stencil(isa)(side, max_value,
                                    {.count = stored.size(),
                                     .source = {},
                                     .stored = stored.data(),
                                     .outcome = outcome.data(),
                                     .threshold = 0,
                                     .results = results.data()});
            for (std::size_t i = 0; i < stored.size(); ++i) {
              if (stored[i] > max_value) continue;
              const auto before = static_cast<std::uint32_t>(stored[i]);
              const bool passes = outcome[i] > 0 && reference::passes_stencil(face, before, bits);
              reference::StencilOp op = face.fail;
              if (passes) op = outcome[i] == 2 ? face.zpass : face.zfail;
              const std::uint32_t after =
                  outcome[i] == 0 ? before : reference::stencil_after(op, face, before, bits);
              ASSERT_EQ(static_cast<std::uint32_t>(results[i]), after | (passes ? 256u : 0u))
                  << "func " << func << " action " << action << " stored " << before << " outcome "
                  << outcome[i];
              ++checked;
            }
          }
        }
  }
  EXPECT_GT(checked, 400000u);
}

TEST(FragmentOps, CompareAndLogicTables) {
  for (int op = 0; op < kCompareOps; ++op)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        EXPECT_EQ(compares(a, static_cast<Compare>(op), b),
                  reference::passes(static_cast<reference::Compare>(op), a, b));
  constexpr std::uint32_t kSource = 0x0f5a33c5u, kStored = 0x3355aa0fu;
  for (int logic = 0; logic < kLogicOps; ++logic)
    EXPECT_EQ(logic_op_reference(static_cast<LogicOp>(logic), kSource, kStored),
              reference::combined(static_cast<reference::LogicOp>(logic), kSource, kStored))
        << logic;
}

/// Random fragments, and stored packed colours. A fifth of the components are 0 or 1.
struct RandomFragments {
  std::vector<float> c[4];
  std::vector<std::int32_t> stored;
  std::vector<std::int32_t> results;

  explicit RandomFragments(std::size_t count) : stored(count), results(count) {
    std::uint32_t random = 7;
    const auto next = [&] { return random = random * 1664525u + 1013904223u; };
    for (auto& list : c)
      for (std::size_t i = 0; i < count; ++i)
        list.push_back(i % 5 == 0 ? static_cast<float>(next() >> 31)
                                  : static_cast<float>(next() >> 8) * 0x1p-24f);
    for (std::int32_t& packed : stored) packed = static_cast<std::int32_t>(next());
  }
  test::FragmentArrays arrays(float threshold) {
    return {.count = stored.size(),
            .source = {c[0].data(), c[1].data(), c[2].data(), c[3].data()},
            .stored = stored.data(),
            .outcome = nullptr,
            .threshold = threshold,
            .results = results.data()};
  }
};

std::vector<ColorLayout> layouts() {
  std::vector<ColorLayout> all;
  for (int bits = 1; bits <= 24; ++bits)
    for (const int alpha : {0, 8}) {
      ColorLayout layout = rgb_layout(bits);
      layout.alpha_bits = alpha;
      all.push_back(layout);
    }
  return all;
}

// All pairs of factors for colour and alpha, all equations, several bit depths: bit-identical to the twin,
// which is within float rounding of the reference in double.
TEST(FragmentOps, BlendFactorsAndEquations) {
  RandomFragments fragments(64);
  const std::set<int> bit_depths = {1, 8, 15, 24};
  for (const ColorLayout& layout : layouts()) {
    if (!bit_depths.contains(layout.bits)) continue;
    for (int equation = 0; equation < kEquations; ++equation)
      for (int pair = 0; pair < kFactors * kFactors; ++pair) {
        FragmentOps ops;
        ops.blend = true;
        ops.equation = static_cast<BlendEquation>(equation);
        ops.src_color = ops.dst_alpha = static_cast<BlendFactor>(pair / kFactors);
        ops.dst_color = ops.src_alpha = static_cast<BlendFactor>(pair % kFactors);
        ops.constant = {0.25f, 0.5f, 0.875f, 0.375f};
        const reference::Blend blend{.src = static_cast<reference::BlendFactor>(ops.src_color),
                                     .dst = static_cast<reference::BlendFactor>(ops.dst_color),
                                     .src_alpha = static_cast<reference::BlendFactor>(ops.src_alpha),
                                     .dst_alpha = static_cast<reference::BlendFactor>(ops.dst_alpha),
                                     .equation = static_cast<reference::BlendEquation>(equation),
                                     .color = {0.25, 0.5, 0.875, 0.375}};
        for (const InstructionSet isa : available_isas()) {
          test::store_fragments(isa)(ops, layout, fragments.arrays(0.5f));
          for (std::size_t i = 0; i < fragments.stored.size(); ++i) {
            const Rgba source{fragments.c[0][i], fragments.c[1][i], fragments.c[2][i], fragments.c[3][i]};
            const Rgba destination =
                unpack_color_reference(layout, static_cast<std::uint32_t>(fragments.stored[i]));
            const Rgba result = blend_reference(ops, source, destination);
            ASSERT_EQ(static_cast<std::uint32_t>(fragments.results[i]), pack_color(layout, result, 0.5f))
                << "pair " << pair << " equation " << equation << " bits " << layout.bits;
            const reference::Vec4 exact =
                reference::blended(blend, {source[0], source[1], source[2], source[3]},
                                   {destination[0], destination[1], destination[2], destination[3]});
            const double wanted[4] = {exact.x, exact.y, exact.z, exact.w};
            for (std::size_t c = 0; c < 4; ++c)
              ASSERT_NEAR(result[c], std::clamp(wanted[c], 0.0, 1.0), 3e-7)
                  << "component " << c << " pair " << pair << " equation " << equation;
          }
        }
      }
  }
}

TEST(FragmentOps, LevelsLogicAndThresholdsInEveryLayout) {
  RandomFragments fragments(256);
  for (const ColorLayout& layout : layouts())
    for (int logic = 0; logic < kLogicOps; ++logic) {
      FragmentOps ops;
      ops.logic = static_cast<LogicOp>(logic);
      const ColorDither in_light(Dither::bayer8, LightCurve{}, layout, {}, 8);
      for (const float threshold : {0.5f, 1 / 128.0f, 127 / 128.0f})
        for (const InstructionSet isa : available_isas()) {
          ops.dither = threshold == 0.5f ? nullptr : &in_light;
          test::store_fragments(isa)(ops, layout, fragments.arrays(threshold));
          for (std::size_t i = 0; i < fragments.stored.size(); ++i) {
            const Rgba color{fragments.c[0][i], fragments.c[1][i], fragments.c[2][i], fragments.c[3][i]};
            const std::uint32_t packed = pack_color(layout, color, threshold, ops.dither);
            const auto stored = static_cast<std::uint32_t>(fragments.stored[i]);
            ASSERT_EQ(static_cast<std::uint32_t>(fragments.results[i]),
                      logic_op_reference(ops.logic, packed, stored));
            ASSERT_EQ(packed & ~(layout.value_mask() | layout.alpha_mask()), 0u);
          }
        }
    }
}

TEST(FragmentOps, DitherPatternsMatchTheReference) {
  for (const int height : {1, 7, 8, 480})
    for (const auto& [dither, expected] : {std::pair{Dither::none, reference::Dither::kNone},
                                           {Dither::bayer2, reference::Dither::kBayer2},
                                           {Dither::bayer4, reference::Dither::kBayer4},
                                           {Dither::bayer8, reference::Dither::kBayer8},
                                           {Dither::pattern, reference::Dither::kBayer4}}) {
      const DitherPattern pattern(dither, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < 20; ++x)
          EXPECT_EQ(pattern.at(x, y),
                    static_cast<float>(reference::dither_threshold(expected, x, height - 1 - y)))
              << static_cast<int>(dither) << " at " << x << ", " << y;
    }
}

}  // namespace
}  // namespace tessera::detail::fragment_ops_test
