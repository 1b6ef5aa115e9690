// Runs `tessera bench` with small frames.
#pragma once

#include "tests/engine/program/program.h"

namespace tessera {

class BenchProgram : public Program {
 protected:
  /// The fills in small frames, two each. Options may follow.
  static constexpr const char* kQuick = "bench fill --size 64x48 --repeats 2 --seconds 0.001 ";
};

}  // namespace tessera
