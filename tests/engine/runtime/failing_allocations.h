// Makes the n-th allocation fail, for each n in turn, and counts allocated bytes. The operators new and
// delete that do it are in out_of_memory_test.cpp.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <string>

#include "engine/tessera/tessera.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // sanitizers replace the allocator
#define TESSERA_CAN_FAIL_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TESSERA_CAN_FAIL_ALLOCATIONS 0
#else
#define TESSERA_CAN_FAIL_ALLOCATIONS 1
#endif
#else
#define TESSERA_CAN_FAIL_ALLOCATIONS 1
#endif

#if TESSERA_CAN_FAIL_ALLOCATIONS

namespace tessera::test {

/// Number of allocations, on any thread, that succeed before one fails; negative: no limit.
extern std::atomic<long> allocations_left;
/// Bytes allocated now, as rounded up by the allocator.
extern std::atomic<long> live_bytes;
/// Maximum of live_bytes since it was last set.
extern std::atomic<long> peak_live_bytes;

inline void refuse_lost(int at) { ADD_FAILURE() << "allocation " << at << " was ignored"; }

/// Runs `act` with each of its allocations failing in turn, until a run needs no more. `after_failure` then
/// checks the remaining state; `after_loss` is called if `act` succeeded without the allocation. Returns the
/// number of allocations.
template <class Act, class AfterFailure, class AfterLoss = void (*)(int)>
int fail_every_allocation(const Act& act, const AfterFailure& after_failure,
                          const AfterLoss& after_loss = refuse_lost) {
  for (int at = 0; at < 100000; ++at) {
    allocations_left = at;
    std::string message;
    bool failed = false;
    try {
      act();
    } catch (const Error& error) {
      allocations_left = -1;
      failed = true;
      message = error.what();
      EXPECT_EQ(error.code(), ErrorCode::out_of_memory) << message;
    } catch (const std::bad_alloc&) {
      allocations_left = -1;
      failed = true;
      message = "(a bare bad_alloc)";
    }
    const bool was_spent = allocations_left < 0;
    allocations_left = -1;
    if (!failed && !was_spent) return at;
    if (failed) {
      EXPECT_THAT(message, testing::HasSubstr("memory")) << "allocation " << at;
      EXPECT_THAT(message, testing::Not(testing::HasSubstr("bare"))) << "allocation " << at;
      after_failure(at);
    } else {
      after_loss(at);
    }
    if (testing::Test::HasFailure()) return at;
  }
  return -1;
}

}  // namespace tessera::test

#endif
