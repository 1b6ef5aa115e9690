// State of a draw: shading, culling, and the operations that fragments go through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <tessera/enums.hpp>
#include <tessera/stages.hpp>

#include "primitives.hpp"
#include "scene.hpp"
#include "texture.hpp"
#include "types.hpp"

namespace tessera {

/// Where lighting is evaluated. flat: at the provoking vertex, or with the face normal; gouraud: at the
/// vertices; phong: at the pixels, with interpolated normals.
enum class Shading : std::uint8_t { flat, gouraud, phong };
/// Material colours that the vertex colours replace in lit draws. none: vertex colours are ignored.
enum class ColorMaterial : std::uint8_t { none, ambient_and_diffuse, diffuse, ambient, emission, specular };
/// Polygons that are dropped.
enum class Cull : std::uint8_t { none, back, front };
/// Winding of front faces in window coordinates.
enum class FrontFace : std::uint8_t { ccw, cw };

struct DepthState {
  bool enabled = true;  ///< false: neither test nor write. Ignored without a depth buffer
  Compare test = Compare::less;
  bool write = true;
};

/// Stencil test of one face: passes where (ref & mask) func (stored & mask).
/// Values are limited to the buffer's bits.
struct StencilFace {
  Compare func = Compare::always;
  std::uint32_t ref = 0;
  std::uint32_t mask = 255;
  StencilOp fail = StencilOp::keep;   ///< the stencil test fails
  StencilOp zfail = StencilOp::keep;  ///< the stencil test passes, the depth test fails
  StencilOp zpass = StencilOp::keep;  ///< both pass
  std::uint32_t write_mask = 255;
};
struct StencilState {
  StencilFace front{};                ///< front faces, points, lines, bitmaps and images
  std::optional<StencilFace> back{};  ///< back faces; absent: as front
};

/// Blending with the stored colour: computed in floats, clamped to 0 to 1, rounded once.
/// Excludes a LogicOp other than copy.
struct BlendState {
  BlendFactor src = BlendFactor::src_alpha;
  BlendFactor dst = BlendFactor::one_minus_src_alpha;
  std::optional<BlendFactor> src_alpha{};  ///< factor of alpha; absent: src
  std::optional<BlendFactor> dst_alpha{};  ///< factor of alpha; absent: dst
  BlendEquation equation = BlendEquation::add;
  Color color{0, 0, 0, 0};  ///< constant of the factors, components 0 to 1
};

/// Passes where the fragment's alpha func ref. Alpha is the material's diffuse alpha, or that of the vertex
/// colours which replace it, after texturing.
struct AlphaTest {
  Compare func = Compare::greater;
  float ref = 0.5f;  ///< 0 to 1
};

/// Adds factor * (largest depth slope of the polygon) + units * (smallest difference of the depth format) to
/// the depth, which is then clamped to 0 to 1. Needs a depth buffer.
struct PolygonOffset {
  float factor = 0;
  float units = 0;
};

/// Draws the mesh's planar_shadow() in place of the mesh: unlit, untextured, in one colour. The rest of the
/// state applies.
struct ShadowOn {
  std::array<double, 4> plane{};  ///< a b c d of a x + b y + c z + d = 0, world space
  std::size_t light = 0;          ///< number of the light in Frame::set_lights, from 0
  Color color{0, 0, 0, 1};
};

/// State of a draw. Fragments go through, in this order: scissor, alpha test, stencil test, depth test,
/// blending, dither, logic operation, masks.
struct DrawState {
  Material material{};
  std::optional<Material> back_material{};  ///< two-sided lighting: back faces; absent: as material
  Matrix transform{};                       ///< object to world space
  Shading shading = Shading::gouraud;
  bool lighting = true;  ///< false: vertex colours, or the material's diffuse colour
  ColorMaterial color_material = ColorMaterial::none;
  ProvokingVertex provoking_vertex = ProvokingVertex::last;
  bool normalize = true;  ///< false: normals keep their length after the transform; phong normalizes always
  const Texture* texture = nullptr;  ///< borrowed like the mesh; null: none. Ignored where indices are stored
  TextureEnv texture_env = TextureEnv::modulate;
  Color texture_env_color{0, 0, 0, 0};  ///< TextureEnv::blend: constant colour, clamped to 0 to 1
  Cull cull = Cull::none;               ///< points and lines are never culled
  FrontFace front_face = FrontFace::ccw;
  PolygonMode front_mode = PolygonMode::fill;
  PolygonMode back_mode = PolygonMode::fill;
  /// Size of points and width of lines, pixels, above 0; clamped to 65536.
  /// - One sample: rounded; points are squares, lines rows of pixels along x or y.
  /// - Several samples: points are discs, lines rectangles.
  /// - A point is drawn if its centre is inside the view volume; pixels outside the viewport are dropped.
  /// - Polygon offset applies to edges and corners of polygons, not to points and lines of meshes.
  /// - Textures: points use level 0, lines the level of detail along the line.
  float point_size = 1;
  float line_width = 1;
  DepthState depth{};
  double depth_near = 0;  ///< window depth of the near plane, 0 to 1
  double depth_far = 1;   ///< window depth of the far plane, 0 to 1
  PolygonOffset polygon_offset{};
  std::optional<AlphaTest> alpha_test{};  ///< RGB buffers only; absent: off
  std::optional<StencilState> stencil{};  ///< absent: off
  std::optional<BlendState> blend{};      ///< RGB buffers only; absent: off
  LogicOp logic_op = LogicOp::copy;
  /// r g b a: components that may change. Colour-index and luminance buffers: r, g and b must be equal.
  std::array<bool, 4> color_mask{true, true, true, true};
  std::uint32_t plane_mask = 0xffffffffu;  ///< bit k: colour plane k may change; alpha planes follow
  std::optional<Rect> viewport{};          ///< 1 to kMaxFrameBufferSize pixels per side; absent: whole buffer
  std::optional<Rect> scissor{};           ///< absent: whole buffer
  std::optional<ShadowOn> shadow_on{};     ///< absent: the mesh itself is drawn
  /// Functions of yours that run on the vertices and the fragments of the draw; absent: none. Not together
  /// with shadow_on. A fragment stage needs RGB colours: no colour indices and no index lighting.
  std::optional<VertexStage> vertex_stage{};
  std::optional<FragmentStage> fragment_stage{};
};

/// The part of a DrawState that bitmaps and images go through. They are front faces to the stencil test.
struct FragmentState {
  DepthState depth{};
  std::optional<AlphaTest> alpha_test{};
  std::optional<StencilState> stencil{};
  std::optional<BlendState> blend{};
  LogicOp logic_op = LogicOp::copy;
  std::array<bool, 4> color_mask{true, true, true, true};
  std::uint32_t plane_mask = 0xffffffffu;
  std::optional<Rect> scissor{};
};

/// The fragment operations of a draw.
inline FragmentState fragment_state(const DrawState& state) {
  return {.depth = state.depth,
          .alpha_test = state.alpha_test,
          .stencil = state.stencil,
          .blend = state.blend,
          .logic_op = state.logic_op,
          .color_mask = state.color_mask,
          .plane_mask = state.plane_mask,
          .scissor = state.scissor};
}
/// A draw with these fragment operations and defaults otherwise.
inline DrawState draw_state(const FragmentState& fragments) {
  DrawState state;
  state.depth = fragments.depth;
  state.alpha_test = fragments.alpha_test;
  state.stencil = fragments.stencil;
  state.blend = fragments.blend;
  state.logic_op = fragments.logic_op;
  state.color_mask = fragments.color_mask;
  state.plane_mask = fragments.plane_mask;
  state.scissor = fragments.scissor;
  return state;
}

}  // namespace tessera
