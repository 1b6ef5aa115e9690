// Child processes with limits, and the models they send back.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <new>
#include <thread>

#include "engine/program/import/child_process.h"
#include "engine/program/import/model_bytes.h"

namespace tessera::child_process_test {
using namespace program;
namespace {

TEST(ChildProcess, EnforcesLimitsAndReportsReason) {
  const auto message = [](const ChildLimits& limits, const std::function<std::string()>& work) {
    try {
      return "result " + run_in_child("file", limits, work);
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(message({}, [] { return std::string(200000, 'x'); }), "result " + std::string(200000, 'x'));
  EXPECT_EQ(message({}, []() -> std::string { throw Error("file:3: bad"); }), "file:3: bad");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(message({.time = std::chrono::milliseconds(1000)},
                    [] {
                      std::this_thread::sleep_for(std::chrono::seconds(30));
                      return std::string();
                    }),
            "file made no progress for 1 seconds; given up");
  int asked = 0;
  EXPECT_EQ(message({.should_continue = [&] { return ++asked < 4; }},
                    [] {
                      std::this_thread::sleep_for(std::chrono::seconds(30));
                      return std::string();
                    }),
            "file was interrupted");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_NE(message({}, []() -> std::string { std::abort(); }).find("crashed"), std::string::npos);
  EXPECT_NE(message({.result_bytes = 1 << 20}, [] { return std::string(3 << 20, 'x'); })
                .find("gives 3 MiB, must be at most 1 MiB"),
            std::string::npos);
  EXPECT_NE(message({}, []() -> std::string { throw std::bad_alloc(); }).find("1024 MiB"), std::string::npos);
  EXPECT_NE(message({}, []() -> std::string { throw 3; }).find("unknown type"), std::string::npos);
  EXPECT_NE(message({},
                    []() -> std::string {
                      ::raise(SIGINT);
                      return "";
                    })
                .find("interrupted"),
            std::string::npos);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_NE(
      message({.memory_bytes = std::size_t{1} << 30}, [] { return std::string(std::size_t{3} << 30, 'x'); })
          .find("1024 MiB"),
      std::string::npos);
#endif
}

// A child that takes two seconds in steps of a tenth is within a limit of one second.
TEST(ChildProcess, LimitsTimeWithoutProgress) {
  const ChildLimits limits{.time = std::chrono::milliseconds(1000)};
  std::vector<double> shares;
  ChildLimits with_progress = limits;
  with_progress.progress = [&shares](double done) { shares.push_back(done); };
  std::string result(3, ' ');
  run_in_child(
      "file", with_progress,
      [](ChildOutput& output) {
        for (int i = 1; i <= 20; ++i) {
          std::this_thread::sleep_for(std::chrono::milliseconds(100));
          output.report(i / 20.0);
        }
        output.begin_result(3);
        output.write("ab", 2);
        output.write("c", 1);
      },
      [&result](const ByteReader& read, std::uint64_t bytes) {
        EXPECT_EQ(bytes, 3u);
        read(result.data(), 1);
        read(&result[1], 2);
      });
  EXPECT_EQ(result, "abc");
  EXPECT_GT(shares.size(), 10u);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LE(shares.back(), 1);
  const auto work = [](ChildOutput& output) {
    for (int i = 0; i < 40; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      output.report(0.5);
    }
  };
  try {
    run_in_child("file", limits, work, [](const ByteReader&, std::uint64_t) {});
    FAIL() << "the same share again is no progress";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "file made no progress for 1 seconds; given up");
  }
}

// Large pieces are not buffered, small ones are.
TEST(ChildProcess, SendsPiecesOfAllSizes) {
  std::string sent;
  for (std::size_t size : {1, 70'000, 3, 65'536, 65'535, 1, 5'000'000, 8})
    sent.append(size, static_cast<char>('a' + sent.size() % 26));
  std::string received(sent.size(), ' ');
  run_in_child(
      "file", {},
      [&sent](ChildOutput& output) {
        output.begin_result(sent.size());
        std::size_t at = 0;
        for (std::size_t size : {1, 70'000, 3, 65'536, 65'535, 1, 5'000'000, 8}) {
          output.write(&sent[at], size);
          at += size;
        }
      },
      [&received](const ByteReader& read, std::uint64_t bytes) {
        ASSERT_EQ(bytes, received.size());
        std::size_t at = 0;
        for (std::size_t size : {5, 200'000, 1, 65'536}) {
          read(&received[at], size);
          at += size;
        }
        read(&received[at], received.size() - at);
      });
  EXPECT_TRUE(received == sent);
}

Model small_model() {
  Model model;
  model.mesh.positions = {1, 2, 3, 4, 5, 6};
  model.mesh.normals = {0, 0, 1, 0, 1, 0};
  model.mesh.colors = {1, 2, 3, 4, 5, 6, 7, 8};
  model.mesh.indices = {0, 1, 0, 1, 1, 0};
  model.parts = {
      {.material_name = "a",
       .material = {.shininess = 3},
       .first_index = 0,
       .index_count = 3,
       .uses_colors = true},
      {.material_name = "", .material = {.emission = {1, 2, 3, 4}}, .first_index = 3, .index_count = 3}};
  model.warnings = {"w", ""};
  model.cameras = {{.view = translate(1, 2, 3), .is_orthographic = true, .half_height = 30, .far = 7}};
  model.lights = {Light{.diffuse = {5, 6, 7, 8},
                        .position = {9, 8, 7, 6},
                        .spot_direction = {1, 2, 4},
                        .spot_cutoff = 12,
                        .attenuation_quadratic = 2}};
  model.ambient_light = Color{4, 3, 2, 1};
  return model;
}

TEST(ModelBytes, RoundTrips) {
  const std::string bytes = to_bytes(small_model());
  const Model back = model_from_bytes(bytes, "file");
  EXPECT_EQ(to_bytes(back), bytes);
  EXPECT_EQ(back.mesh.normals, small_model().mesh.normals);
  EXPECT_EQ(back.mesh.colors, small_model().mesh.colors);
  EXPECT_EQ(back.parts.at(0).material_name, "a");
  EXPECT_EQ(back.parts.at(0).material.shininess, 3);
  EXPECT_TRUE(back.parts.at(0).uses_colors);
  EXPECT_EQ(back.parts.at(1).material.emission.b, 3);
  EXPECT_EQ(back.warnings, small_model().warnings);
  EXPECT_EQ(back.cameras.at(0).view.m, translate(1, 2, 3).m);
  EXPECT_EQ(back.cameras.at(0).half_height, 30);
  EXPECT_EQ(back.lights.at(0).position, (std::array<float, 4>{9, 8, 7, 6}));
  EXPECT_EQ(back.lights.at(0).attenuation_quadratic, 2);
  EXPECT_EQ(back.ambient_light->g, 3);
}

TEST(ModelBytes, RejectsInvalidBytes) {
  const auto refused = [](const std::string& bytes) {
    try {
      model_from_bytes(bytes, "file");
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()), "file: the reading process sent an invalid model");
      return true;
    }
    return false;
  };
  const std::string bytes = to_bytes(small_model());
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_TRUE(refused(bytes.substr(0, size))) << size;
  EXPECT_TRUE(refused(bytes + "x"));
  void (*const kInvalid[])(Model&) = {[](Model& m) { m.mesh.indices[4] = 2; },
                                      [](Model& m) { m.mesh.positions.pop_back(); },
                                      [](Model& m) { m.mesh.normals.push_back(0); },
                                      [](Model& m) { m.mesh.colors.pop_back(); },
                                      [](Model& m) { m.parts.clear(); },
                                      [](Model& m) { m.parts[1].first_index = 0; },
                                      [](Model& m) { m.parts[1].index_count = 6; },
                                      [](Model& m) { m.parts[1].index_count = ~std::size_t{0} - 2; },
                                      [](Model& m) { m.parts.pop_back(); }};
  for (const auto& invalidate : kInvalid) {
    Model model = small_model();
    invalidate(model);
    EXPECT_TRUE(refused(to_bytes(model))) << &invalidate - kInvalid;
  }
}

// Sanitizers need more memory than the limit leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ModelBytes, AllocatesNoMoreThanTheInputHolds) {
  constexpr std::size_t kParts = 16 << 20;
  std::string bytes(40, '\0');  // five empty arrays, then parts
  bytes.append(reinterpret_cast<const char*>(&kParts), sizeof kParts);
  bytes.append(kParts, '\xff');  // the first name claims to be longer than the rest
  try {
    run_in_child("reading", {.memory_bytes = 256 << 20},
                 [&] { return to_bytes(model_from_bytes(bytes, "file")); });
    FAIL() << "invalid bytes were accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "file: the reading process sent an invalid model");
  }
}
#endif

}  // namespace
}  // namespace tessera::child_process_test
