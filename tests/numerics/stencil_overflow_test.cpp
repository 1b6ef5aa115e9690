// Stencil buffers of 1 to 8 bits at the ends of their range: every operation on every value, saturating or
// wrapping, under write masks; and counts that pass the ends many times.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/engine/frame/api_support.h"

namespace tessera::test::stencil_overflow_test {
namespace {

constexpr StencilOp kOps[] = {StencilOp::keep, StencilOp::zero,   StencilOp::replace,   StencilOp::incr,
                              StencilOp::decr, StencilOp::invert, StencilOp::incr_wrap, StencilOp::decr_wrap};
constexpr std::uint32_t kReferences[] = {0, 1, 5, 200, 0xffffffff},
                        kMasks[] = {0xff, 0, 0x55, 0xaa, 0x0f, 0xffffff80};

// The header's definition in plain integers: the reference is clamped to the largest value, masks to the bits
// of the buffer.
std::uint32_t after(StencilOp op, std::uint32_t stored, std::uint32_t reference, std::uint32_t write_mask,
                    int bits) {
  const std::uint32_t most = (1u << bits) - 1;
  const auto value = [&]() -> std::uint32_t {
    switch (op) {
      case StencilOp::keep: return stored;
      case StencilOp::zero: return 0;
      case StencilOp::replace: return std::min(reference, most);
      case StencilOp::incr: return std::min(stored + 1, most);
      case StencilOp::decr: return stored == 0 ? 0 : stored - 1;
      case StencilOp::invert: return most - stored;
      case StencilOp::incr_wrap: return (stored + 1) % (most + 1);
      case StencilOp::decr_wrap: return (stored + most) % (most + 1);
    }
    return 0;
  }();
  return (stored & ~write_mask) | (value & write_mask & most);
}

bool passes(Compare func, std::uint32_t a, std::uint32_t b) {
  const bool results[] = {false, a<b, a == b, a <= b, a> b, a != b, a >= b, true};
  return results[static_cast<int>(func)];
}

enum class Outcome { fails, fails_depth, passes };
enum class Drawn { triangles, points, lines, bitmap };

/// Columns hold the values 0, 1, 2, ... of the buffer, repeated. Each row has its own draw.
class Rows {
 public:
  Rows(int bits, int samples, int rows)
      : bits_(bits),
        buffer_({.width = kWidth, .height = rows, .stencil_bits = bits, .samples = samples}),
        frame_(buffer_) {
    for (int x = 0; x < kWidth; ++x)
      frame_.clear({.depth = 0.5, .stencil = stored(x), .scissor = Rect{x, 0, 1, rows}});
    frame_.clear({.color = Color{0, 0, 0, 1}});
  }
  static constexpr int kWidth = 256;
  std::uint32_t stored(int x) const { return static_cast<std::uint32_t>(x) % (1u << bits_); }

  /// Draws row `y`, counted from below.
  void draw(int y, const StencilFace& face, Outcome outcome, Drawn drawn, bool back) {
    DrawState state = unlit({1, 1, 1, 1});
    state.stencil.emplace();
    (back ? state.stencil->back.emplace() : state.stencil->front) = face;
    state.depth.test = outcome == Outcome::fails_depth ? Compare::never : Compare::always;
    state.scissor = Rect{0, y, kWidth, 1};
    state.front_face = back ? FrontFace::cw : FrontFace::ccw;
    state.line_width = state.point_size = 2 * kWidth;
    if (drawn == Drawn::bitmap) {
      static const std::vector<std::uint8_t> bits(kWidth / 8, 0xff);
      frame_.draw_bitmap(
          {.bits = bits.data(), .width = kWidth, .height = 1, .x = 0, .y = static_cast<double>(y)},
          {.depth = state.depth, .stencil = state.stencil, .scissor = state.scissor});
      return;
    }
    static const MeshData all = whole_window();
    static const MeshData point = of(Primitive::points, {0, 0, 0});
    static const MeshData line = of(Primitive::lines, {-1, 0, 0, 1, 0, 0});
    const MeshData& small = drawn == Drawn::points ? point : line;
    frame_.draw((drawn == Drawn::triangles ? all : small).view(), state);
  }
  void finish() {
    Renderer({.threads = 1}).finish(frame_);
    values_ = stencil_values(buffer_);
    words_ = packed_colors(buffer_);
  }
  std::uint32_t value(int x, int y) const { return values_[at(x, y)]; }
  bool is_drawn(int x, int y) const { return words_[at(x, y)] != 0; }

 private:
  static MeshData of(Primitive primitive, std::vector<float> positions) {
    MeshData mesh;
    mesh.primitive = primitive;
    mesh.positions = std::move(positions);
    return mesh;
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>((buffer_.format().height - 1 - y) * kWidth + x);
  }

  int bits_;
  FrameBuffer buffer_;
  Frame frame_;
  std::vector<std::uint8_t> values_;
  std::vector<std::uint32_t> words_;
};

TEST(StencilOverflow, EveryOperationOnEveryValueOfEveryWidth) {
  struct Row {
    StencilOp op;
    std::uint32_t reference;
    std::uint32_t write_mask;
  };
  std::vector<Row> rows;
  for (const StencilOp op : kOps)
    for (const std::uint32_t mask : kMasks)
      rows.push_back({op, kReferences[rows.size() % std::size(kReferences)], mask});
  for (const std::uint32_t reference : kReferences) rows.push_back({StencilOp::replace, reference, 0xff});
  int turn = 0;
  for (int bits = 1; bits <= 8; ++bits)
    for (const int samples : {1, 4, 8})
      for (const Outcome outcome : {Outcome::fails, Outcome::fails_depth, Outcome::passes})
        for (const bool back : {false, true}) {
          // Primitives without a facing count as front.
          const Drawn drawn = back ? Drawn::triangles : static_cast<Drawn>(turn++ % 4);
          Rows buffer(bits, samples, static_cast<int>(rows.size()));
          for (std::size_t y = 0; y < rows.size(); ++y) {
            StencilFace face{.func = outcome == Outcome::fails ? Compare::never : Compare::always,
                             .ref = rows[y].reference,
                             .mask = 0,
                             .write_mask = rows[y].write_mask};
            // The operations of the other two outcomes would leave another value, so the test detects them.
            const StencilOp other = rows[y].op == StencilOp::zero ? StencilOp::invert : StencilOp::zero;
            face.fail = outcome == Outcome::fails ? rows[y].op : other;
            face.zfail = outcome == Outcome::fails_depth ? rows[y].op : other;
            face.zpass = outcome == Outcome::passes ? rows[y].op : other;
            buffer.draw(static_cast<int>(y), face, outcome, drawn, back);
          }
          buffer.finish();
          for (std::size_t y = 0; y < rows.size(); ++y)
            for (int x = 0; x < Rows::kWidth; ++x)
              ASSERT_EQ(buffer.value(x, static_cast<int>(y)),
                        after(rows[y].op, buffer.stored(x), rows[y].reference, rows[y].write_mask, bits))
                  << bits << " bits, " << samples << " samples, operation " << static_cast<int>(rows[y].op)
                  << " on " << buffer.stored(x) << ", outcome " << static_cast<int>(outcome)
                  << ", write mask " << rows[y].write_mask << (back ? ", back" : ", front") << ", drawn as "
                  << static_cast<int>(drawn);
        }
}

TEST(StencilOverflow, TestsCompareMaskedValues) {
  constexpr std::uint32_t kCompared[] = {0xffffffff, 0, 1, 6, 0x80};
  for (int bits = 1; bits <= 8; ++bits) {
    const std::uint32_t most = (1u << bits) - 1;
    struct Row {
      Compare func;
      std::uint32_t reference;
      std::uint32_t mask;
    };
    std::vector<Row> rows;
    for (int func = 0; func < 8; ++func)
      for (const std::uint32_t reference : {0u, 1u, most / 2, most, 0xffffffffu})
        for (const std::uint32_t mask : kCompared)
          rows.push_back({static_cast<Compare>(func), reference, mask});
    Rows buffer(bits, 1, static_cast<int>(rows.size()));
    for (std::size_t y = 0; y < rows.size(); ++y)
      buffer.draw(static_cast<int>(y), {.func = rows[y].func, .ref = rows[y].reference, .mask = rows[y].mask},
                  Outcome::passes, Drawn::triangles, false);
    buffer.finish();
    for (std::size_t y = 0; y < rows.size(); ++y)
      for (int x = 0; x < Rows::kWidth; ++x)
        ASSERT_EQ(buffer.is_drawn(x, static_cast<int>(y)),
                  passes(rows[y].func, std::min(rows[y].reference, most) & rows[y].mask,
                         buffer.stored(x) & rows[y].mask))
            << bits << " bits, function " << static_cast<int>(rows[y].func) << ", reference "
            << rows[y].reference << ", mask " << rows[y].mask << ", stored " << buffer.stored(x);
  }
}

// Many layers within one mesh of one frame, and one frame per layer.
TEST(StencilOverflow, CountsSaturateOrWrap) {
  constexpr int kLayers = 700;
  MeshData layers;
  for (int i = 0; i < kLayers; ++i) {
    const MeshData one = whole_window();
    layers.positions.insert(layers.positions.end(), one.positions.begin(), one.positions.end());
    for (const std::uint32_t index : one.indices)
      layers.indices.push_back(index + 4 * static_cast<std::uint32_t>(i));
  }
  const MeshData one = whole_window();
  Renderer renderer({.threads = 1});
  for (int bits = 1; bits <= 8; ++bits)
    for (const StencilOp op :
         {StencilOp::incr, StencilOp::decr, StencilOp::incr_wrap, StencilOp::decr_wrap, StencilOp::invert})
      for (const int count : {1, kLayers}) {
        FrameBuffer buffer({.width = 9, .height = 5, .stencil_bits = bits});
        Frame frame(buffer);
        const std::uint32_t most = (1u << bits) - 1;
        std::uint32_t expected = most / 3;
        frame.clear({.stencil = expected});
        DrawState state;
        state.depth.enabled = false;
        state.stencil = StencilState{.front = {.zpass = op}};
        for (int i = 0; i < kLayers; i += count) {
          frame.draw((count == 1 ? one : layers).view(), state);
          if (count == 1 && i % 100 == 0) renderer.finish(frame);
        }
        renderer.finish(frame);
        for (int i = 0; i < kLayers; ++i) expected = after(op, expected, 0, 0xff, bits);
        for (const std::uint8_t value : stencil_values(buffer))
          ASSERT_EQ(value, expected) << bits << " bits, operation " << static_cast<int>(op) << ", " << count
                                     << " at a time";
      }
}

// Shadow volumes: front faces increment and back faces decrement. Any order cancels out, however often the
// count wraps.
TEST(StencilOverflow, FrontAndBackFacesCancelOut) {
  Renderer renderer({.threads = 1});
  Random random(3);
  for (int bits = 1; bits <= 8; ++bits) {
    FrameBuffer buffer({.width = 40, .height = 30, .stencil_bits = bits});
    Frame frame(buffer);
    frame.clear({.stencil = 1});
    DrawState state;
    state.depth.test = Compare::never;
    state.stencil = StencilState{.front = {.zfail = StencilOp::incr_wrap},
                                 .back = StencilFace{.zfail = StencilOp::decr_wrap}};
    std::vector<MeshData> meshes;
    for (int i = 0; i < 600; ++i) {
      MeshData& mesh = meshes.emplace_back();
      for (int k = 0; k < 9; ++k) mesh.positions.push_back(random.between(-1.5f, 1.5f));
      mesh.indices = {0, 1, 2};
    }
    std::vector<MeshData> turned = meshes;
    for (MeshData& mesh : turned) std::swap(mesh.indices[0], mesh.indices[1]);
    for (const auto* side : {&meshes, &turned})
      for (const MeshData& mesh : *side) frame.draw(mesh.view(), state);
    renderer.finish(frame);
    for (const std::uint8_t value : stencil_values(buffer)) ASSERT_EQ(value, 1) << bits << " bits";
  }
}

}  // namespace
}  // namespace tessera::test::stencil_overflow_test
