// Each reason of `tessera explain --json` occurs in a scene, and disappears when the field that is its cause
// changes.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string>

#include "tests/engine/program/program.h"
#include "tests/engine/program/reason_cases.h"

namespace tessera::explain_reasons_test {
namespace {

using namespace test;
using nlohmann::json;

json parts_of(const char* patch) {
  json parts = scene_parts();
  parts.merge_patch(json::parse(patch));
  return parts;
}

/// Runs the command on scenes.
class ExplainJson : public Program {
 protected:
  json explain(const json& parts) const {
    write("image.ppm", "P6 2 1 255\nabcdef");
    write("case.json", scene_file(parts));
    const Result result = run("explain case.json --json");
    EXPECT_EQ(result.code, 0) << result.err << "\n" << scene_file(parts);
    return result.code == 0 ? json::parse(result.out) : json();
  }
};

class ExplainReasons : public ExplainJson, public testing::WithParamInterface<ReasonCase> {
 protected:
  /// The cause of the reason; absent if no note about the effect gives this reason.
  std::optional<std::string> cause_in(const json& explanation) const {
    for (const json& note : explanation["draws"][0]["effects"])
      if (note["effect"] == GetParam().effect && note["reason"] == std::string(code(GetParam().reason)))
        return note["cause"].get<std::string>();
    return std::nullopt;
  }
};

TEST_P(ExplainReasons, DisappearWithTheirCause) {
  json parts = parts_of(GetParam().scene);
  const std::optional<std::string> cause = cause_in(explain(parts));
  ASSERT_TRUE(cause) << "the reason does not occur";
  EXPECT_EQ(*cause, GetParam().cause);
  set_value(parts, place_of_cause(*cause), json::parse(GetParam().changed));
  EXPECT_FALSE(cause_in(explain(parts))) << "the reason occurs although its cause has changed";
}

std::string name_of(const ReasonCase& of) {
  std::string name = std::string(code(of.reason)) + "_" + of.effect + "_" + of.cause;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(EveryReason, ExplainReasons, testing::ValuesIn(reason_cases()),
                         [](const testing::TestParamInfo<ReasonCase>& of) { return name_of(of.param); });

class ExplainBufferReasons : public ExplainJson, public testing::WithParamInterface<BufferReasonCase> {
 protected:
  std::string reason_in(const json& explanation) const {
    for (const json& note : explanation["buffers"])
      if (note["buffer"] == GetParam().buffer) return note["reason"];
    return "";
  }
};

TEST_P(ExplainBufferReasons, DisappearWithTheirCause) {
  json parts = parts_of(GetParam().scene);
  const std::string reason(code(GetParam().reason));
  EXPECT_EQ(reason_in(explain(parts)), reason);
  set_value(parts, json::json_pointer(GetParam().place), json::parse(GetParam().changed));
  EXPECT_NE(reason_in(explain(parts)), reason);
}
INSTANTIATE_TEST_SUITE_P(EveryReason, ExplainBufferReasons, testing::ValuesIn(buffer_reason_cases()),
                         [](const testing::TestParamInfo<BufferReasonCase>& of) {
                           return std::string(code(of.param.reason));
                         });

// The program shows its frames and keeps no buffer. Frames of the library that are not shown have two more
// reasons.
TEST(BufferReasons, DependOnWhatTheFrameKeeps) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  const auto reason_of_color = [&](bool presented) { return frame.buffers(presented)[0].reason; };
  frame.clear({.color = Color{1, 0, 0, 1}});
  EXPECT_EQ(reason_of_color(false), BufferReason::ends_cleared);
  const std::uint8_t bits = 0xff;
  frame.draw_bitmap({.bits = &bits, .width = 8, .height = 1, .color = {0, 1, 0, 1}});
  EXPECT_EQ(reason_of_color(false), BufferReason::kept);
  EXPECT_EQ(reason_of_color(true), BufferReason::not_kept);
}

TEST(ExplainReasonCases, CoverEveryReason) {
  std::set<EffectReason> tested;
  for (const ReasonCase& of : reason_cases()) tested.insert(of.reason);
  tested.insert(EffectReason::replaced_by_stage);  // no stage of scenes replaces colours: see UserStages
  int reasons = 0;
  for (; !code(static_cast<EffectReason>(reasons)).empty(); ++reasons)
    EXPECT_TRUE(tested.contains(static_cast<EffectReason>(reasons)))
        << code(static_cast<EffectReason>(reasons));
  EXPECT_EQ(tested.size(), static_cast<std::size_t>(reasons));

  std::set<BufferReason> of_buffers{BufferReason::kept, BufferReason::ends_cleared};  // tested above
  for (const BufferReasonCase& of : buffer_reason_cases()) of_buffers.insert(of.reason);
  for (int i = 0; !code(static_cast<BufferReason>(i)).empty(); ++i)
    EXPECT_TRUE(of_buffers.contains(static_cast<BufferReason>(i))) << code(static_cast<BufferReason>(i));
}

}  // namespace
}  // namespace tessera::explain_reasons_test
#endif
