// The command `tessera selftest`: success, wrong hashes, and processor time.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include "tests/engine/program/program.h"

namespace tessera::program_selftest_test {
namespace {

class ProgramSelftest : public Program {};

double seconds_of_children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

TEST_F(ProgramSelftest, SelfTestPassesWithinSeconds) {
  const double before = seconds_of_children();
  const Result result = run("selftest --threads 2");
  const double seconds = seconds_of_children() - before;
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_TRUE(result.err.empty()) << result.err;
  for (const char* part :
       {"CPU   ", "instruction sets   ", "1 and 2 threads, ", "tex_rows_in_scene ", "coverage, ",
        "0 pixels wrong", "powers, ", "stored levels, ", "result             PASS: "})
    EXPECT_TRUE(contains(result.out, part)) << part << "\n" << result.out;
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(seconds, 10) << "processor time of all cores";
#else
  static_cast<void>(seconds);
#endif
}

// The built-in hashes are those of tests/picture_hashes.txt. Differing hashes are reported per scene.
TEST_F(ProgramSelftest, SelfTestReportsWrongHashes) {
  const std::string hashes = run("selftest --hashes").out;
  std::ifstream stream(TESSERA_SOURCE_DIR "/tests/picture_hashes.txt");
  const std::string kept{std::istreambuf_iterator<char>(stream), {}};
  std::size_t lines = 0;
  for (std::size_t at = 0, end; (end = hashes.find('\n', at)) != std::string::npos; at = end + 1, ++lines)
    EXPECT_TRUE(contains("\n" + kept, "\n" + hashes.substr(at, end + 1 - at))) << hashes.substr(at, end - at);
  EXPECT_GE(lines, 12u);

  // Changes one digit in the hash of one scene's colour, another's depth, stencil and accumulation.
  const std::string colors = "terms_together";
  const std::string depths = "tex_rows_in_scene";
  const std::string stencil = "fx_shadow_volumes_zfail_plain";
  const std::string accumulation = "ops_accum_motion_blur";
  std::string other = "\n" + kept;
  for (const auto& [scene, digit] :
       {std::pair{colors, 3}, std::pair{depths, 20}, std::pair{stencil, 37}, std::pair{accumulation, 54}}) {
    const std::size_t at = other.find("\n" + scene + " ");
    ASSERT_NE(at, std::string::npos);
    char& changed = other[at + scene.size() + 2 + digit];
    changed = changed == '0' ? '1' : '0';
  }
  write("kept.txt", kept);
  write("other.txt", other.substr(1));
  EXPECT_EQ(run("selftest --threads 1 --expect kept.txt").code, 0) << "the list may have more scenes";
  const Result result = run("selftest --threads 1 --expect other.txt");
  EXPECT_EQ(result.code, 3) << result.out;
  EXPECT_EQ(result.err, "tessera: error: the self-test failed: " + std::to_string(lines - 4) + " of " +
                            std::to_string(lines) + " scenes, 3 of 3 exact checks passed\n");
  EXPECT_TRUE(contains(result.out, "result             FAIL: ")) << result.out;
  std::vector<std::string> reports;
  std::istringstream output(result.out);
  for (std::string line, before; std::getline(output, line); before = line)
    if (before.ends_with("FAIL")) reports.push_back(before.substr(0, before.find(' ')) + line);
  ASSERT_EQ(reports.size(), 4u) << result.out;
  EXPECT_TRUE(reports[0].starts_with(colors + "  all lighting terms")) << reports[0];
  EXPECT_TRUE(reports[1].starts_with(stencil + "  shadow volumes")) << reports[1];
  EXPECT_TRUE(reports[2].starts_with(accumulation + "  accumulation")) << reports[2];
  EXPECT_TRUE(reports[3].starts_with(depths + "  textures")) << reports[3];
  const std::string counts = result.out.substr(result.out.find("configurations     ") + 19);
  const std::string number = counts.substr(0, counts.find(':'));
  for (const std::string& line : reports)
    EXPECT_TRUE(contains(
        line,
        number + " of " + number +
            " renderings failed; the first: the hashes of colour, depth, stencil and accumulation are "))
        << line;
}

}  // namespace
}  // namespace tessera::program_selftest_test
#endif
