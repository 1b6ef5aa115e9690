// Every number of every struct of the interface takes every odd value. Either the call rejects it and names
// the value, or the picture is identical on every instruction set and nothing outside the permitted area
// changes.
#include <gtest/gtest.h>

#include "tests/numerics/odd_fields.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::odd_state_test {
namespace {

// Expects pixels that neither draw nor image nor accumulation may write to hold the clear value, or outside
// the clear's scissor the initial value.
void expect_nothing_outside(const InterfaceCase& w, const Outcome& outcome) {
  if (w.accum && w.accum->op == AccumOp::return_color) return;
  const int width = w.format.width, height = w.format.height;
  std::optional<std::uint32_t> cleared;
  std::optional<std::uint32_t> uncleared;
  std::optional<std::uint32_t> far_cleared;
  std::optional<std::uint32_t> far_uncleared;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (contains(w.state.viewport, x, y) && contains(w.state.scissor, x, y)) continue;
      if (contains(w.fragments.scissor, x, y)) continue;
      const std::size_t i = static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x);
      const bool in_clear = contains(w.clear.scissor, x, y);
      std::optional<std::uint32_t>& word = in_clear ? cleared : uncleared;
      std::optional<std::uint32_t>& depth = in_clear ? far_cleared : far_uncleared;
      if (w.format.dither == Dither::none) {
        if (!word) word = outcome.color[i];
        ASSERT_EQ(outcome.color[i], *word) << "pixel " << x << ", " << y;
      }
      if (outcome.depth.empty()) continue;
      if (!depth) depth = outcome.depth[i];
      ASSERT_EQ(outcome.depth[i], *depth) << "depth at " << x << ", " << y;
    }
}

void expect_named(const Field& field, std::size_t value, const std::string& message) {
  const std::vector<std::string> texts = field.found(value);
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                          [&](const std::string& text) { return message.find(text) != std::string::npos; }))
      << "the message \"" << message << "\" does not name \"" << texts.front() << "\"";
}

void expect_refusal_or_picture(const Field& field, std::size_t value, const InterfaceCase& world) {
  std::optional<Outcome> first;
  for (const InstructionSet set : available_instruction_sets()) {
    InterfaceCase copy = world;
    if (!field.set(copy, value)) return;
    const Verdict verdict = field.verdict(value);
    const Outcome outcome = run(copy, set);
    const bool is_refused = !outcome.refused_by.empty();
    // A shadow may be rejected as too far away, whichever field moved it.
    const bool is_about_shadow = copy.state.shadow_on && outcome.refused_by == "Frame::draw" &&
                                 outcome.message.find("shadow") != std::string::npos;
    if (is_refused && !is_about_shadow) {
      EXPECT_EQ(outcome.refused_by, field.call) << outcome.message;
    }
    if (verdict == Verdict::refused) {
      EXPECT_TRUE(is_refused) << "is accepted";
      if (is_refused && outcome.refused_by == field.call) expect_named(field, value, outcome.message);
    } else if (is_refused) {
      EXPECT_TRUE(verdict == Verdict::either || is_about_shadow) << outcome.message;
    }
    if (is_refused) return;
    EXPECT_LE(outcome.stats.dropped_non_finite + outcome.stats.culled + outcome.stats.zero_area,
              outcome.stats.triangles_in);
    expect_nothing_outside(copy, outcome);
    if (!first) first = outcome;
    EXPECT_EQ(outcome.fingerprint, first->fingerprint) << "on " << name(set);
    EXPECT_TRUE(outcome.shown == first->shown) << "on " << name(set);
  }
}

// Each value in two of the cases, or in all.
TEST(OddState, EveryOddValueIsRejectedOrDrawn) {
  const std::vector<InterfaceCase> all = interface_cases();
  std::size_t turn = 0;
  std::size_t pairs = 0;
  for (const Field& field : all_fields()) {
    std::vector<const InterfaceCase*> with;
    for (const InterfaceCase& world : all) {
      InterfaceCase copy = world;
      if (field.set(copy, 0)) with.push_back(&world);
    }
    if (with.empty()) continue;
    for (std::size_t value = 0; value < field.values; ++value)
      for (std::size_t i = 0; i < (long_tests() ? with.size() : std::min<std::size_t>(2, with.size())); ++i) {
        const InterfaceCase& world = *with[turn++ % with.size()];
        SCOPED_TRACE(field.name + " is " + field.found(value).front() + ", in \"" + world.name + "\"");
        expect_refusal_or_picture(field, value, world);
        ++pairs;
        if (HasFailure()) return;
      }
  }
  EXPECT_GT(pairs, 10000u);
}

TEST(OddState, EveryFieldOccursInSomeCase) {
  std::size_t somewhere = 0;
  for (const Field& field : all_fields()) {
    std::size_t with = 0;
    for (InterfaceCase& world : interface_cases()) with += field.set(world, 0);
    somewhere += with > 0;
    EXPECT_TRUE(with > 0 || field.name.starts_with("fragments."))
        << field.name << " occurs in none of the cases";
  }
  EXPECT_GT(somewhere, 250u);
}

// Unchanged, each case draws a non-empty picture, identical on every instruction set.
TEST(OddState, UnchangedCasesDrawPictures) {
  for (const InterfaceCase& world : interface_cases()) {
    SCOPED_TRACE(world.name);
    std::optional<Outcome> first;
    for (const InstructionSet set : available_instruction_sets()) {
      InterfaceCase copy = world;
      const Outcome outcome = run(copy, set);
      ASSERT_EQ(outcome.refused_by, "") << outcome.message;
      expect_nothing_outside(copy, outcome);
      if (!first) first = outcome;
      EXPECT_EQ(outcome.fingerprint, first->fingerprint);
      EXPECT_GT(outcome.stats.shaded_pixels, 100u);
    }
  }
}

/// Reports `workers` workers and runs all of them serially on the calling thread.
class SerialExecutor : public Executor {
 public:
  explicit SerialExecutor(int workers) : workers_(workers) {}
  int workers() const noexcept override { return workers_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = 0; k < count; ++k) work(context, k);
  }

 private:
  int workers_;
};

// Large worker counts are accepted up to the maximum, and use no memory for workers beyond it.
TEST(OddState, ExecutorsUseNoMemoryBeyondTheMaximumWorkerCount) {
  for (const int workers : odd_values<int>()) {
    std::optional<Renderer> renderer;
    const auto error = error_of(
        [&] { renderer.emplace(RendererOptions{.executor = std::make_shared<SerialExecutor>(workers)}); });
    EXPECT_EQ(error.has_value(), workers < 1) << workers;
    if (!renderer) continue;
    EXPECT_EQ(renderer->options().threads, std::min(workers, 1024));
    if (workers == std::numeric_limits<int>::max()) {
      FrameBuffer buffer({.width = 8, .height = 8});
      Frame frame(buffer);
      frame.clear({.color = Color{1, 0, 0, 1}});
      renderer->finish(frame);
      EXPECT_EQ(packed_colors(buffer)[0], 0xff0000u);
    }
  }
}

}  // namespace
}  // namespace tessera::test::odd_state_test
