// The code of each kind of error.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/engine/frame/api_support.h"

namespace tessera::error_codes_test {
namespace {

using namespace test;

std::optional<ErrorCode> code_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.code();
  }
  return std::nullopt;
}

const FrameBufferFormat kNoDepth{.width = 8, .height = 8, .depth = DepthFormat::none, .stencil_bits = 0};

TEST(ErrorCodes, ValuesOutOfRangeAreInvalidArguments) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  EXPECT_EQ(code_of([&] { FrameBuffer({.width = 0}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { frame.clear({.depth = 2.0}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { (void)frame.effects(0); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { Renderer({.tile_size = 5}); }), ErrorCode::invalid_argument);
  const std::array<Light, 2> lights{Light{}, Light{.spot_cutoff = 120}};
  EXPECT_EQ(code_of([&] { frame.set_lights(lights); }), ErrorCode::invalid_argument);
}

TEST(ErrorCodes, BuffersThatTheFormatLacksAreIncompatible) {
  FrameBuffer buffer(kNoDepth);
  Frame frame(buffer);
  EXPECT_EQ(code_of([&] { frame.clear({.depth = 1.0}); }), ErrorCode::incompatible_format);
  EXPECT_EQ(code_of([&] { frame.clear({.stencil = 1}); }), ErrorCode::incompatible_format);
  EXPECT_EQ(code_of([&] { frame.clear({.index = 1}); }), ErrorCode::incompatible_format);
  EXPECT_EQ(code_of([&] { frame.accumulate({}); }), ErrorCode::incompatible_format);
  EXPECT_EQ(code_of([&] { buffer.set_palette({}); }), ErrorCode::incompatible_format);
  std::vector<float> depth(64);
  EXPECT_EQ(code_of([&] { buffer.read_depth(depth); }), ErrorCode::incompatible_format);
  const MeshData mesh = whole_window();
  EXPECT_EQ(code_of([&] { frame.draw(mesh.view(), {.stencil = StencilState{}}); }),
            ErrorCode::incompatible_format);
}

TEST(ErrorCodes, LostBuffersAndMovedObjectsAreInvalidStates) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Renderer renderer({.threads = 1});
  Frame frame(buffer);
  const MeshData mesh = whole_window();
  frame.draw(mesh.view());
  frame.keep({});
  renderer.finish(frame);
  std::vector<float> depth(64);
  EXPECT_EQ(code_of([&] { buffer.read_depth(depth); }), ErrorCode::invalid_state);
  frame.draw(mesh.view());
  EXPECT_EQ(code_of([&] { renderer.finish(frame); }), ErrorCode::invalid_state);
  const Frame moved = std::move(frame);
  EXPECT_EQ(code_of([&] { renderer.finish(frame); }), ErrorCode::invalid_state);
}

TEST(ErrorCodes, AStoppedFrameIsCancelled) {
  FrameBuffer buffer({.width = 8, .height = 8});
  Frame frame(buffer);
  frame.clear({.color = Color{}});
  const MeshData mesh = whole_window();
  frame.draw(mesh.view());
  Renderer renderer({.threads = 1, .progress = [](double) { return false; }});
  EXPECT_EQ(code_of([&] { renderer.finish(frame); }), ErrorCode::cancelled);
}

class IdleExecutor : public Executor {
 public:
  int workers() const noexcept override { return 2; }
  void run(int, void (*)(void*, int), void*) override {}
};

TEST(ErrorCodes, ExecutorsThatSkipWorkFail) {
  FrameBuffer buffer({.width = 64, .height = 64});
  Frame frame(buffer);
  frame.clear({.color = Color{}});
  const MeshData mesh = whole_window();
  frame.draw(mesh.view());
  Renderer renderer({.tile_size = 32, .executor = std::make_shared<IdleExecutor>()});
  EXPECT_EQ(code_of([&] { renderer.finish(frame); }), ErrorCode::executor_failure);
}

TEST(ErrorCodes, AMessageAloneIsAnInvalidArgument) {
  EXPECT_EQ(Error("text").code(), ErrorCode::invalid_argument);
  EXPECT_EQ(Cancelled("text").code(), ErrorCode::cancelled);
  const Error error(ErrorCode::unsupported, "text");
  EXPECT_EQ(error.code(), ErrorCode::unsupported);
  EXPECT_STREQ(error.what(), "text");
}

}  // namespace
}  // namespace tessera::error_codes_test
