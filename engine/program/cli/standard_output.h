// Writes to the standard output with errors reported.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <string_view>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {

/// Writes and flushes a text.
/// @throws Error if that fails, for example on a full disk
inline void write_to_stdout(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(std::string("cannot write to the standard output: ") + std::strerror(errno));
}

/// Flushes stdout.
/// @throws Error if that or an earlier write failed; the reason of an earlier failure is no longer known
inline void require_stdout_written() {
  write_to_stdout("");
  if (std::ferror(stdout) != 0 || !std::cout) throw Error("cannot write to the standard output");
}

}  // namespace tessera::program::cli
