// Frame buffers in memory owned by the caller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/engine/frame/api_random_frame.h"

namespace tessera::caller_memory_test {
namespace {

using namespace test;

struct Memory {
  std::vector<std::byte> bytes;
  explicit Memory(std::size_t size) : bytes(size + 128, std::byte{0xcd}) {}
  std::span<std::byte> span(std::size_t size) {
    void* at = bytes.data();
    std::size_t space = bytes.size();
    return {static_cast<std::byte*>(std::align(64, size, at, space)), size};
  }
};

// Bit for bit: the contents and the address of plane().
void expect_planes_in(const FrameBuffer& buffer, std::span<std::byte> memory) {
  for (const Buffer which : {Buffer::color, Buffer::depth, Buffer::stencil})
    for (int k = 0; k < buffer.plane_count(which); ++k) {
      const PlaneView plane = buffer.plane(which, k);
      const auto* at = reinterpret_cast<const std::byte*>(plane.bits);
      EXPECT_TRUE(at >= memory.data() &&
                  at + plane.stride_bytes * plane.height <= memory.data() + memory.size());
    }
}

TEST(CallerMemory, HoldsTheSameBits) {
  for (const FrameBufferFormat& format :
       {FrameBufferFormat{.width = 133, .height = 71},
        FrameBufferFormat{
            .width = 64, .height = 33, .color_bits = 9, .depth = DepthFormat::float32, .stencil_bits = 3},
        FrameBufferFormat{
            .width = 50, .height = 40, .color_bits = 1, .depth = DepthFormat::none, .stencil_bits = 0}}) {
    const RandomFrame scene(format, 200);
    Renderer renderer({.threads = 2});
    FrameBuffer own(format);
    const std::size_t size = FrameBuffer::memory_bytes(format);
    Memory memory(size);
    FrameBuffer lent(format, memory.span(size));
    expect_planes_in(lent, memory.span(size));
    EXPECT_EQ(fingerprint(own), fingerprint(lent)) << "new buffer";
    for (FrameBuffer* buffer : {&own, &lent}) {
      Frame frame(*buffer);
      if (format.depth != DepthFormat::none) scene.record(frame);
      else frame.draw(scene.triangles.view(), unlit({1, 1, 1, 1}));
      renderer.finish(frame);
    }
    EXPECT_EQ(fingerprint(own), fingerprint(lent));
    expect_planes_in(lent, memory.span(size));
    FrameBuffer moved = std::move(lent);
    EXPECT_EQ(fingerprint(own), fingerprint(moved));
  }
}

TEST(CallerMemory, ClearsAreVisibleAtOnce) {
  const FrameBufferFormat format{
      .width = 16, .height = 4, .color_bits = 2, .depth = DepthFormat::none, .stencil_bits = 1};
  const std::size_t size = FrameBuffer::memory_bytes(format);
  Memory memory(size);
  FrameBuffer buffer(format, memory.span(size));
  const auto ones = [&] {
    return std::count_if(memory.span(size).begin(), memory.span(size).end(),
                         [](std::byte b) { return b == std::byte{0xff}; });
  };
  EXPECT_EQ(ones(), 0) << "new: colour 0, stencil 0";
  Renderer renderer({.threads = 1});
  Frame frame(buffer);
  frame.clear({.color = Color{1, 1, 1, 1}, .stencil = 1u});
  renderer.finish(frame);
  EXPECT_EQ(ones(), 3 * 4 * 2) << "three planes of four rows of two bytes";
}

TEST(CallerMemory, SizeAndAddressAreChecked) {
  const FrameBufferFormat format{.width = 100, .height = 50};
  const std::size_t size = FrameBuffer::memory_bytes(format);
  Memory memory(size);
  EXPECT_THAT(error_of([&] { FrameBuffer(format, memory.span(size - 1)); }).value_or(""),
              testing::HasSubstr("needs " + std::to_string(size)));
  Memory odd(size + 64);
  EXPECT_THAT(error_of([&] {
                FrameBuffer(format, {odd.span(size + 64).data() + 8, size});
              }).value_or(""),
              testing::HasSubstr("multiple of 64"));
  EXPECT_THAT(error_of([&] { FrameBuffer::memory_bytes({.width = 0}); }).value_or(""),
              testing::HasSubstr("width is 0"));
}

}  // namespace
}  // namespace tessera::caller_memory_test
