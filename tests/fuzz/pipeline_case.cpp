#include "tests/fuzz/pipeline_case.h"

#include <algorithm>

#include "tests/fuzz/pipeline_state.h"
#include "tests/fuzz/target.h"

namespace tessera::fuzz {
namespace {

FrameBufferFormat read_format(FuzzInput& from) {
  constexpr int kMaxSidePixels = 48;
  constexpr DepthFormat kDepths[] = {DepthFormat::unorm24, DepthFormat::float32, DepthFormat::unorm16,
                                     DepthFormat::unorm32, DepthFormat::none};
  FrameBufferFormat format;
  const auto side = [&](int byte) { return 1 + byte % kMaxSidePixels; };
  format.width = side(from.byte());
  format.height = side(from.byte());
  const int kind = from.byte();
  const int more = from.byte();
  const bool is_index = (kind & 7) == 7;
  format.color_mode = is_index ? ColorMode::index : ColorMode::rgb;
  format.color_bits = is_index ? 8 : 24;
  if ((kind & 8) != 0) format.color_bits = 1 + from.below(24);
  format.depth = kDepths[(kind >> 4) % 5];
  format.stencil_bits = more % 9;
  format.dither = static_cast<Dither>((more & 0x80) != 0 ? more >> 4 & 3 : 0);
  const int extras = from.byte();
  if ((extras & 0xe0) == 0xe0) {  // many tiles; rare because they are slow
    constexpr int kLarge[][2] = {{300, 60}, {60, 300}, {2080, 8}, {8, 2080}};
    const auto& large = kLarge[from.below(4)];
    format.width = large[0];
    format.height = large[1];
  }
  if (!is_index) {
    format.alpha_bits = (extras & 1) != 0 ? 8 : 0;
    if ((extras & 2) != 0) format.accumulation_bits = (extras & 4) != 0 ? 32 : 16;
    if ((extras & 8) != 0) format.samples = (extras & 16) != 0 ? 8 : 4;
  } else if ((extras & 3) == 3) {
    const int entries = 1 + from.below(std::min(1 << format.color_bits, 20));
    for (int i = 0; i < entries; ++i) {
      const float r = from.unit();
      const float g = from.unit();
      const float b = from.unit();
      format.palette.push_back({r, g, b, 1});
    }
  }
  return format;
}

// Sets one field of the format out of range.
FrameBufferFormat spoilt(FrameBufferFormat format, FuzzInput& from) {
  int* const numbers[] = {&format.width,        &format.height,     &format.color_bits,
                          &format.stencil_bits, &format.alpha_bits, &format.accumulation_bits,
                          &format.samples};
  int bad = -1;
  if (!from.coin()) bad = from.coin() ? 1 << 30 : 9;
  *numbers[from.below(7)] = bad;
  return format;
}

// The first renderer is scalar, with one thread and one bin pass; the second uses a fast instruction set,
// several threads, a random task order and sometimes several passes.
void read_options(FuzzInput& from, RendererOptions (&options)[2]) {
  constexpr int kTileSizes[] = {32, 64, 128, 0};
  const std::vector<InstructionSet> sets = available_instruction_sets();
  const int bits = from.byte();
  for (int i = 0; i < 2; ++i) {
    options[i].threads = 1;
    options[i].tile_size = kTileSizes[bits >> 2 * i & 3];
    options[i].debug.defer_shading = (bits >> (4 + i) & 1) == 0;
    options[i].debug.count_fragments = (bits >> (6 + i) & 1) != 0;
  }
  const int work = from.byte();
  options[1].threads = 1 + (work & 0x3f) % 3;
  options[1].debug.task_order = work & 0x3f;
  if ((work & 0x40) != 0) options[1].bin_memory = kMinBinMemory;
  options[0].instruction_set = InstructionSet::scalar;
  options[1].instruction_set =
      sets[static_cast<std::size_t>(from.below(static_cast<int>(std::max<std::size_t>(sets.size() - 1, 1))))];
}

/// Numbers of a mesh: each from the bytes, or all from one seed and mostly near -1 .. 1.
class Numbers {
 public:
  explicit Numbers(FuzzInput& from) : from_(from), state_(from.byte()) {}
  float next() {
    if (state_ % 2 == 0) return from_.real32();
    state_ = state_ * 6364136223846793005u + 1442695040888963406u;  // the even increment keeps bit 0 set
    return static_cast<float>(static_cast<std::int32_t>(state_ >> 40) - (1 << 23)) /
           static_cast<float>(1 << 22);
  }

 private:
  FuzzInput& from_;
  std::uint64_t state_;
};

std::vector<float> read_floats(FuzzInput& from, const ExactSizeMesh& mesh, std::size_t components) {
  const std::size_t step = mesh.stride_floats != 0 ? mesh.stride_floats : components;
  std::vector<float> list(mesh.vertices == 0 ? 0 : step * (mesh.vertices - 1) + components);
  Numbers numbers(from);
  for (std::size_t v = 0; v < mesh.vertices; ++v)
    for (std::size_t c = 0; c < components; ++c) list[step * v + c] = numbers.next();
  return list;
}

ExactSizeMesh read_mesh(FuzzInput& from) {
  ExactSizeMesh own;
  const int kind = from.byte();
  const int has = from.byte();
  own.mesh.primitive = static_cast<Primitive>(kind % 10);
  own.mesh.position_components = (has & 1) != 0 ? 4 : 3;
  own.vertices = static_cast<std::size_t>((has & 2) != 0 ? from.below(65) : 12);
  if ((has & 4) != 0) own.stride_floats = 4 + static_cast<std::size_t>(from.below(4));
  own.positions = read_floats(from, own, static_cast<std::size_t>(own.mesh.position_components));
  if ((has & 8) != 0) own.normals = read_floats(from, own, 3);
  if ((has & 16) != 0) {
    if (from.coin()) {
      own.colors = read_floats(from, own, 4);
    } else {
      own.color_bytes.resize(4 * own.vertices);
      for (std::uint8_t& byte : own.color_bytes) byte = from.byte();
    }
  }
  if ((has & 32) != 0) own.texcoords = read_floats(from, own, 2);
  if ((has & 64) != 0) own.color_indices = read_floats(from, own, 1);
  if ((has & 128) != 0) {
    const bool is_short = from.coin();
    const int count = from.below(97);
    for (int i = 0; i < count; ++i) {
      const std::uint32_t index =
          from.rarely() ? from.word()
                        : from.byte() % static_cast<std::uint32_t>(std::max<std::size_t>(own.vertices, 1));
      if (is_short) own.short_indices.push_back(static_cast<std::uint16_t>(index));
      else own.indices.push_back(index);
    }
    own.indices.shrink_to_fit();
    own.short_indices.shrink_to_fit();
  }
  if (from.rarely()) {  // mismatched arrays
    std::vector<float>* const lists[] = {&own.positions, &own.normals, &own.colors, &own.texcoords,
                                         &own.color_indices};
    std::vector<float>& list = *lists[from.below(5)];
    // With a stride, a last vertex of only three components would not be detected.
    if (!list.empty() && own.stride_floats == 0) list = std::vector<float>(list.begin(), list.end() - 1);
    else if (const int odd = from.integer(0, 8); odd != 4 || own.stride_floats == 0)
      own.mesh.position_components = odd;
  }
  return own;
}

Texture read_texture(FuzzInput& from) {
  const int width = 1 + from.below(33);
  const int height = 1 + from.below(33);
  const int kind = from.byte();
  TextureImage image{
      .width = width, .height = height, .channels = 1 + (kind & 3), .bottom_row_first = (kind & 4) != 0};
  const std::ptrdiff_t row = std::ptrdiff_t{width} * image.channels;
  const std::ptrdiff_t gap = (kind & 8) != 0 ? from.byte() : 0;
  image.stride_bytes = gap != 0 ? row + gap : 0;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>((row + gap) * (height - 1) + row));
  std::uint32_t state = from.byte();
  for (std::uint8_t& byte : pixels)
    byte = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  image.pixels = pixels.data();
  if ((kind & 16) != 0) {  // rows from the other end
    image.pixels = pixels.data() + (row + gap) * (height - 1);
    image.stride_bytes = -(row + gap);
  }
  TextureSampler sampler;
  sampler.mag = (kind & 32) != 0 ? TextureFilter::nearest : TextureFilter::linear;
  sampler.min = from.one_of<TextureFilter>(6);
  sampler.wrap_s = from.one_of<TextureWrap>(3);
  sampler.wrap_t = from.one_of<TextureWrap>(3);
  return Texture(image, sampler);
}

std::vector<std::uint8_t> read_texels(FuzzInput& from, std::ptrdiff_t bytes) {
  std::vector<std::uint8_t> texels(static_cast<std::size_t>(bytes));
  std::uint32_t state = from.byte();
  const bool is_given = state % 4 == 0;
  for (std::uint8_t& byte : texels)
    byte = is_given ? from.byte() : static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  return texels;
}

DrawBitmap read_bitmap(FuzzInput& from, StateReader& states) {
  DrawBitmap command;
  Bitmap& bitmap = command.bitmap;
  bitmap.width = 1 + from.below(70);
  bitmap.height = 1 + from.below(20);
  const std::ptrdiff_t row = (bitmap.width + 7) / 8;
  const std::ptrdiff_t gap = from.coin() ? from.below(5) : 0;
  bitmap.stride_bytes = gap != 0 ? row + gap : 0;
  command.bits = read_texels(from, (row + gap) * (bitmap.height - 1) + row);
  bitmap.x = 8 * from.finite();
  bitmap.y = 8 * from.finite();
  bitmap.depth = from.unit();
  bitmap.color = states.any_color();
  command.state = states.fragment_state();
  return command;
}

DrawImage read_image(FuzzInput& from, StateReader& states) {
  DrawImage command;
  PixelImage& image = command.image;
  image.width = 1 + from.below(20);
  image.height = 1 + from.below(20);
  image.channels = 1 + from.below(4);
  const std::ptrdiff_t row = std::ptrdiff_t{image.width} * image.channels;
  const std::ptrdiff_t gap = from.coin() ? from.below(5) : 0;
  image.stride_bytes = gap != 0 ? row + gap : 0;
  command.pixels = read_texels(from, (row + gap) * (image.height - 1) + row);
  image.x = 8 * from.finite();
  image.y = 8 * from.finite();
  if (from.coin()) {
    image.zoom_x = from.finite();
    image.zoom_y = from.finite();
  }
  image.depth = from.unit();
  command.state = states.fragment_state();
  return command;
}

PipelineFrame read_frame(FuzzInput& from, StateReader& states, const PipelineCase& all) {
  PipelineFrame frame;
  const int count = 1 + from.below(8);
  const int ends = from.byte();
  for (int i = 0; i < count && !from.empty(); ++i) {
    const int kind = from.below(16);
    if (kind < 8)
      frame.commands.emplace_back(
          DrawMesh{static_cast<std::size_t>(from.below(static_cast<int>(all.meshes.size()))),
                   states.draw_state(all.textures)});
    else if (kind == 8) frame.commands.emplace_back(read_bitmap(from, states));
    else if (kind == 9) frame.commands.emplace_back(read_image(from, states));
    else if (kind == 10 || kind == 11) frame.commands.emplace_back(states.clear());
    else if (kind == 12) frame.commands.emplace_back(states.accum());
    else if (kind == 13) frame.commands.emplace_back(states.camera());
    else if (kind == 14) frame.commands.emplace_back(states.light_model());
    else {
      LightList lights(static_cast<std::size_t>(from.below(10)));
      for (Light& light : lights) light = states.light();
      frame.commands.emplace_back(std::move(lights));
    }
  }
  if ((ends & 1) != 0) {
    Presentation out{
        .gap_bytes = from.below(9), .bottom_up = from.coin(), .order = from.one_of<PixelOrder>(2)};
    if (from.coin()) out.part = states.rect();
    frame.presentation = out;
  }
  if ((ends & 2) != 0) {
    const int kept = from.byte();
    frame.keep.emplace();
    for (int k = 0; k < 4; ++k)
      if ((kept >> k & 1) != 0) frame.keep->push_back(static_cast<Buffer>(k));
  }
  frame.captures = (ends & 4) != 0;
  return frame;
}

}  // namespace

Mesh ExactSizeMesh::view() const {
  Mesh view = mesh;
  const auto lent = [&](const std::vector<float>& list) {
    if (list.empty()) return FloatArray();
    return stride_floats != 0 ? FloatArray(list.data(), vertices, stride_floats * sizeof(float))
                              : FloatArray(list);
  };
  view.positions = lent(positions);
  view.normals = lent(normals);
  view.texcoords = lent(texcoords);
  view.color_indices = lent(color_indices);
  if (!colors.empty()) view.colors.floats = lent(colors);
  if (!color_bytes.empty()) view.colors = ColorArray(color_bytes);
  if (!indices.empty()) view.indices = indices;
  if (!short_indices.empty()) view.indices = short_indices;
  return view;
}

PipelineCase::PipelineCase(FuzzInput& from) {
  const FrameBufferFormat sound = read_format(from);
  format = from.rarely() ? spoilt(sound, from) : sound;
  read_options(from, options);
  const int counts = from.byte();
  uses_caller_memory = (counts & 0x80) != 0;
  for (int i = 0; i < (counts & 3); ++i) textures.push_back(read_texture(from));
  for (int i = 0; i <= (counts >> 2 & 3); ++i) meshes.push_back(read_mesh(from));
  std::optional<Rect> window;
  if ((counts & 0x40) != 0)
    window = Rect{from.below(sound.width), from.below(sound.height), 1 + from.below(24), 1 + from.below(24)};
  if (from.rarely() && !textures.empty()) {
    [[maybe_unused]] const Texture gone = std::move(textures.front());
  }
  StateReader states(from, sound, window);
  for (int i = 0; i <= (counts >> 4 & 1); ++i) frames.push_back(read_frame(from, states, *this));
}

}  // namespace tessera::fuzz
