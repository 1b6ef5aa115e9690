#include "framebuffer/bitplane.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <utility>

namespace tessera::detail::bitplane_test {
namespace {

/// Number of set bits in a row of a plane, padding included.
int bits_in_row(const BitplaneStack& stack, int k, int y) {
  int count = 0;
  for (std::ptrdiff_t i = 0; i < stack.stride_bytes(); ++i)
    count += __builtin_popcount(stack.plane(k)[y * stack.stride_bytes() + i]);
  return count;
}

TEST(Bitplane, TakesNoMemoryUntilItIsAllocated) {
  BitplaneStack stack(640, 480, 24);
  EXPECT_FALSE(stack.allocated());
  EXPECT_EQ(stack.bytes(), 0u);
  stack.allocate(0);
  EXPECT_TRUE(stack.allocated());
  EXPECT_GE(stack.bytes(), 640u * 480 * 24 / 8);
  EXPECT_LT(stack.bytes(), 1024u * 480 * 24 / 8 + 24 * 64 + 1);
  stack.release();
  EXPECT_FALSE(stack.allocated());
  EXPECT_EQ(stack.bytes(), 0u);
}

TEST(Bitplane, RowsArePaddedToCacheLinesAndPlanesTakeAnOddNumberOfThem) {
  for (int width : {1, 511, 512, 513, 1920, 2048}) {
    BitplaneStack stack(width, 4, 3);
    stack.allocate(0);
    EXPECT_EQ(stack.stride_bytes(), (width + 511) / 512 * 64) << width;
    EXPECT_EQ(stack.plane_stride_bytes() / 64 % 2, 1u) << width;
    EXPECT_GE(stack.plane_stride_bytes(), 4u * static_cast<std::size_t>(stack.stride_bytes())) << width;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(stack.plane(k)) % 64, 0u) << width;
  }
}

TEST(Bitplane, Bit7IsTheLeftmostPixelAndRow0IsTheTop) {
  BitplaneStack stack(20, 3, 2);
  stack.allocate(0);
  stack.set_pixel(0, 0, 1);
  stack.set_pixel(9, 2, 3);
  EXPECT_EQ(stack.plane(0)[0], 0x80);
  EXPECT_EQ(stack.plane(1)[0], 0x00);
  EXPECT_EQ(stack.plane(0)[2 * stack.stride_bytes() + 1], 0x40);
  EXPECT_EQ(stack.plane(1)[2 * stack.stride_bytes() + 1], 0x40);
  EXPECT_EQ(stack.pixel(9, 2), 3u);
  stack.set_pixel(9, 2, 2);
  EXPECT_EQ(stack.pixel(9, 2), 2u);
  EXPECT_EQ(stack.pixel(8, 2), 0u);
  EXPECT_EQ(stack.pixel(10, 2), 0u);
}

TEST(Bitplane, FillSetsEveryPixelAndNoPadBit) {
  for (int width : {1, 7, 8, 9, 63, 512, 515}) {
    BitplaneStack stack(width, 5, 32);
    stack.allocate(0xffffffffu);
    for (int k = 0; k < 32; ++k)
      for (int y = 0; y < 5; ++y) ASSERT_EQ(bits_in_row(stack, k, y), width) << k << " " << y;
    stack.fill(0x80000005u);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < width; ++x) ASSERT_EQ(stack.pixel(x, y), 0x80000005u);
      for (int k = 0; k < 32; ++k)
        ASSERT_EQ(bits_in_row(stack, k, y), (0x80000005u >> k & 1) != 0 ? width : 0);
    }
  }
}

TEST(Bitplane, FillRowsKeepsOtherRows) {
  BitplaneStack stack(30, 6, 8);
  stack.allocate(0x11);
  stack.fill_rows(2, 4, 0xee);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 30; ++x) EXPECT_EQ(stack.pixel(x, y), y == 2 || y == 3 ? 0xeeu : 0x11u) << y;
}

TEST(Bitplane, BitsBeyondThePlanesAreIgnored) {
  BitplaneStack stack(3, 3, 5);
  EXPECT_EQ(stack.value_mask(), 31u);
  EXPECT_EQ(BitplaneStack(3, 3, 32).value_mask(), 0xffffffffu);
  EXPECT_EQ(BitplaneStack(3, 3, 0).value_mask(), 0u);
  stack.allocate(0xffffffffu);
  EXPECT_EQ(stack.pixel(1, 1), 31u);
}

TEST(Bitplane, SecondAllocateKeepsContent) {
  BitplaneStack stack(3, 3, 5);
  stack.allocate(9);
  stack.allocate(0);
  EXPECT_EQ(stack.pixel(2, 2), 9u);
}

TEST(Bitplane, StackWithoutPlanesIsNeverAllocated) {
  BitplaneStack stack(3, 3, 0);
  stack.allocate(0);
  EXPECT_FALSE(stack.allocated());
}

TEST(Bitplane, MoveTransfersMemory) {
  BitplaneStack from(10, 10, 4);
  from.allocate(6);
  const BitplaneStack to = std::move(from);
  EXPECT_EQ(to.pixel(9, 9), 6u);
  EXPECT_FALSE(from.allocated());  // NOLINT: the moved-from state is under test
}

// The allocators of the sanitizers terminate the program instead of throwing.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Bitplane, AllocateThrowsBadAllocAndStaysUnallocated) {
  const int max = std::numeric_limits<int>::max();
  BitplaneStack stack(max, max, 32);  // 18 exabytes
  EXPECT_THROW(stack.allocate(0), std::bad_alloc);
  EXPECT_FALSE(stack.allocated());
}
#endif

}  // namespace
}  // namespace tessera::detail::bitplane_test
