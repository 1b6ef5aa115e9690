#include "shading/fragment_ops.h"

#include "framebuffer/check.h"

namespace tessera::detail {

void set_dither(FragmentOps& ops, int n, int frame_height) {
  TESSERA_ASSERT(n == 1 || n == 2 || n == 4 || n == 8);
  int pattern[kDitherSize][kDitherSize] = {};
  for (int size = 1; size < n; size *= 2)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const int first = 4 * pattern[y][x];
        pattern[y][x] = first;
        pattern[y][x + size] = first + 2;
        pattern[y + size][x] = first + 3;
        pattern[y + size][x + size] = first + 1;
      }
  ops.dither = n > 1;
  for (int y = 0; y < kDitherSize; ++y)
    for (int x = 0; x < kDitherSize; ++x) {
      const int from_below = ((frame_height - 1 - y) % kDitherSize + kDitherSize) % kDitherSize;
      ops.threshold[y][x] =
          (static_cast<float>(pattern[from_below % n][x % n]) + 0.5f) / static_cast<float>(n * n);
    }
}

}  // namespace tessera::detail
