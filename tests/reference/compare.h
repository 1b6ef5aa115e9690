// Comparison of a picture with the reference, and picture files for inspection.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tessera::reference {

/// A pixel is interior if the reference's 3x3 pixels around it (within the picture) span less than this in
/// every channel.
inline constexpr int kInteriorSpan = 24;
/// A pixel differs if the difference of a channel exceeds this number of levels.
inline constexpr int kTolerance = 2;

struct Counts {
  std::int64_t pixels = 0;
  std::int64_t differing = 0;
  int largest = 0;  ///< largest difference of a channel, in levels

  double share() const {
    return pixels == 0 ? 0 : static_cast<double>(differing) / static_cast<double>(pixels);
  }
};

struct Comparison {
  Counts all;
  Counts interior;
};

/// @param reference, other  width * height * 3 bytes, rows from the top.
/// @throws std::runtime_error if a size is wrong.
Comparison compare(std::span<const std::uint8_t> reference, std::span<const std::uint8_t> other, int width_px,
                   int height_px);

/// One line of text: counts, shares and largest differences.
std::string to_string(const Comparison& comparison);

/// Absolute difference of every channel, times `gain`, at most 255.
std::vector<std::uint8_t> difference(std::span<const std::uint8_t> reference,
                                     std::span<const std::uint8_t> other, int gain = 16);

/// A binary portable pixmap (P6).
/// @throws std::runtime_error if the file cannot be written.
void write_ppm(const std::string& path, std::span<const std::uint8_t> rgb, int width_px, int height_px);

/// Writes <stem>_reference.ppm, <stem>_other.ppm and <stem>_difference.ppm.
void write_pictures(const std::string& stem, std::span<const std::uint8_t> reference,
                    std::span<const std::uint8_t> other, int width_px, int height_px);

}  // namespace tessera::reference
