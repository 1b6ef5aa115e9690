// `tessera price`: lists, prices and checks on the command line.
#ifdef TESSERA_PROGRAM
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/engine/program/program.h"

namespace tessera::price_program_test {
namespace {

using testing::HasSubstr;

/// Keeps prices in the test's folder.
class PriceProgram : public Program {
 protected:
  PriceProgram() { ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1); }
  ~PriceProgram() override { ::unsetenv("XDG_CACHE_HOME"); }
  Result price(const std::string& arguments) { return run("price " + arguments); }
  /// Adds a price of 1 ns to the kept list for each item, so that none needs to be measured.
  void keep_all_prices() {
    const std::filesystem::path file = std::filesystem::directory_iterator(folder_ / "tessera")->path();
    nlohmann::json list = nlohmann::json::parse(std::ifstream(file));
    std::istringstream items(price("--list").out);
    for (std::string line; std::getline(items, line);)
      list["prices"].push_back(
          {{"item", line.substr(0, line.find(' '))}, {"nanoseconds", 1}, {"low", 1}, {"high", 1}});
    std::ofstream(file) << list;
  }
};

TEST_F(PriceProgram, ListsWhatHasAPrice) {
  const Result listed = price("--list");
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("pixel_spot                        shaded pixel\n"));
}

TEST_F(PriceProgram, RefusesUnknownNames) {
  const Result unknown = price("pixel_sport");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("found \"pixel_sport\", expected the name of a price or a prefix"));
  const Result set = price("--isa mmx");
  EXPECT_EQ(set.code, 2);
  EXPECT_THAT(set.err, HasSubstr("--isa: found \"mmx\", expected one of "));
  const Result missing = price("--check none.json");
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("none.json"));
}

TEST_F(PriceProgram, MeasuresKeepsAndChecks) {
  const Result measured = price("frame shown --seconds 0.01 --json -");
  ASSERT_EQ(measured.code, 0) << measured.err;
  const nlohmann::json list = nlohmann::json::parse(measured.out);
  EXPECT_EQ(list["prices"][0]["item"], "frame");
  EXPECT_GT(list["prices"][0]["nanoseconds"], 0);
  EXPECT_EQ(list["prices"].size(), 4) << "frame, and three prices of shown pixels";
  EXPECT_TRUE(std::filesystem::is_directory(folder_ / "tessera"));
  write("scene.json", R"({"tessera": 1, "frame": [{"clear": {"color": [1, 0, 0, 1]}}]})");
  keep_all_prices();
  const Result checked = price("--check scene.json");
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("scene.json"));
  EXPECT_THAT(checked.out, HasSubstr("shown_pixel"));
}

}  // namespace
}  // namespace tessera::price_program_test
#endif
