#include "tests/fuzz/pipeline_state.h"

#include <cmath>

#include "tests/fuzz/target.h"

namespace tessera::fuzz {

Color StateReader::any_color() {
  if (from_.byte() < 224) return unit_color();
  const float r = from_.finite32(), g = from_.finite32(), b = from_.finite32();
  return {r, g, b, from_.finite32()};
}

Color StateReader::unit_color() {
  const float r = from_.unit(), g = from_.unit(), b = from_.unit();
  return {r, g, b, from_.unit()};
}

// Most are made by the interface's functions; the identity replaces those that it refuses.
Matrix StateReader::matrix() {
  Matrix result;
  const auto number = [&] { return from_.finite(); };
  error_of([&] {
    switch (from_.below(8)) {
      case 0: break;
      case 1: {
        const double x = number(), y = number();
        result = translate(x, y, number());
        break;
      }
      case 2: {
        const double x = number(), y = number();
        result = scale(x, y, number());
        break;
      }
      case 3: {
        const double degrees = 90 * number();
        const double x = number();
        const double y = number();
        result = rotate(degrees, x, y, number());
        break;
      }
      case 4: {
        const Matrix left = matrix();
        result = from_.empty() ? left : left * matrix();
        break;
      }
      case 5: {
        Light from;
        for (float& x : from.position) x = from_.finite32();
        const double a = number();
        const double b = number();
        const double c = number();
        result = planar_shadow({a, b, c, number()}, from);
        break;
      }
      default:
        for (double& x : result.m) x = number();
    }
  });
  return result;
}

Camera StateReader::camera() {
  Camera camera;
  camera.reversed = from_.coin();
  const auto number = [&] { return from_.finite(); };
  error_of([&] {
    switch (from_.below(6)) {
      case 0: break;
      case 1: {
        const double fovy = 60 + 30 * number();
        const double near = from_.coin() ? 0.5 : number();
        const double far = from_.coin() ? 10 : from_.real();
        camera.projection = perspective(fovy, 1, near, far, camera.reversed);
        break;
      }
      case 2: {
        const double near = from_.coin() ? -4 : number();
        const double half = from_.coin() ? 2 : number();
        camera.projection =
            orthographic(-half, half, -half, half, near, from_.coin() ? 4 : number(), camera.reversed);
        break;
      }
      case 3: {
        Intrinsics lens{.fx = 20 + number(),
                        .fy = 20 + number(),
                        .cx = 16 + number(),
                        .cy = 16 + number(),
                        .width = format_.width,
                        .height = format_.height};
        camera = calibrated_camera(lens, matrix(), 0.25, from_.real(),
                                   from_.coin() ? CameraAxes::opencv : CameraAxes::opengl, camera.reversed);
        return;
      }
      default: camera.projection = matrix();
    }
    if (from_.coin()) {
      const Vec3 eye{number(), number(), 3 + number()};
      const Vec3 target{number(), number(), number()};
      camera.view = look_at(eye, target, {0, 1, 0});
    } else {
      camera.view = matrix();
    }
  });
  return camera;
}

Light StateReader::light() {
  Light light;
  light.diffuse = any_color();
  const int has = from_.byte();
  if ((has & 1) != 0) light.ambient = any_color();
  if ((has & 2) != 0) light.specular = any_color();
  if ((has & 4) != 0)
    for (float& x : light.position) x = from_.finite32();
  if ((has & 8) != 0) {
    for (float& x : light.spot_direction) x = from_.finite32();
    light.spot_cutoff = from_.coin() ? static_cast<float>(from_.below(91)) : from_.finite32();
    light.spot_exponent = from_.coin() ? static_cast<float>(from_.byte()) : from_.finite32();
  }
  if ((has & 16) != 0) {
    light.attenuation_constant = from_.finite32();
    light.attenuation_linear = from_.finite32();
    light.attenuation_quadratic = from_.finite32();
  }
  return light;
}

LightModel StateReader::light_model() {
  LightModel model;
  model.ambient = any_color();
  const int has = from_.byte();
  model.local_viewer = (has & 1) != 0;
  model.two_sided = (has & 2) != 0;
  model.specular = (has & 4) != 0 ? SpecularModel::phong : SpecularModel::blinn;
  return model;
}

Rect StateReader::rect() {
  const int x = from_.integer(-8, format_.width);
  const int y = from_.integer(-8, format_.height);
  const int width = from_.integer(0, format_.width + 8);
  return {x, y, width, from_.integer(0, format_.height + 8)};
}

std::optional<Rect> StateReader::scissor() {
  if (window_) return window_;
  if (from_.coin()) return std::nullopt;
  return rect();
}

// Sizes of points and lines.
float StateReader::size() {
  const float x = from_.finite32();
  return x == 0 ? 1 : std::abs(x);
}

Material StateReader::material() {
  Material material;
  material.diffuse = any_color();
  const int has = from_.byte();
  if ((has & 1) != 0) material.ambient = any_color();
  if ((has & 2) != 0) {
    material.specular = any_color();
    material.shininess = (has & 16) != 0 ? from_.finite32() : static_cast<float>(from_.byte());
  }
  if ((has & 4) != 0) material.emission = any_color();
  if ((has & 8) != 0) material.index_ramp = {{from_.finite32(), from_.finite32(), from_.finite32()}};
  return material;
}

StencilFace StateReader::stencil_face() {
  StencilFace face;
  face.func = from_.one_of<Compare>(8);
  const int ops = from_.byte();
  face.fail = static_cast<StencilOp>(ops & 7);
  face.zfail = static_cast<StencilOp>(ops >> 3 & 7);
  face.zpass = from_.one_of<StencilOp>(8);
  face.ref = from_.rarely() ? from_.word() : from_.byte();
  if (from_.coin()) face.mask = from_.rarely() ? from_.word() : from_.byte();
  if (from_.coin()) face.write_mask = from_.rarely() ? from_.word() : from_.byte();
  return face;
}

std::array<bool, 4> StateReader::color_mask() {
  const int bits = from_.byte();
  const bool alike = is_index() || format_.color_bits <= 2;
  const bool red = (bits & 1) != 0;
  if (alike && bits < 252) return {red, red, red, (bits & 8) != 0};
  return {red, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
}

DepthState StateReader::depth_state() {
  const int bits = from_.byte();
  return {.enabled = (bits & 0x30) != 0, .test = static_cast<Compare>(bits & 7), .write = (bits & 8) == 0};
}

void StateReader::read_operations(DrawState& state) {
  state.scissor = scissor();
  state.depth = depth_state();
  if (wants(!is_index())) {
    state.alpha_test = AlphaTest{.func = from_.one_of<Compare>(8)};
    state.alpha_test->ref = from_.unit();
  }
  if (wants(format_.stencil_bits > 0)) {
    state.stencil = StencilState{.front = stencil_face()};
    if (from_.coin()) state.stencil->back = stencil_face();
  }
  if (wants(!is_index())) {
    BlendState blend;
    blend.src = from_.one_of<BlendFactor>(15);
    blend.dst = from_.one_of<BlendFactor>(15);
    if (from_.coin()) blend.src_alpha = from_.one_of<BlendFactor>(15);
    if (from_.coin()) blend.dst_alpha = from_.one_of<BlendFactor>(15);
    blend.equation = from_.one_of<BlendEquation>(5);
    blend.color = unit_color();
    state.blend = blend;
  } else if (from_.byte() % 4 == 0) {
    state.logic_op = from_.one_of<LogicOp>(16);
  }
  if (from_.byte() % 4 == 0) state.color_mask = color_mask();
  if (from_.byte() % 4 == 0) state.plane_mask = from_.word();
}

DrawState StateReader::draw_state(const std::deque<Texture>& textures) {
  DrawState state;
  read_operations(state);
  const int how = from_.byte();
  const int shape = from_.byte();
  const int more = from_.byte();
  state.shading = static_cast<Shading>((how & 3) % 3);
  state.lighting = (how & 4) == 0;
  state.normalize = (how & 8) == 0;
  state.provoking_vertex = static_cast<ProvokingVertex>(how >> 4 & 1);
  state.front_face = static_cast<FrontFace>(how >> 5 & 1);
  state.cull = Cull::none;
  if ((how & 0x80) != 0) state.cull = (how & 0x40) != 0 ? Cull::back : Cull::front;
  state.front_mode = static_cast<PolygonMode>((shape & 3) % 3);
  state.back_mode = static_cast<PolygonMode>((shape >> 2 & 3) % 3);
  state.color_material = static_cast<ColorMaterial>((shape >> 4 & 7) % 6);
  if ((more & 1) != 0) state.transform = matrix();
  if ((more & 2) != 0) state.material = material();
  if ((more & 4) != 0) state.back_material = material();
  if ((more & 8) != 0 && !textures.empty()) {
    state.texture = &textures[static_cast<std::size_t>(from_.below(static_cast<int>(textures.size())))];
    state.texture_env = from_.one_of<TextureEnv>(5);
    if (state.texture_env == TextureEnv::blend) state.texture_env_color = any_color();
  }
  if ((more & 16) != 0) {
    state.point_size = size();
    state.line_width = size();
  }
  if ((more & 32) != 0) {
    state.depth_near = from_.unit();
    state.depth_far = from_.unit();
  }
  if ((more & 64) != 0) {
    state.viewport = rect();
    if (state.viewport->width == 0) state.viewport->width = format_.width;
    if (state.viewport->height == 0) state.viewport->height = format_.height;
    // A viewport inside the window needs no scissor.
    if (window_ && from_.coin()) {
      state.viewport = window_;
      state.scissor.reset();
    }
  }
  if ((more & 128) != 0) {
    if (format_.depth != DepthFormat::none || from_.rarely())
      state.polygon_offset = {from_.finite32(), from_.finite32()};
    if (from_.byte() % 4 == 0) {
      ShadowOn shadow;
      for (double& x : shadow.plane) x = from_.finite();
      shadow.light = static_cast<std::size_t>(from_.integer(0, 2));
      shadow.color = any_color();
      state.shadow_on = shadow;
    }
  }
  return state;
}

FragmentState StateReader::fragment_state() {
  DrawState s;
  read_operations(s);
  return {.depth = s.depth,
          .alpha_test = s.alpha_test,
          .stencil = s.stencil,
          .blend = s.blend,
          .logic_op = s.logic_op,
          .color_mask = s.color_mask,
          .plane_mask = s.plane_mask,
          .scissor = s.scissor};
}

Clear StateReader::clear() {
  Clear clear;
  clear.scissor = scissor();
  if (wants(true)) clear.color = unit_color();
  if (wants(is_index()))
    clear.index = from_.rarely() ? from_.word() : from_.word() % (1u << format_.color_bits);
  if (wants(format_.depth != DepthFormat::none)) clear.depth = from_.unit();
  if (wants(format_.stencil_bits > 0))
    clear.stencil = from_.rarely() ? from_.word() : from_.byte() % (1u << format_.stencil_bits);
  if (wants(format_.accumulation_bits > 0)) {
    clear.accumulation = unit_color();
    if (from_.coin()) clear.accumulation->g = -clear.accumulation->g;
  }
  return clear;
}

Accum StateReader::accum() {
  Accum accum;
  accum.op = from_.one_of<AccumOp>(5);
  accum.value = from_.coin() ? from_.unit() : from_.finite();
  accum.scissor = scissor();
  if (from_.coin()) accum.color_mask = color_mask();
  return accum;
}

}  // namespace tessera::fuzz
