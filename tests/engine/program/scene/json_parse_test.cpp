// The JSON parser. Quadratic time would exceed the time limit of these tests.
#include <gtest/gtest.h>

#include <string>

#include "engine/program/scene/json_value.h"

namespace tessera::program::json::json_parse_test {
namespace {

TEST(JsonParse, ListsOfObjectsParseInLinearTime) {
  constexpr std::size_t kObjects = 1500000;
  std::string text = "[{}";
  for (std::size_t i = 1; i < kObjects; ++i) text += ",{}";
  const Json list = parse(text + "]", "long.json");
  ASSERT_EQ(list.size(), kObjects);
  EXPECT_TRUE(list[kObjects - 1].is_object());
}

TEST(JsonParse, LargeObjectsParseInLinearTime) {
  constexpr std::size_t kMembers = 1000000;
  std::string text = "{\"first\":0";
  for (std::size_t i = 1; i < kMembers; ++i)
    text += ",\"" + std::to_string(i + kMembers) + "\":" + std::to_string(i);
  const Json object = parse(text + "}", "large.json");
  ASSERT_EQ(object.size(), kMembers);
  EXPECT_EQ(object.begin().key(), "first");
  auto last = object.end();
  --last;
  EXPECT_EQ(last.key(), std::to_string(2 * kMembers - 1));
  EXPECT_EQ(last.value().get<std::size_t>(), kMembers - 1);
}

TEST(JsonParse, KeepsTypesAndOrder) {
  const std::string text =
      R"({"z":[null,true,-1,18446744073709551615,1.5,"a",{},[]],"a":{"y":{"x":[[1],[2]]},"b":""},"m":0})";
  const Json parsed = parse(text, "kinds.json");
  EXPECT_EQ(parsed.dump(), text);
  EXPECT_TRUE(parsed.at("m").is_number_unsigned());
  EXPECT_TRUE(parsed.at("z").at(2).is_number_integer());
}

}  // namespace
}  // namespace tessera::program::json::json_parse_test
