// Rest of the table in odd_fields.h: frame buffers, cameras, draws, bitmaps, images, textures, targets and
// renderers.
#include "tests/numerics/odd_fields.h"

namespace tessera::test {
namespace {

void add_draw(Fields& f) {
  [[maybe_unused]] const auto know = [](const DrawState& s, const PolygonOffset& o, const ShadowOn& on,
                                        const Camera& c, const Matrix& m) {
    [[maybe_unused]] const auto& [material, back_material, transform, shading, lighting, color_material,
                                  provoking_vertex, normalize, texture, texture_env, texture_env_color, cull,
                                  front_face, front_mode, back_mode, point_size, line_width, depth,
                                  depth_near, depth_far, polygon_offset, alpha_test, stencil, blend, logic_op,
                                  color_mask, plane_mask, viewport, scissor, shadow_on, vertex_stage,
                                  fragment_stage] = s;  // stages: engine/frame/user_stage_errors_test.cpp
    [[maybe_unused]] const auto& [factor, units] = o;
    [[maybe_unused]] const auto& [plane, light, color] = on;
    [[maybe_unused]] const auto& [view, projection, reversed] = c;
    [[maybe_unused]] const auto& [elements] = m;
  };
  constexpr const char* kCall = "Frame::draw";
  add_fragments(f, "state", kCall, [](InterfaceCase& w) -> DrawState& { return w.state; });
  add_material(f, "material", [](InterfaceCase& w) { return &w.state.material; });
  add_material(f, "back_material",
               [](InterfaceCase& w) { return w.state.back_material ? &*w.state.back_material : nullptr; });
  f.numbers(
      "transform", kCall, 16, [](InterfaceCase& w) { return w.state.transform.m.data(); }, finite);
  f.numbers(
      "camera.view", "Frame::set_camera", 16, [](InterfaceCase& w) { return w.camera.view.m.data(); },
      finite);
  f.numbers(
      "camera.projection", "Frame::set_camera", 16,
      [](InterfaceCase& w) { return w.camera.projection.m.data(); }, finite);
  f.color(
      "texture_env_color", kCall, [](InterfaceCase& w) { return &w.state.texture_env_color; }, finite);
  f.number(
      "point_size", kCall, [](InterfaceCase& w) { return &w.state.point_size; }, above_zero);
  f.number(
      "line_width", kCall, [](InterfaceCase& w) { return &w.state.line_width; }, above_zero);
  f.number(
      "depth_near", kCall, [](InterfaceCase& w) { return &w.state.depth_near; }, within(0, 1));
  f.number(
      "depth_far", kCall, [](InterfaceCase& w) { return &w.state.depth_far; }, within(0, 1));
  f.number(
      "polygon_offset.factor", kCall, [](InterfaceCase& w) { return &w.state.polygon_offset.factor; },
      finite);
  f.number(
      "polygon_offset.units", kCall, [](InterfaceCase& w) { return &w.state.polygon_offset.units; }, finite);
  f.rect(
      "viewport", kCall, [](InterfaceCase& w) { return &w.state.viewport; }, within(-16384, 16384),
      within(1, 16384));
  f.numbers(
      "shadow_on.plane", kCall, 4,
      [](InterfaceCase& w) { return w.state.shadow_on ? w.state.shadow_on->plane.data() : nullptr; },
      finite_for_shadow);
  f.color(
      "shadow_on.color", kCall,
      [](InterfaceCase& w) { return w.state.shadow_on ? &w.state.shadow_on->color : nullptr; }, finite);
  f.number(
      "shadow_on.light", kCall,
      [](InterfaceCase& w) { return w.state.shadow_on ? &w.state.shadow_on->light : nullptr; },
      [](double v) { return v < 2 ? Verdict::either : Verdict::refused; });
  f.choice(
      "shading", kCall, [](InterfaceCase& w) { return &w.state.shading; }, Shading::phong);
  f.choice(
      "color_material", kCall, [](InterfaceCase& w) { return &w.state.color_material; },
      ColorMaterial::specular);
  f.choice(
      "provoking_vertex", kCall, [](InterfaceCase& w) { return &w.state.provoking_vertex; },
      ProvokingVertex::first);
  f.choice(
      "texture_env", kCall, [](InterfaceCase& w) { return &w.state.texture_env; }, TextureEnv::add);
  f.choice(
      "cull", kCall, [](InterfaceCase& w) { return &w.state.cull; }, Cull::front);
  f.choice(
      "front_face", kCall, [](InterfaceCase& w) { return &w.state.front_face; }, FrontFace::cw);
  f.choice(
      "front_mode", kCall, [](InterfaceCase& w) { return &w.state.front_mode; }, PolygonMode::point);
  f.choice(
      "back_mode", kCall, [](InterfaceCase& w) { return &w.state.back_mode; }, PolygonMode::point);
  f.choice(
      "mesh.primitive", kCall, [](InterfaceCase& w) { return &w.data.primitive; }, Primitive::polygon);
}

/// Strides that are too short for rows of `row` bytes; memory outside the image would be read.
std::vector<std::ptrdiff_t> short_strides(std::ptrdiff_t row) { return {1, -1, row - 1, 1 - row, 2}; }

void add_pixels(Fields& f) {
  [[maybe_unused]] const auto know = [](const Bitmap& b, const PixelImage& p, const TextureImage& t,
                                        const TextureSampler& s, const ImageTarget& i) {
    [[maybe_unused]] const auto& [bits, bitmap_width, bitmap_height, bitmap_stride, bitmap_x, bitmap_y,
                                  bitmap_depth, color] = b;
    [[maybe_unused]] const auto& [pixels, width, height, channels, stride, x, y, zoom_x, zoom_y, depth] = p;
    [[maybe_unused]] const auto& [texels, texture_width, texture_height, texture_channels, texture_stride,
                                  bottom_row_first] = t;
    [[maybe_unused]] const auto& [mag, min, wrap_s, wrap_t] = s;
    [[maybe_unused]] const auto& [memory, target_width, target_height, target_stride, order, region] = i;
  };
  constexpr const char* kBitmap = "Frame::draw_bitmap";
  constexpr const char* kImage = "Frame::draw_image";
  constexpr const char* kTexture = "Texture";
  constexpr const char* kFinish = "Renderer::finish";
  const auto refused = [](double) { return Verdict::refused; };
  add_fragments(f, "fragments", kBitmap, [](InterfaceCase& w) -> FragmentState& { return w.fragments; });
  f.number(
      "bitmap.width", kBitmap, [](InterfaceCase& w) { return &w.bitmap.width; }, within(1, 16384));
  f.number(
      "bitmap.height", kBitmap, [](InterfaceCase& w) { return &w.bitmap.height; }, within(1, 16384));
  f.number("bitmap.stride_bytes", kBitmap, [](InterfaceCase& w) { return &w.bitmap.stride_bytes; }, refused,
           {1, -1});
  f.number(
      "bitmap.x", kBitmap, [](InterfaceCase& w) { return &w.bitmap.x; }, finite);
  f.number(
      "bitmap.y", kBitmap, [](InterfaceCase& w) { return &w.bitmap.y; }, finite);
  f.number(
      "bitmap.depth", kBitmap, [](InterfaceCase& w) { return &w.bitmap.depth; }, within(0, 1));
  f.color(
      "bitmap.color", kBitmap, [](InterfaceCase& w) { return &w.bitmap.color; }, finite);
  f.number(
      "image.width", kImage, [](InterfaceCase& w) { return &w.pixels.width; }, within(1, 16384));
  f.number(
      "image.height", kImage, [](InterfaceCase& w) { return &w.pixels.height; }, within(1, 16384));
  f.number(
      "image.channels", kImage, [](InterfaceCase& w) { return &w.pixels.channels; }, within(1, 4));
  f.number(
      "image.stride_bytes", kImage, [](InterfaceCase& w) { return &w.pixels.stride_bytes; }, refused,
      short_strides(7 * 4));
  for (double PixelImage::*member :
       {&PixelImage::x, &PixelImage::y, &PixelImage::zoom_x, &PixelImage::zoom_y})
    f.number(
        "image's place", kImage, [member](InterfaceCase& w) { return &(w.pixels.*member); }, finite);
  f.number(
      "image.depth", kImage, [](InterfaceCase& w) { return &w.pixels.depth; }, within(0, 1));
  const auto texture = [](auto member) {
    return [member](InterfaceCase& w) { return w.textured ? &(w.image.*member) : nullptr; };
  };
  f.number("texture.width", kTexture, texture(&TextureImage::width), within(1, 16384));
  f.number("texture.height", kTexture, texture(&TextureImage::height), within(1, 16384));
  f.number("texture.channels", kTexture, texture(&TextureImage::channels), within(1, 4));
  f.number("texture.stride_bytes", kTexture, texture(&TextureImage::stride_bytes), refused,
           short_strides(8 * 4));
  const auto sampler = [](auto member) {
    return [member](InterfaceCase& w) { return w.textured ? &(w.sampler.*member) : nullptr; };
  };
  f.choice("sampler.min", kTexture, sampler(&TextureSampler::min), TextureFilter::linear_mipmap_linear);
  f.choice("sampler.mag", kTexture, sampler(&TextureSampler::mag), TextureFilter::linear_mipmap_linear);
  f.choice("sampler.wrap_s", kTexture, sampler(&TextureSampler::wrap_s), TextureWrap::mirrored_repeat);
  f.choice("sampler.wrap_t", kTexture, sampler(&TextureSampler::wrap_t), TextureWrap::mirrored_repeat);
  const std::vector<int> no_size{
      -1, 1, 47, 49, 16384, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
  f.number(
      "target.width", kFinish, [](InterfaceCase& w) { return &w.target.width; }, refused, no_size);
  f.number(
      "target.height", kFinish, [](InterfaceCase& w) { return &w.target.height; }, refused, no_size);
  f.number(
      "target.stride_bytes", kFinish, [](InterfaceCase& w) { return &w.target.stride_bytes; }, refused,
      short_strides(4 * 48));
  f.choice(
      "target.order", kFinish, [](InterfaceCase& w) { return &w.target.order; }, PixelOrder::bgra8);
  f.rect(
      "target.region", kFinish, [](InterfaceCase& w) { return &w.target.region; }, anything, not_negative);
}

void add_buffer_and_renderer(Fields& f) {
  [[maybe_unused]] const auto know = [](const FrameBufferFormat& b, const RendererOptions& o) {
    [[maybe_unused]] const auto& [width, height, color_mode, color_bits, palette, depth, stencil_bits,
                                  alpha_bits, dither, dither_in, dither_gamma, accumulation_bits, samples] =
        b;
    [[maybe_unused]] const auto& [threads, tile_size, instruction_set, elide, bin_memory, debug, executor,
                                  progress, log, trace] = o;
  };
  constexpr const char* kBuffer = "FrameBuffer";
  constexpr const char* kRenderer = "Renderer";
  const auto refused = [](double) { return Verdict::refused; };
  // Valid values are tested elsewhere, together with matching values of the following fields.
  f.number(
      "format.width", kBuffer, [](InterfaceCase& w) { return &w.format.width; }, within(1, 16384));
  f.number(
      "format.height", kBuffer, [](InterfaceCase& w) { return &w.format.height; }, within(1, 16384));
  f.number("format.color_bits", kBuffer, [](InterfaceCase& w) { return &w.format.color_bits; }, refused,
           {0, -1, 25, 1 << 30, std::numeric_limits<int>::min()});
  f.number("format.stencil_bits", kBuffer, [](InterfaceCase& w) { return &w.format.stencil_bits; }, refused,
           {-1, 9, 1 << 30, std::numeric_limits<int>::min()});
  f.number("format.alpha_bits", kBuffer, [](InterfaceCase& w) { return &w.format.alpha_bits; }, refused,
           {-8, 1, 7, 9, 16, std::numeric_limits<int>::max()});
  f.number("format.accumulation_bits", kBuffer, [](InterfaceCase& w) { return &w.format.accumulation_bits; },
           refused, {-16, 1, 8, 24, 64, std::numeric_limits<int>::max()});
  f.number("format.samples", kBuffer, [](InterfaceCase& w) { return &w.format.samples; }, refused,
           {0, -4, 2, 3, 16, std::numeric_limits<int>::max()});
  f.color(
      "format.palette[1]", kBuffer,
      [](InterfaceCase& w) { return w.format.palette.empty() ? nullptr : &w.format.palette[1]; },
      within(0, 1));
  f.choice(
      "format.color_mode", kBuffer, [](InterfaceCase& w) { return &w.format.color_mode; }, ColorMode::index);
  f.choice(
      "format.depth", kBuffer, [](InterfaceCase& w) { return &w.format.depth; }, DepthFormat::float32);
  f.choice(
      "format.dither", kBuffer, [](InterfaceCase& w) { return &w.format.dither; }, Dither::pattern);
  f.choice(
      "format.dither_in", kBuffer, [](InterfaceCase& w) { return &w.format.dither_in; }, DitherSpace::light);
  f.number(
      "format.dither_gamma", kBuffer, [](InterfaceCase& w) { return &w.format.dither_gamma; },
      [](double v) { return v == 0 || (v >= 1 && v <= 4) ? Verdict::fine : Verdict::refused; });
  f.choice(
      "kept buffers", "Frame::keep", [](InterfaceCase& w) { return &w.kept[2]; }, Buffer::accumulation);
  f.number("options.threads", kRenderer, [](InterfaceCase& w) { return &w.options.threads; }, within(0, 1024),
           {-1, 0, 2, 7, 1025, 1 << 30, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()});
  f.number(
      "options.tile_size", kRenderer, [](InterfaceCase& w) { return &w.options.tile_size; },
      [](double v) { return v == 0 || v == 32 || v == 64 || v == 128 ? Verdict::fine : Verdict::refused; },
      {-32, 0, 1, 16, 32, 33, 64, 96, 128, 256, std::numeric_limits<int>::max(),
       std::numeric_limits<int>::min()});
  f.number(
      "options.bin_memory", kRenderer, [](InterfaceCase& w) { return &w.options.bin_memory; },
      [](double v) { return v >= kMinBinMemory ? Verdict::fine : Verdict::refused; },
      {0, 1, kMinBinMemory - 1, kMinBinMemory, std::size_t{1} << 40,
       std::numeric_limits<std::size_t>::max()});
  f.number("options.debug.task_order", kRenderer,
           [](InterfaceCase& w) { return &w.options.debug.task_order; }, anything,
           {0, 1, 48, std::numeric_limits<std::uint32_t>::max()});
}

}  // namespace

std::vector<Field> all_fields() {
  Fields fields;
  add_buffer_and_renderer(fields);
  add_draw(fields);
  add_lights(fields);
  add_clear_and_accum(fields);
  add_pixels(fields);
  return fields.all;
}

}  // namespace tessera::test
