#include "framebuffer/prefetch_lines.h"

// PREFETCHW needs a target attribute. x86-64 CPUs without it execute it as a NOP, except a few from 2004.
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
