// Lists of picture hashes.
#include <gtest/gtest.h>

#include "engine/program/scene/picture_hashes.h"
#include "tests/engine/frame/api_support.h"

namespace tessera::picture_hashes_test {
using namespace program;
namespace {

using test::error_of;

TEST(PictureHashLists, RoundTrip) {
  const PictureHash a{0x0123456789abcdef, 0, 2, 3};
  const PictureHash b{1, 0xffffffffffffffff, 0, 0};
  EXPECT_EQ(to_text(a), "0123456789abcdef 0000000000000000 0000000000000002 0000000000000003");
  const PictureHashes list = parse_picture_hashes("a " + to_text(a) + "\nb_2 " + to_text(b), "list");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list.at("a"), a);
  EXPECT_EQ(list.at("b_2"), b);
  EXPECT_TRUE(parse_picture_hashes("", "list").empty());
}

TEST(PictureHashLists, RejectMalformedLines) {
  const std::string two = "0123456789abcdef 0123456789abcdef";
  const std::string four = two + " " + two;
  const std::string good = "a " + four + "\n";
  const struct {
    std::string text;
    std::string message;
  } kBad[] = {
      {"\n", "list:1: expected a scene's name and four hashes"},
      {good + "b " + two + "\n", "list:2: expected a scene's name"},
      {good + "b " + two + " 0123456789abcdef\n", "list:2: expected a scene's name"},
      {good + four + "\n", "list:2: expected a scene's name"},
      {good + " " + four + "\n", "list:2: expected a scene's name"},
      {good + "b " + four + "a\n", "list:2: expected"},
      {good + "b 0123456789abcdeg " + two + " 0123456789abcdef\n", "list:2: expected"},
      {good + "b " + two + " 0123456789abcdeg 0123456789abcdef\n", "list:2: expected"},
      {good + "b " + two + "  " + two + "\n", "list:2: expected"},
      {good + "b -123456789abcdef " + two + " 0123456789abcdef\n", "list:2: expected"},
      {good + "b " + two + " 0123456789abcdef -123456789abcdef\n", "list:2: expected"},
      {good + "b " + four + "\r\n", "list:2: expected"},
      {good + "b " + four + " \n", "list:2: expected"},
      {good + "b c " + four + "\n", "list:2: expected"},
      {good + good, "list:2: \"a\" occurs twice"},
      {std::string("\0\xff\x80", 3), "list:1: expected"},
  };
  for (const auto& [text, message] : kBad)
    EXPECT_TRUE(
        error_of([&] { parse_picture_hashes(text, "list"); }).value_or("(no error)").starts_with(message))
        << text;
}

}  // namespace
}  // namespace tessera::picture_hashes_test
