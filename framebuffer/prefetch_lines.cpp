#include "framebuffer/prefetch_lines.h"

// To fetch for writing is an instruction of its own, which 64-bit processors of x86 without it pass over, but
// for some of 2004.
#if defined(__x86_64__)
#define TESSERA_PREFETCHW_TARGET [[gnu::target("prfchw")]]
#else
#define TESSERA_PREFETCHW_TARGET
#endif

namespace tessera::detail {

TESSERA_PREFETCHW_TARGET void prefetch_lines(const std::uint8_t* first_row, std::ptrdiff_t stride_bytes,
                                             int bytes, int rows) noexcept {
  constexpr std::uintptr_t kLineBytes = 64;
  for (int y = 0; y < rows; ++y) {
    const auto row = reinterpret_cast<std::uintptr_t>(first_row + y * stride_bytes);
    for (std::uintptr_t line = row / kLineBytes * kLineBytes; line < row + static_cast<std::uintptr_t>(bytes);
         line += kLineBytes)
      __builtin_prefetch(reinterpret_cast<const void*>(line), 1);
  }
}

}  // namespace tessera::detail
