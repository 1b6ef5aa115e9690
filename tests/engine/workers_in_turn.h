// Workers that run one after the other on the caller's thread, so that the first of them finds all the tasks.
#pragma once

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

class WorkersInTurn : public Executor {
 public:
  /// @param begins  the first of them; the others follow it
  explicit WorkersInTurn(int count, int begins = 0) : first(begins), count_(count) {}
  int workers() const noexcept override { return count_; }
  void run(int count, void (*work)(void*, int), void* context) override {
    for (int k = 0; k < count; ++k) work(context, (first + k) % count);
  }

  int first;

 private:
  int count_;
};

}  // namespace tessera::test
