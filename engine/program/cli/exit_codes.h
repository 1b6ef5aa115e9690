// Exit codes of all programs. README.md and the manual page have the same table.
#pragma once

namespace tessera::program::cli {

inline constexpr int kFailed = 1;
inline constexpr int kBadUsage = 2;
inline constexpr int kDiffers = 3;  ///< also: the self-test failed, a workload is slower than before
inline constexpr int kInterrupted = 130;

}  // namespace tessera::program::cli
