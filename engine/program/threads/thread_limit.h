// Process-wide thread settings. They belong to programs and tests; the library never changes them.
#pragma once

#include <memory>

namespace tessera::program {

/// Returns the number of cores that the process may use, at least 1.
int available_cores();

/// Lets oneTBB run more threads than the process has cores, while the object lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace tessera::program
