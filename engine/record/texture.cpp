// Construction of textures: checks, texels as words, mipmaps, textures of one colour.
#include <algorithm>
#include <cstddef>
#include <string>

#include "engine/record/checks.h"
#include "engine/record/mipmaps.h"
#include "engine/record/quality_caps.h"
#include "engine/record/texture_state.h"
#include "engine/runtime/floating_point_mode.h"
#include "engine/runtime/out_of_memory.h"
#include "engine/runtime/worker_pool.h"
#include "framebuffer/instruction_set.h"

namespace tessera {
using namespace detail;
namespace {

static_assert(kMaxTextureSide == kMaxTextureSize);

void check_side(const char* what, int texels) {
  if (texels < 1 || texels > kMaxTextureSize)
    throw Error(ErrorCode::invalid_argument, std::string("Texture: the ") + what + " is " +
                                                 std::to_string(texels) + " texels, must be 1 to " +
                                                 std::to_string(kMaxTextureSize));
}

void check(const TextureImage& image, const TextureSampler& sampler) {
  check_side("width", image.width);
  check_side("height", image.height);
  if (image.channels < 1 || image.channels > 4)
    throw Error(ErrorCode::invalid_argument,
                "Texture: the image has " + std::to_string(image.channels) + " channels, must be 1 to 4");
  if (image.pixels == nullptr)
    throw Error(ErrorCode::invalid_argument, "Texture: pixels is null, must point to " +
                                                 std::to_string(image.width) + "x" +
                                                 std::to_string(image.height) + " pixels");
  const std::ptrdiff_t row = std::ptrdiff_t{image.width} * image.channels;
  const bool rows_overlap = image.stride_bytes < row && image.stride_bytes > -row;
  if (image.stride_bytes != 0 && rows_overlap)
    throw Error(ErrorCode::invalid_argument, "Texture: the rows are " + std::to_string(image.stride_bytes) +
                                                 " bytes apart, but " + std::to_string(row) + " bytes long");
  require_enum({"Texture: mag"}, sampler.mag, TextureFilter::linear_mipmap_linear);
  require_enum({"Texture: min"}, sampler.min, TextureFilter::linear_mipmap_linear);
  require_enum({"Texture: wrap_s"}, sampler.wrap_s, TextureWrap::mirrored_repeat);
  require_enum({"Texture: wrap_t"}, sampler.wrap_t, TextureWrap::mirrored_repeat);
  if (sampler.mag != TextureFilter::nearest && sampler.mag != TextureFilter::linear)
    throw Error(ErrorCode::invalid_argument,
                "Texture: mag is a filter with mipmaps, must be nearest or linear");
}

std::uint32_t packed_texel(const std::uint8_t* pixel, int channels) {
  constexpr std::uint32_t kOpaque = 0xff000000u;
  switch (channels) {
    case 1: return pixel[0] * 0x010101u | kOpaque;
    case 2: return pixel[0] * 0x010101u | static_cast<std::uint32_t>(pixel[1]) << 24;
    case 3:
      return static_cast<std::uint32_t>(pixel[0]) << 16 | static_cast<std::uint32_t>(pixel[1]) << 8 |
             pixel[2] | kOpaque;
    default:
      return static_cast<std::uint32_t>(pixel[0]) << 16 | static_cast<std::uint32_t>(pixel[1]) << 8 |
             pixel[2] | static_cast<std::uint32_t>(pixel[3]) << 24;
  }
}

void set_filters(TextureLevels& levels, const TextureSampler& sampler) {
  const TextureFilter min = sampler.min;
  levels.mag_linear = sampler.mag == TextureFilter::linear;
  levels.min_linear = min == TextureFilter::linear || min == TextureFilter::linear_mipmap_nearest ||
                      min == TextureFilter::linear_mipmap_linear;
  levels.blends_levels =
      min == TextureFilter::nearest_mipmap_linear || min == TextureFilter::linear_mipmap_linear;
  const bool magnification_is_sharper = levels.mag_linear && (min == TextureFilter::nearest_mipmap_nearest ||
                                                              min == TextureFilter::nearest_mipmap_linear);
  levels.magnification_limit = magnification_is_sharper ? 2.0f : 1.0f;
  levels.wrap_s = sampler.wrap_s;
  levels.wrap_t = sampler.wrap_t;
}

bool has_mipmaps(const TextureSampler& sampler) {
  return sampler.min != TextureFilter::nearest && sampler.min != TextureFilter::linear;
}

/// Sets the size and the offset of each level.
/// @return  number of words of all levels
std::size_t lay_out_levels(TextureLevels& levels, const TextureImage& image, bool mipmaps) {
  levels.level[0] = {0, image.width, image.height};
  std::int64_t words = levels.level[0].words();
  while (mipmaps && (levels.level[levels.last].width > 1 || levels.level[levels.last].height > 1)) {
    const TextureLevel& larger = levels.level[levels.last++];
    levels.level[levels.last] = {static_cast<std::int32_t>(words), next_level_size(larger.width),
                                 next_level_size(larger.height)};
    words += levels.level[levels.last].words();
  }
  return static_cast<std::size_t>(words);
}

void fill_from(const TextureImage& image, std::uint32_t* words, const TextureLevel& level) {
  const std::ptrdiff_t stride =
      image.stride_bytes != 0 ? image.stride_bytes : std::ptrdiff_t{image.width} * image.channels;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* pixel = static_cast<const std::uint8_t*>(image.pixels) +
                                stride * (image.bottom_row_first ? y : image.height - 1 - y);
    std::uint32_t* const row = words + level.first + std::ptrdiff_t{y} * level.stride;
    for (int x = 0; x < image.width; ++x, pixel += image.channels)
      row[x] = packed_texel(pixel, image.channels);
  }
}

/// Fills the padding after the last texel and the last row with the texels that follow under the wrap mode.
/// If none follow, the padding has weight 0.
void pad_level(std::uint32_t* words, const TextureLevel& level, const TextureLevels& levels) {
  std::uint32_t* const first = words + level.first;
  for (std::int32_t y = 0; y < level.height; ++y) {
    std::uint32_t* const row = first + std::ptrdiff_t{y} * level.stride;
    row[level.width] = levels.wrap_s == TextureWrap::repeat ? row[0] : row[level.width - 1];
  }
  if (level.height == 1) return;
  std::uint32_t* const padding = first + std::ptrdiff_t{level.height} * level.stride;
  std::copy_n(levels.wrap_t == TextureWrap::repeat ? first : padding - level.stride, level.stride, padding);
}

std::array<float, 4> color_of(std::uint32_t word) {
  std::array<float, 4> color;
  for (std::size_t c = 0; c < 4; ++c)
    color[c] = static_cast<float>((word >> kTexelShift[c] & 0xff) << 8) / kTexelOne;
  return color;
}

bool is_one_color(const TextureState& texture) {
  const TextureLevel& level = texture.filtered[0].levels.level[0];
  for (std::int32_t y = 0; y < level.height; ++y) {
    const std::uint32_t* const row = texture.texels.data() + std::ptrdiff_t{y} * level.stride;
    if (!std::all_of(row, row + level.width, [&](std::uint32_t word) { return word == texture.texels[0]; }))
      return false;
  }
  return true;
}

bool is_opaque(const TextureState& texture) {
  const TextureLevel& level = texture.filtered[0].levels.level[0];
  for (std::int32_t y = 0; y < level.height; ++y) {
    const std::uint32_t* const row = texture.texels.data() + std::ptrdiff_t{y} * level.stride;
    if (!std::all_of(row, row + level.width, [](std::uint32_t word) { return word >> 24 == 255; }))
      return false;
  }
  return true;
}

/// Sample at s = t = 0 under magnification. A linear filter yields the mean of the four texels around the
/// corner of the image, as in the kernel.
std::array<float, 4> color_at_origin(const TextureLevels& levels) {
  const TextureLevel& level = levels.level[0];
  if (!levels.mag_linear) return color_of(levels.words[0]);
  const std::ptrdiff_t left = levels.wrap_s == TextureWrap::repeat ? level.width - 1 : 0;
  const std::ptrdiff_t below = levels.wrap_t == TextureWrap::repeat ? level.height - 1 : 0;
  std::array<float, 4> color;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto component = [&](std::ptrdiff_t at) { return levels.words[at] >> kTexelShift[c] & 0xff; };
    const std::ptrdiff_t row = below * level.stride;
    color[c] =
        static_cast<float>((component(0) + component(left) + component(row) + component(row + left)) << 6) /
        kTexelOne;
  }
  return color;
}

std::unique_ptr<TextureState> make_texture(const TextureImage& image, const TextureSampler& sampler) {
  auto texture = std::make_unique<TextureState>();
  TextureLevels& levels = texture->filtered[0].levels;
  texture->channels = image.channels;
  set_filters(levels, sampler);
  levels.gathers_pairs = machine_has_fast_gather();
  texture->texels.resize(lay_out_levels(levels, image, has_mipmaps(sampler)));
  std::uint32_t* const words = texture->texels.data();
  levels.words = words;
  fill_from(image, words, levels.level[0]);
  for (int i = 0; i < levels.last; ++i) fill_next_level(words, levels.level[i], levels.level[i + 1]);
  for (int i = 0; i <= levels.last; ++i) pad_level(words, levels.level[i], levels);
  if (is_one_color(*texture)) texture->one_color = color_of(words[0]);
  if (texture->has_alpha()) texture->is_opaque = is_opaque(*texture);
  for (const TextureCap cap : {TextureCap::as_asked, TextureCap::bilinear, TextureCap::nearest}) {
    FilteredTexture& filtered = texture->filtered[static_cast<std::size_t>(cap)];
    filtered.sampler = capped(sampler, cap);
    filtered.levels = levels;
    set_filters(filtered.levels, filtered.sampler);
    if (!has_mipmaps(filtered.sampler)) filtered.levels.last = 0;
    filtered.at_origin = color_at_origin(filtered.levels);
  }
  return texture;
}

}  // namespace

Texture::Texture(const TextureImage& image, const TextureSampler& sampler) {
  const FloatingPointMode mode;
  check(image, sampler);
  state_ = translate_bad_alloc("Texture", [&] { return make_texture(image, sampler); });
}
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;

int Texture::width() const noexcept { return state_->under(TextureCap::as_asked).levels.level[0].width; }
int Texture::height() const noexcept { return state_->under(TextureCap::as_asked).levels.level[0].height; }
int Texture::channels() const noexcept { return state_->channels; }
const TextureSampler& Texture::sampler() const noexcept {
  return state_->under(TextureCap::as_asked).sampler;
}

}  // namespace tessera
