// Screens have the same bits for every instruction set and number of threads; images of parts are parts of
// images; planes show what their pixels show; wrong input is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "tests/framebuffer/screen_support.h"

namespace tessera::screen_bits_test {
namespace {

using namespace screen_support;

constexpr VideoMode kMode{.width = 77, .height = 53};

std::vector<std::uint8_t> noise(unsigned seed) {
  std::mt19937 random(seed);
  return picture(77, 53, [&](int, int) {
    const auto level = [&] { return static_cast<std::uint8_t>(random() & 255); };
    const std::uint8_t r = level(), g = level(), b = level();
    return Level{r, g, b};
  });
}

/// Starts a thread per worker.
struct Threads {
  int count;
  int workers() const { return count; }
  void run(int n, void (*work)(void*, int), void* context) const {
    std::vector<std::thread> threads;
    for (int k = 0; k < n; ++k) threads.emplace_back([=] { work(context, k); });
    for (std::thread& thread : threads) thread.join();
  }
};

struct Images {
  std::vector<std::uint8_t> rgb;
  std::vector<float> light;
  bool operator==(const Images&) const = default;
};

/// Images of three pictures.
Images images(Screen screen) {
  const std::size_t values =
      3 * static_cast<std::size_t>(screen.width()) * static_cast<std::size_t>(screen.height());
  Images all;
  for (unsigned k = 0; k < 3; ++k) {
    const std::vector<std::uint8_t> shown = noise(k);
    std::vector<std::uint8_t> rgb(values);
    std::vector<float> light(values);
    screen.show({.rgb = shown}, k * screen.frame_ms() * 1.4, {.rgb = rgb.data(), .light = light.data()});
    all.rgb.insert(all.rgb.end(), rgb.begin(), rgb.end());
    all.light.insert(all.light.end(), light.begin(), light.end());
  }
  return all;
}

const char* const kDisplays[] = {
    "crt:diagonal=3,beam_growth=0.5,convergence=0.1,halation=0.2,exposure=5",
    "crt:diagonal=3,mask=slots,pitch=0.5,overscan=0.05,scan_lines=2",
    "crt:diagonal=3,mask=none,phosphor=p39,halation=0.1",
    "lcd:diagonal=3,bits=6,response=40",
    "plasma:diagonal=3,exposure=5",
    "eink:diagonal=3,update=fast",
    "ntsc:diagonal=3,decoder=comb",
    "pal:diagonal=3,phase=10",
};
constexpr ScreenView kView{.scale_px_per_mm = 5.3};

TEST(ScreenBits, AreTheSameForEveryInstructionSet) {
  for (const char* display : kDisplays) {
    const Images expected = images(Screen(find_display(display), kMode, kView, {}, InstructionSet::scalar));
    for (const InstructionSet isa : detail::available_isas())
      EXPECT_EQ(images(Screen(find_display(display), kMode, kView, {}, isa)), expected)
          << display << " " << static_cast<int>(isa);
  }
}

TEST(ScreenBits, AreTheSameForEveryNumberOfThreads) {
  for (const char* display : kDisplays) {
    const Images expected = images(Screen(find_display(display), kMode, kView));
    for (const int count : {1, 2, 3, 8}) {
      Threads threads{count};
      EXPECT_EQ(images(Screen(find_display(display), kMode, kView, ScreenWorkers(threads))), expected)
          << display << " " << count;
    }
  }
}

TEST(ScreenBits, ImagesOfPartsArePartsOfImages) {
  for (const char* display : kDisplays) {
    Screen whole(find_display(display), kMode, {.scale_px_per_mm = 5});
    Screen part(find_display(display), kMode,
                {.scale_px_per_mm = 5, .x_mm = 10, .y_mm = 20, .width_mm = 16, .height_mm = 12});
    const LightImage all = show(whole, noise(1), 0), some = show(part, noise(1), 0);
    ASSERT_EQ(some.width, 80);
    ASSERT_EQ(some.height, 60);
    // The grid of scattered light lies elsewhere, and floats of positions round elsewhere.
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 80; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(some.at(x, y, c), all.at(x + 50, y + 100, c), 2e-3) << display << " " << x << " " << y;
  }
}

TEST(ScreenBits, PlanesShowWhatTheirPixelsShow) {
  std::mt19937 random(3);
  for (int bits = 1; bits <= 24; ++bits)
    for (const bool has_palette : {false, true}) {
      if (has_palette && bits > 8) continue;
      std::vector<std::uint32_t> palette;
      for (int i = 0; has_palette && i < (1 << bits) - 1; ++i) palette.push_back(random() & 0xffffffu);
      constexpr std::size_t kStride = 13;  // 77 pixels take 10 bytes
      std::vector<std::vector<std::uint8_t>> planes(static_cast<std::size_t>(bits),
                                                    std::vector<std::uint8_t>(kStride * 53));
      std::vector<std::uint8_t> rgb;
      for (std::size_t y = 0; y < 53; ++y)
        for (std::size_t x = 0; x < 77; ++x) {
          const std::uint32_t value = random() & ((1u << bits) - 1);
          for (std::size_t k = 0; k < planes.size(); ++k)
            if ((value >> k & 1) != 0)
              planes[k][kStride * y + x / 8] |= static_cast<std::uint8_t>(128u >> x % 8);
          const auto level = [&](int shift, int width) {
            const std::uint32_t max = (1u << width) - 1;
            return static_cast<std::uint8_t>(std::lround(255.0 * (value >> shift & max) / max));
          };
          if (has_palette) {
            const std::uint32_t color = value < palette.size() ? palette[value] : 0;
            rgb.insert(rgb.end(), {static_cast<std::uint8_t>(color >> 16),
                                   static_cast<std::uint8_t>(color >> 8), static_cast<std::uint8_t>(color)});
          } else if (bits <= 2) {
            rgb.insert(rgb.end(), 3, level(0, bits));
          } else {
            const int b = bits / 3, g = (bits + 2) / 3, r = (bits + 1) / 3;
            rgb.insert(rgb.end(), {level(b + g, r), level(b, g), level(0, b)});
          }
        }
      VideoPicture picture{.plane_stride_bytes = kStride, .palette = palette};
      for (const auto& plane : planes) picture.planes.emplace_back(plane);
      Screen screen(find_display("lcd:diagonal=3"), kMode, {.scale_px_per_mm = 2});
      LightImage image = show(screen, rgb, 0), of_planes = image;
      screen.show(picture, 20, {.light = of_planes.light.data()});
      EXPECT_EQ(image.light, of_planes.light) << bits << " planes";
    }
}

TEST(ScreenBits, RowsMayHaveGaps) {
  const std::vector<std::uint8_t> tight = noise(5);
  std::vector<std::uint8_t> wide(53 * 400, 99);
  for (std::size_t y = 0; y < 53; ++y)
    for (std::size_t x = 0; x < 77; ++x)
      for (std::size_t c = 0; c < 3; ++c) wide[400 * y + 4 * x + c] = tight[3 * (77 * y + x) + c];
  Screen screen(find_display("crt:diagonal=3"), kMode, {.scale_px_per_mm = 5});
  const auto width = static_cast<std::size_t>(screen.width()),
             height = static_cast<std::size_t>(screen.height());
  std::vector<std::uint8_t> a(3 * width * height), b((3 * width + 7) * height, 55);
  screen.show({.rgb = tight}, 0, {.rgb = a.data()});
  screen.show({.rgb = wide, .pixel_bytes = 4, .stride_bytes = 400}, 0,
              {.rgb = b.data(), .stride_bytes = static_cast<std::ptrdiff_t>(3 * width + 7)});
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t i = 0; i < 3 * width; ++i) ASSERT_EQ(a[3 * width * y + i], b[(3 * width + 7) * y + i]);
    for (std::size_t i = 3 * width; i < 3 * width + 7; ++i) ASSERT_EQ(b[(3 * width + 7) * y + i], 55);
  }
}

TEST(ScreenBits, WrongInputIsRefusedWithTheValueFound) {
  const auto message = [](const std::function<void()>& action) -> std::string {
    try {
      action();
    } catch (const DisplayError& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  const Display tube = find_display("crt:diagonal=3");
  const auto with_mode = [&](const VideoMode& mode) { return message([&] { Screen(tube, mode, kView); }); };
  const auto with_view = [&](const ScreenView& view) { return message([&] { Screen(tube, kMode, view); }); };
  EXPECT_EQ(with_mode({.width = 0, .height = 10}), "the mode has 0x10 pixels, expected 1x1 to 16384x16384");
  EXPECT_EQ(with_mode({.width = 10, .height = 10, .pixel_aspect = std::nan("")}),
            "the pixels' aspect is nan, expected 0.1 to 10");
  EXPECT_EQ(with_mode({.width = 640, .height = 200, .timing = ScanTiming{1e7, 600, 262, 1, false}}),
            "the timing has 600 columns and 262 lines in all, the picture needs at least 640 and 200");
  EXPECT_EQ(with_mode({.width = 640, .height = 200, .timing = ScanTiming{0, 912, 262, 1, false}}),
            "the pixel clock is 0 Hz, expected 1e3 to 1e12");
  EXPECT_EQ(with_view({.scale_px_per_mm = -1}), "the scale is -1 pixels per mm, expected above 0 to 1000");
  EXPECT_EQ(with_view({.scale_px_per_mm = 900}),
            "at 900 pixels per mm the image has 54864 columns, at most 16384 are possible; choose a smaller "
            "part or scale");
  EXPECT_EQ(with_view({.x_mm = 50, .width_mm = 20}),
            "the part's width is from 50 to 70 mm, the screen has 0 to 60.96 mm");
  EXPECT_EQ(with_view({.gain = 0}), "the gain is 0, expected 0.01 to 100");
  EXPECT_EQ(message([] { Screen(find_display("crt:exposure=30"), kMode); }),
            "the exposure is 30 ms, at most one frame of 16.667 ms is possible");

  Screen screen(tube, kMode, kView);
  const std::vector<std::uint8_t> small(10);
  const auto showing = [&](const VideoPicture& shown, double time_ms) {
    return message([&] { screen.show(shown, time_ms, {}); });
  };
  EXPECT_EQ(showing({}, 0), "the picture is empty: neither rgb nor planes are set");
  EXPECT_EQ(showing({.rgb = small}, 0), "the picture has 10 bytes, the mode needs 12243");
  EXPECT_EQ(showing({.rgb = small, .pixel_bytes = 2}, 0), "pixel_bytes is 2, expected 3 or 4");
  EXPECT_EQ(showing({.rgb = small, .stride_bytes = 7}, 0),
            "the picture: the stride is 7 bytes, a row has 231");
  EXPECT_EQ(showing({.rgb = small, .planes = {small}}, 0),
            "the picture has both rgb and planes, expected one of them");
  EXPECT_EQ(showing({.planes = {small}}, 0), "a plane of the picture has 10 bytes, the mode needs 530");
  const std::vector<std::uint8_t> shown = noise(1);
  EXPECT_EQ(showing({.rgb = shown}, std::numeric_limits<double>::quiet_NaN()),
            "the time is nan ms, expected 0 to 1e12");
  screen.show({.rgb = shown}, 100, {});
  EXPECT_EQ(showing({.rgb = shown}, 99), "the time is 99 ms, before that of the last picture, 100 ms");
}

TEST(ScreenBits, NotesNameWhatTheViewCannotShow) {
  const auto notes = [](const std::string& display, const VideoMode& mode, double scale) {
    return Screen(find_display(display), mode, {.scale_px_per_mm = scale}).notes();
  };
  EXPECT_THAT(notes("crt", {.width = 640, .height = 480}, 10), ::testing::IsEmpty());
  EXPECT_THAT(notes("crt", {.width = 640, .height = 480}, 7),
              ::testing::ElementsAre(::testing::HasSubstr("columns per triad")));
  EXPECT_THAT(notes("crt", {.width = 1280, .height = 1024}, 20),
              ::testing::ElementsAre(::testing::HasSubstr("1280 columns, 9.1056 % more than")));
  EXPECT_THAT(notes("crt:mask=none", {.width = 640, .height = 480}, 4),
              ::testing::ElementsAre(::testing::HasSubstr("rows per scan line")));
  EXPECT_THAT(notes("lcd", {.width = 640, .height = 480}, 4),
              ::testing::ElementsAre(::testing::HasSubstr("pixels per pixel of the panel")));
}

}  // namespace
}  // namespace tessera::screen_bits_test
