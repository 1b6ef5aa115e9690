// Whole frames through the public interface, each drawn twice: on the scalar path, and on a fast path with
// another tile size, number of threads and bin memory. Both must refuse the same input, store the same bits,
// report the same statistics, and touch nothing outside viewports, scissors and image regions.
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "engine/program/threads/thread_limit.h"
#include "tests/fuzz/pipeline_case.h"
#include "tests/fuzz/target.h"

namespace tessera::fuzz {
using namespace detail;
using namespace program;
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

constexpr Buffer kBuffers[] = {Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation};

/// Stored values, one list per buffer; empty if the buffer does not exist or was not kept.
struct Stored {
  std::vector<std::uint32_t> words[4];
  friend bool operator==(const Stored&, const Stored&) = default;
};

Stored stored_in(const FrameBuffer& buffer) {
  const std::size_t pixels =
      static_cast<std::size_t>(buffer.format().width) * static_cast<std::size_t>(buffer.format().height);
  Stored stored;
  std::vector<std::uint32_t> words(pixels);
  if (!error_of([&] { buffer.read_packed_colors(words); })) stored.words[0] = words;
  if (!error_of([&] { buffer.read_stored_depths(words); })) stored.words[1] = words;
  std::vector<std::uint8_t> values(pixels);
  if (!error_of([&] { buffer.read_stencil(values); })) stored.words[2].assign(values.begin(), values.end());
  std::vector<float> levels(4 * pixels);
  if (!error_of([&] { buffer.read_accumulation(levels); })) {
    stored.words[3].resize(4 * pixels);
    std::memcpy(stored.words[3].data(), levels.data(), 16 * pixels);
  }
  return stored;
}

// Planes hold the same bits as the packed values.
void require_alike(const FrameBuffer& buffer, const Stored& stored) {
  for (std::size_t b = 0; b < 3; ++b)
    for (int k = 0; !stored.words[b].empty() && k < buffer.plane_count(kBuffers[b]); ++k) {
      const PlaneView plane = buffer.plane(kBuffers[b], k);
      const std::uint32_t* word = stored.words[b].data();
      std::uint32_t differences = 0;
      for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x, ++word)
          differences |= plane.bits[y * plane.stride_bytes + x / 8] >> (7 - x % 8) ^ *word >> k;
      require((differences & 1) == 0, "a plane differs from the packed values");
    }
}

/// Pixels that a frame may touch, rows from the top.
class Reach {
 public:
  explicit Reach(const FrameBufferFormat& format)
      : width_(format.width),
        height_(format.height),
        reached_(static_cast<std::size_t>(format.width * format.height)) {}
  void add(const std::optional<Rect>& one, const std::optional<Rect>& two = std::nullopt) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (holds(one, x, height_ - 1 - y) && holds(two, x, height_ - 1 - y))
          reached_[static_cast<std::size_t>(y * width_ + x)] = true;
  }
  void require_untouched(const Stored& before, const Stored& after) const {
    for (std::size_t b = 0; b < 4; ++b) {
      if (before.words[b].empty() || after.words[b].empty()) continue;
      const std::size_t each = before.words[b].size() / reached_.size();
      for (std::size_t i = 0; i < before.words[b].size(); ++i)
        if (!reached_[i / each] && before.words[b][i] != after.words[b][i])
          finding("buffer " + std::to_string(b) +
                  " changed outside of every viewport and scissor, at pixel " +
                  std::to_string(i / each % static_cast<std::size_t>(width_)) + ", row " +
                  std::to_string(i / each / static_cast<std::size_t>(width_)) + " from the top");
    }
  }

 private:
  static bool holds(const std::optional<Rect>& rect, std::int64_t x, std::int64_t y) {
    if (!rect) return true;
    const bool is_in_columns = x >= rect->x && x < std::int64_t{rect->x} + rect->width;
    const bool is_in_rows = y >= rect->y && y < std::int64_t{rect->y} + rect->height;
    return is_in_columns && is_in_rows;
  }
  int width_, height_;
  std::vector<bool> reached_;
};

/// The caller's memory for a picture.
class Canvas {
 public:
  Canvas(const Presentation& how, const FrameBufferFormat& format)
      : how_(how), width_(format.width), height_(format.height) {
    stride_ = 4 * std::ptrdiff_t{width_} + how.gap_bytes;
    bytes.assign(static_cast<std::size_t>(stride_ * (height_ - 1) + 4 * std::ptrdiff_t{width_}), kUntouched);
  }
  ImageTarget target() {
    return {.pixels = bytes.data() + (how_.bottom_up ? stride_ * (height_ - 1) : 0),
            .width = width_,
            .height = height_,
            .stride_bytes = how_.bottom_up ? -stride_ : stride_,
            .order = how_.order,
            .region = how_.part};
  }
  void require_untouched_outside() const {
    const Rect part = how_.part.value_or(Rect{0, 0, width_, height_});
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::int64_t row = static_cast<std::int64_t>(i) / stride_;
      const std::int64_t x = static_cast<std::int64_t>(i) % stride_ / 4;
      const std::int64_t y = how_.bottom_up ? row : height_ - 1 - row;
      const bool is_in_columns = x < width_ && x >= part.x && x < std::int64_t{part.x} + part.width;
      const bool is_in_rows = y >= part.y && y < std::int64_t{part.y} + part.height;
      const bool inside = is_in_columns && is_in_rows;
      require(inside || bytes[i] == kUntouched, "an image changed outside the requested region");
    }
  }
  std::vector<std::uint8_t> bytes;

 private:
  static constexpr std::uint8_t kUntouched = 0xa5;
  Presentation how_;
  int width_, height_;
  std::ptrdiff_t stride_;
};

/// Error and results of one of the two renderings.
struct Outcome {
  std::vector<std::string> errors;
  std::vector<Stored> stored;  ///< after each frame
  std::vector<std::vector<std::uint8_t>> pictures;
  std::vector<std::uint32_t> captured;
  std::vector<std::uint64_t> counted;
};

// Fills the buffers with different values, so that changes of pixels that must stay are detected.
void fill(FrameBuffer& buffer, Renderer& renderer) {
  const FrameBufferFormat& format = buffer.format();
  const bool is_index = format.color_mode == ColorMode::index;
  Frame frame(buffer);
  Clear clear;
  if (is_index) clear.index = 1;
  else clear.color = Color{0.3f, 0.6f, 0.1f, 0.7f};
  if (format.depth != DepthFormat::none) clear.depth = 0.75;
  if (format.stencil_bits > 0) clear.stencil = 1;
  if (format.accumulation_bits > 0) clear.accumulation = Color{0.25f, -0.5f, 1, 0.125f};
  frame.clear(clear);
  if (is_index) frame.clear({.index = 0, .scissor = Rect{1, 1, format.width / 2, format.height / 2}});
  static constexpr std::uint8_t kTexels[] = {255, 0, 40, 20, 90, 200, 130, 160, 7, 222, 61, 180};
  if (!is_index)
    frame.draw_image({.pixels = kTexels,
                      .width = 2,
                      .height = 2,
                      .channels = 3,
                      .zoom_x = format.width / 3.0,
                      .zoom_y = format.height / 3.0},
                     {.depth = {.enabled = false}});
  renderer.finish(frame);
}

void record(const PipelineCase& from, const PipelineFrame& wanted, Frame& frame, Reach& reach,
            Outcome& outcome) {
  const auto run = [&](const PipelineCommand& command) {
    std::visit(Overloaded{[&](const DrawMesh& draw) {
                            frame.draw(from.meshes[draw.mesh].view(), draw.state);
                            reach.add(draw.state.viewport, draw.state.scissor);
                          },
                          [&](const DrawBitmap& draw) {
                            Bitmap bitmap = draw.bitmap;
                            bitmap.bits = draw.bits.data();
                            frame.draw_bitmap(bitmap, draw.state);
                            reach.add(draw.state.scissor);
                          },
                          [&](const DrawImage& draw) {
                            PixelImage image = draw.image;
                            image.pixels = draw.pixels.data();
                            frame.draw_image(image, draw.state);
                            reach.add(draw.state.scissor);
                          },
                          [&](const Clear& clear) {
                            frame.clear(clear);
                            reach.add(clear.scissor);
                          },
                          [&](const Accum& accum) {
                            frame.accumulate(accum);
                            reach.add(accum.scissor);
                          },
                          [&](const Camera& camera) { frame.set_camera(camera); },
                          [&](const LightList& lights) { frame.set_lights(lights); },
                          [&](const LightModel& model) { frame.set_light_model(model); }},
               command);
  };
  for (const PipelineCommand& command : wanted.commands)
    if (const auto error = error_of([&] { run(command); })) outcome.errors.push_back(*error);
  for (std::size_t i = 0; i < frame.draw_count(); ++i)
    require(!frame.explain(i).empty(), "the explanation of a draw is empty");
  if (wanted.keep) {
    // keep() takes an initializer list.
    const auto has = [&](Buffer b) {
      return std::find(wanted.keep->begin(), wanted.keep->end(), b) != wanted.keep->end();
    };
    if (has(Buffer::color) && has(Buffer::depth))
      frame.keep({Buffer::color, Buffer::depth, Buffer::stencil, Buffer::accumulation});
    else if (has(Buffer::color)) frame.keep({Buffer::color, Buffer::stencil});
    else if (has(Buffer::depth)) frame.keep({Buffer::depth, Buffer::accumulation});
    else frame.keep({});
  }
}

void finish(const PipelineFrame& wanted, FrameBuffer& buffer, Frame& frame, const Reach& reach,
            Renderer& renderer, Outcome& outcome) {
  const std::size_t pixels =
      static_cast<std::size_t>(buffer.format().width) * static_cast<std::size_t>(buffer.format().height);
  const std::size_t draws = frame.draw_count();
  std::vector<std::uint32_t> draw_ids(wanted.captures ? pixels : 0);
  std::vector<std::uint32_t> primitive_ids(draw_ids.size());
  std::vector<float> normals(3 * draw_ids.size());
  frame.capture({.draw_ids = draw_ids, .primitive_ids = primitive_ids, .normals = normals});
  std::optional<Canvas> canvas;
  if (wanted.presentation) canvas.emplace(*wanted.presentation, buffer.format());
  const Stored before = stored_in(buffer);
  FrameStats stats;
  const auto error =
      error_of([&] { stats = canvas ? renderer.finish(frame, canvas->target()) : renderer.finish(frame); });
  const Stored after = stored_in(buffer);
  if (error) {
    outcome.errors.push_back(*error);
    require(after == before, "a frame that was refused changed the frame buffer");
    frame.reset();
  } else {
    reach.require_untouched(before, after);
    for (const std::uint32_t object : draw_ids)
      require(object == Capture::kNothing || object < draws, "a captured draw number is out of range");
    outcome.counted.insert(
        outcome.counted.end(),
        {stats.vertices, stats.triangles_in, stats.dropped_non_finite, stats.trivially_rejected, stats.culled,
         stats.zero_area, stats.clipped, stats.binned});
  }
  if (canvas) {
    canvas->require_untouched_outside();
    outcome.pictures.push_back(std::move(canvas->bytes));
  }
  outcome.stored.push_back(after);
  outcome.captured.insert(outcome.captured.end(), draw_ids.begin(), draw_ids.end());
  outcome.captured.insert(outcome.captured.end(), primitive_ids.begin(), primitive_ids.end());
  for (const float x : normals) outcome.captured.push_back(std::bit_cast<std::uint32_t>(x));
}

/// Memory of exactly the requested size, aligned to 64 bytes.
using LentMemory = std::unique_ptr<std::byte, decltype(&std::free)>;

Outcome draw(const PipelineCase& from, int rendering) {
  Outcome outcome;
  const auto error = error_of([&] {
    LentMemory memory(nullptr, &std::free);
    std::optional<FrameBuffer> buffer;
    if (rendering == 1 && from.uses_caller_memory) {
      const std::size_t bytes = FrameBuffer::memory_bytes(from.format);
      memory.reset(static_cast<std::byte*>(std::aligned_alloc(64, (bytes + 63) / 64 * 64)));
      buffer.emplace(from.format, std::span(memory.get(), bytes));
    } else {
      buffer.emplace(from.format);
    }
    Renderer renderer(from.options[rendering]);
    fill(*buffer, renderer);
    Frame frame(*buffer);
    for (const PipelineFrame& wanted : from.frames) {
      Reach reach(from.format);
      record(from, wanted, frame, reach, outcome);
      finish(wanted, *buffer, frame, reach, renderer, outcome);
    }
    require_alike(*buffer, outcome.stored.back());
  });
  if (error) outcome.errors.push_back(*error);
  return outcome;
}

}  // namespace
}  // namespace tessera::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  static const tessera::program::ThreadLimit limit(3);
  FuzzInput bytes(data, size);
  const PipelineCase from(bytes);
  const Outcome scalar = draw(from, 0);
  const Outcome fast = draw(from, 1);
  require(scalar.errors == fast.errors, "the renderings report different errors");
  require(scalar.stored == fast.stored, "the renderings store different bits");
  require(scalar.pictures == fast.pictures, "the renderings show different pictures");
  require(scalar.captured == fast.captured, "the renderings capture different values");
  require(scalar.counted == fast.counted, "the renderings count different triangles");
  return 0;
}
