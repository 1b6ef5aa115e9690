// Fixed palettes of colour-index buffers, and the search for the nearest entry.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace tessera::reference {

/// @param name  bw | gray | ega16 | vga256 | web216
/// @param bits  index bits of the buffer; `gray` has 2^bits entries
/// @throws std::runtime_error for another name or a palette of more than 2^bits entries.
std::vector<Rgb8> named_palette(const std::string& name, int bits);

/// bw at 1 bit, greys at 2 and 3, ega16 at 4 to 7, vga256 at 8 and more.
std::vector<Rgb8> default_palette(int bits);

/// Finds the nearest entry: least squared distance of the stored values / 255, ties to the lowest index.
/// Unset entries are ignored.
class NearestEntry {
 public:
  explicit NearestEntry(const std::vector<Rgb8>& palette);

  /// @param color  components 0..1
  std::uint32_t operator()(Vec3 color) const;

 private:
  struct Entry {
    Vec3 color;
    std::uint32_t index;
  };
  std::vector<Entry> distinct_;  // each colour once, with its lowest index
};

}  // namespace tessera::reference
