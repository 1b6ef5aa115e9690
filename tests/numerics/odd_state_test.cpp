// Every number of every struct of the interface is given every odd value: either the call that takes it
// refuses it, and says what it found, or there is a picture, the same on every instruction set, that changed
// nothing outside of what may change.
#include <gtest/gtest.h>

#include "tests/numerics/odd_draw_fields.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test {
namespace {

// Where neither draw nor image nor accumulation may write, the clear alone may have been; where that was not,
// what a new buffer holds.
void expect_nothing_outside(const InterfaceCase& w, const Outcome& outcome) {
  if (w.accum && w.accum->op == AccumOp::return_color) return;
  const int width = w.format.width, height = w.format.height;
  std::optional<std::uint32_t> cleared, uncleared, far_cleared, far_uncleared;
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
      << "\"" << message << "\" does not say \"" << texts.front() << "\"";
}

void expect_refusal_or_picture(const Field& field, std::size_t value, const InterfaceCase& world) {
  std::optional<Outcome> first;
  for (const InstructionSet set : available_instruction_sets()) {
    InterfaceCase copy = world;
    if (!field.set(copy, value)) return;
    const Verdict verdict = field.verdict(value);
    const Outcome outcome = run(copy, set);
    const bool is_refused = !outcome.refused_by.empty();
    // A shadow may be too far away for numbers, whoever moved it there.
    const bool is_about_shadow = copy.state.shadow_on && outcome.refused_by == "Frame::draw" &&
                                 outcome.message.find("shadow") != std::string::npos;
    if (is_refused && !is_about_shadow) {
      EXPECT_EQ(outcome.refused_by, field.call) << outcome.message;
    }
    if (verdict == Verdict::refused) {
      EXPECT_TRUE(is_refused) << "is taken";
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

// Each value in two of the worlds, or in all.
TEST(OddState, IsRefusedOrDrawn) {
  const std::vector<InterfaceCase> all = interface_cases();
  std::size_t turn = 0, pairs = 0;
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

TEST(OddState, IsNotLookedForInVain) {
  std::size_t somewhere = 0;
  for (const Field& field : all_fields()) {
    std::size_t with = 0;
    for (InterfaceCase& world : interface_cases()) with += field.set(world, 0);
    somewhere += with > 0;
    EXPECT_TRUE(with > 0 || field.name.starts_with("fragments."))
        << field.name << " is in none of the worlds";
  }
  EXPECT_GT(somewhere, 250u);
}

// Unchanged, each world is drawn, the same on every instruction set, and there is something to see.
TEST(OddState, BeginsWithPictures) {
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

/// Says that it has any number of workers, and does the work itself.
class Boaster : public Executor {
 public:
  explicit Boaster(int workers) : workers_(workers) {}
  int workers() const noexcept override { return workers_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = 0; k < count; ++k) work(context, k);
  }

 private:
  int workers_;
};

// As many as are asked for are taken, but no more than can be asked for.
TEST(OddState, OfExecutorsTakesNoMemoryForWorkersBeyondTheMost) {
  for (const int workers : odd_values<int>()) {
    std::optional<Renderer> renderer;
    const auto error =
        error_of([&] { renderer.emplace(RendererOptions{.executor = std::make_shared<Boaster>(workers)}); });
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
}  // namespace tessera::test
