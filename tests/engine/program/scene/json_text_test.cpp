// JSON text for people.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include "engine/program/scene/json_text.h"

namespace tessera::json_text_test {
using program::json::Json;
using program::json::number;
using program::json::readable_text;
namespace {

bool is_read_back(float x) {
  const Json read = Json::parse(number(x).dump());
  return std::bit_cast<std::uint32_t>(static_cast<float>(read.get<double>())) ==
         std::bit_cast<std::uint32_t>(x);
}

TEST(JsonText, NumbersAreReadBackAsTheSameFloats) {
  using Limits = std::numeric_limits<float>;
  for (const float x : {0.0f, -0.0f, 1.0f, 0.1f, -0.3f, 16777216.0f, Limits::min(), Limits::denorm_min(),
                        Limits::max(), Limits::lowest(), Limits::epsilon()})
    EXPECT_TRUE(is_read_back(x)) << x;
  std::mt19937 random(1);
  for (int i = 0; i < 200000; ++i) {
    const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    const bool is_finite = x - x == 0;
    ASSERT_TRUE(!is_finite || is_read_back(x)) << x;
  }
}

TEST(JsonText, NumbersHaveNoMoreDigitsThanNeeded) {
  EXPECT_EQ(number(0.1f).dump(), "0.1");
  EXPECT_EQ(number(1.0f / 3).dump(), "0.33333334");
  EXPECT_EQ(number(2.0f).dump(), "2.0");
}

TEST(JsonText, WritesOneLineIfItFits) {
  EXPECT_EQ(readable_text({{"eye", {0, 1.5, -2}}, {"empty", Json::array()}, {"none", nullptr}}),
            "{\"eye\": [0, 1.5, -2], \"empty\": [], \"none\": null}\n");
  EXPECT_EQ(readable_text(Json("a \xff b")), "\"a \xef\xbf\xbd b\"\n");
}

TEST(JsonText, BreaksLongListsAndObjects) {
  Json list = Json::array();
  for (int i = 0; i < 100; ++i) list.push_back(i);
  Json vectors = Json::array();
  for (int i = 0; i < 30; ++i) vectors.push_back({i, 0.5, "abc"});
  const Json json{{"list", list}, {"vectors", vectors}, {"name", std::string(150, 'x')}};
  const std::string text = readable_text(json);
  EXPECT_EQ(Json::parse(text), json);
  EXPECT_TRUE(text.starts_with("{\n  \"list\": [\n    0, 1, 2, 3,")) << text;
  EXPECT_NE(text.find("\n    [29, 0.5, \"abc\"]\n  ],\n"), std::string::npos) << text;
  EXPECT_LT(std::ranges::count(text, '\n'), 50);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= 101 || line.find("xxx") != std::string::npos) << line;
}

}  // namespace
}  // namespace tessera::json_text_test
