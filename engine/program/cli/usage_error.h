// Wrong usage that is found while a command runs.
#pragma once

#include "engine/tessera/types.hpp"

namespace tessera::program::cli {

/// Options that contradict each other or the input, or that have no effect. The program exits with 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace tessera::program::cli
