#include "engine/program/cli/output.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

#include "engine/program/cli/standard_output.h"

namespace tessera::program::cli {
namespace {

constexpr std::string_view kFrame = "{frame}";

int terminal_columns() {
  winsize size{};
  constexpr int kDefaultColumns = 80;
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kDefaultColumns;
}

using Mean = std::array<int, 3>;

// Mean colour of the pixels from (x0, y0) up to, but not including, (x1, y1).
Mean mean_of(const Picture& picture, int x0, int y0, int x1, int y1) {
  std::array<long long, 3> sum{};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                    static_cast<std::size_t>(x)) +
                               c];
  const long long count = static_cast<long long>(x1 - x0) * (y1 - y0);
  return {static_cast<int>((sum[0] + count / 2) / count), static_cast<int>((sum[1] + count / 2) / count),
          static_cast<int>((sum[2] + count / 2) / count)};
}

std::string color_code(const char* layer, const Mean& c) {
  return std::string("\x1b[") + layer + ";2;" + std::to_string(c[0]) + ";" + std::to_string(c[1]) + ";" +
         std::to_string(c[2]) + "m";
}

}  // namespace

bool is_stream(const std::string& path) { return path == "-" || path == "term"; }

bool names_frames(const std::string& path) { return path.find(kFrame) != std::string::npos; }

std::string frame_path(const std::string& path, int frame, int frames) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames - 1).size());
  std::string number = std::to_string(frame);
  number.insert(0, digits - std::min(digits, number.size()), '0');
  std::string result = path;
  for (std::size_t at = 0; (at = result.find(kFrame, at)) != std::string::npos; at += number.size())
    result.replace(at, kFrame.size(), number);
  return result;
}

void write_output(const Picture& picture, const std::string& path, int compression) {
  if (path == "-") return write_to_stdout(encode_ppm(picture));
  const char* const no_color = std::getenv("NO_COLOR");
  const bool colored = no_color == nullptr || *no_color == '\0';
  if (path == "term") return write_to_stdout(terminal_text(picture, terminal_columns(), colored));
  write_picture(picture, path, compression);
}

std::string terminal_text(const Picture& picture, int columns, bool colored) {
  // A character cell is about twice as high as wide and shows two pixels.
  const int width = std::clamp(columns, 1, picture.width);
  const int rows =
      std::max(1, static_cast<int>((static_cast<long long>(picture.height) * width + picture.width) /
                                   (2LL * picture.width)));
  constexpr std::string_view kDensity = " .:-=+*#%@";
  const auto mean = [&](int column, int half_row) {
    const auto edge = [](int i, int n, int pixels) {
      return static_cast<int>(static_cast<long long>(i) * pixels / n);
    };
    const int x0 = edge(column, width, picture.width);
    const int y0 = edge(half_row, 2 * rows, picture.height);
    return mean_of(picture, x0, y0, std::max(x0 + 1, edge(column + 1, width, picture.width)),
                   std::max(y0 + 1, edge(half_row + 1, 2 * rows, picture.height)));
  };
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < width; ++column) {
      const Mean upper = mean(column, 2 * row);
      const Mean lower = mean(column, 2 * row + 1);
      if (colored) {
        text += color_code("38", upper) + color_code("48", lower) + "\xe2\x96\x80";  // upper half block
      } else {
        const int gray =
            (30 * (upper[0] + lower[0]) + 59 * (upper[1] + lower[1]) + 11 * (upper[2] + lower[2])) / 200;
        text += kDensity[static_cast<std::size_t>(gray) * kDensity.size() / 256];
      }
    }
    text += colored ? "\x1b[0m\n" : "\n";
  }
  return text;
}

}  // namespace tessera::program::cli
