#include "engine/program/cli/compare_command.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "engine/program/cli/file_guard.h"
#include "engine/program/cli/formatted.h"
#include "engine/program/compare/magma.h"
#include "engine/program/compare/picture_errors.h"

namespace tessera::program::cli {
namespace {

struct Comparison {
  int width = 0, height = 0;
  PictureErrors levels;
  std::optional<int> largest_alpha;  ///< largest difference of alpha; absent: neither file has alpha
  double pixels_per_degree = 0;
  FlipErrors flip;
};

/// Files without alpha count as opaque.
std::optional<int> largest_alpha_error(const Picture& a, const Picture& b) {
  const auto has_alpha = [](const Picture& picture) { return picture.channels % 2 == 0; };
  if (!has_alpha(a) && !has_alpha(b)) return std::nullopt;
  int largest = 0;
  for (std::size_t i = 3; i < a.rgba.size(); i += 4)
    largest = std::max(largest, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
  return largest;
}

std::string comparison_text(const Comparison& comparison) {
  const PictureErrors& levels = comparison.levels;
  const auto pixels_over = [&levels](int threshold) {
    return std::to_string(levels.pixels_over(threshold)) + " of " + std::to_string(levels.pixels) +
           formatted(" (%.4f %%)", 100 * levels.share_over(threshold));
  };
  std::string text;
  const auto add = [&text](std::string label, const std::string& value) {
    label.resize(24, ' ');
    text += label + value + "\n";
  };
  add("size", std::to_string(comparison.width) + "x" + std::to_string(comparison.height));
  add("largest error", std::to_string(levels.largest) + " of 255 levels");
  add("RMS error", formatted("%.6f levels", levels.rms));
  add("PSNR", std::isinf(levels.psnr_db) ? "inf" : formatted("%.4f dB", levels.psnr_db));
  add("more than 1 level off", pixels_over(1));
  add("more than 2 levels off", pixels_over(2));
  if (comparison.largest_alpha)
    add("largest error of alpha", std::to_string(*comparison.largest_alpha) + " of 255 levels");
  add("FLIP, mean",
      formatted("%.6f at %.2f pixels per degree", comparison.flip.mean, comparison.pixels_per_degree));
  add("FLIP, 99th percentile", formatted("%.6f", comparison.flip.percentile_99));
  add("FLIP, largest", formatted("%.6f", comparison.flip.largest));
  return text;
}

std::string comparison_json(const Comparison& comparison) {
  const PictureErrors& levels = comparison.levels;
  nlohmann::ordered_json json{{"width", comparison.width},
                              {"height", comparison.height},
                              {"largest", levels.largest},
                              {"rms", levels.rms},
                              {"psnr_db", nullptr},
                              {"pixels_over_1", levels.pixels_over(1)},
                              {"pixels_over_2", levels.pixels_over(2)},
                              {"share_over_1", levels.share_over(1)},
                              {"share_over_2", levels.share_over(2)},
                              {"largest_alpha", nullptr},
                              {"flip",
                               {{"pixels_per_degree", comparison.pixels_per_degree},
                                {"mean", comparison.flip.mean},
                                {"percentile_99", comparison.flip.percentile_99},
                                {"largest", comparison.flip.largest}}}};
  if (std::isfinite(levels.psnr_db)) json["psnr_db"] = levels.psnr_db;
  if (comparison.largest_alpha) json["largest_alpha"] = *comparison.largest_alpha;
  return json.dump(2) + "\n";
}

void require_same_size(const Picture& a, const Picture& b, const CompareRequest& request) {
  const auto size_of = [](const Picture& picture, const std::string& name) {
    return "\"" + name + "\" is " + std::to_string(picture.width) + "x" + std::to_string(picture.height);
  };
  if (a.width != b.width || a.height != b.height)
    throw Error(size_of(a, request.pictures[0]) + ", " + size_of(b, request.pictures[1]) +
                "; both must have the same size");
}

}  // namespace

int compare(const CompareRequest& request) {
  if (!request.map.empty()) {
    for (const std::string& picture : request.pictures)
      refuse_overwriting(request.map, picture, "input", "--map");
    require_writable_picture(request.map);
  }
  const Picture a = read_picture(request.pictures[0]);
  const Picture b = read_picture(request.pictures[1]);
  require_same_size(a, b, request);
  const Comparison comparison{
      .width = a.width,
      .height = a.height,
      .levels = picture_errors(pixels_of(a), pixels_of(b)),
      .largest_alpha = largest_alpha_error(a, b),
      .pixels_per_degree = request.pixels_per_degree,
      .flip = flip_errors(pixels_of(a), pixels_of(b),
                          {.pixels_per_degree = request.pixels_per_degree, .threads = request.threads})};
  if (!request.map.empty()) write_picture(magma_picture(comparison.flip.map, a.width, a.height), request.map);
  std::cout << (request.json ? comparison_json(comparison) : comparison_text(comparison));
  return 0;
}

}  // namespace tessera::program::cli
