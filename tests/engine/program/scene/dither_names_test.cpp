// Names of dithers, and the override of a scene's dither.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "engine/program/scene/dither_names.h"
#include "engine/program/scene/scene.h"

namespace tessera::program::dither_names_test {
namespace {

TEST(DitherNames, AreUniqueAndFoundAgain) {
  std::set<std::string_view> names;
  std::set<Dither> dithers;
  for (const auto& [name, dither] : kDithers) {
    names.insert(name);
    dithers.insert(dither);
    EXPECT_EQ(named_dither(name), dither);
    EXPECT_EQ(dither_name(dither), name);
  }
  EXPECT_EQ(names.size(), kDithers.size());
  EXPECT_EQ(dithers.size(), kDithers.size());
  EXPECT_TRUE(dither_name_list("|").starts_with("none|bayer2|bayer4|bayer8"));
}

TEST(DitherNames, SuggestsTheNameOfAMistypedOne) {
  try {
    named_dither("bayr8");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "found \"bayr8\", expected one of " + dither_name_list(", ") + "; did you mean \"bayer8\"?");
  }
}

TEST(DitherOverride, ReplacesTheDitherOfTheColorsThatAreKept) {
  const auto scene_of = [](const char* framebuffer) {
    return parse_scene(std::string(R"({"tessera": 1, "framebuffer": )") + framebuffer + "}", "s.json");
  };
  Scene plain = scene_of(R"({"color": {"bits": 6}, "dither": "bayer2"})");
  apply({}, plain);
  EXPECT_EQ(plain.framebuffer.dither, Dither::bayer2);
  apply({.dither = Dither::none}, plain);
  EXPECT_EQ(plain.framebuffer.dither, Dither::none);
  Scene reduced = scene_of(R"({"mode": "cga", "reduce": true, "dither": "bayer2"})");
  apply({.dither = Dither::bayer8}, reduced);
  EXPECT_EQ(reduced.framebuffer.dither, Dither::none);
  EXPECT_EQ(reduced.reduced->dither, Dither::bayer8);
}

}  // namespace
}  // namespace tessera::program::dither_names_test
