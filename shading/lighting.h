// The lighting equation as a program: a short list of terms, each with the stages that this light needs with
// this material. One program lights the vertices of flat and Gouraud draws and the pixels of Phong draws.
//
//   colour = emission_m + ambient_scene * ambient_m
//          + sum over lights of att * spot * ( ambient_i * ambient_m
//                                            + max(L.n, 0) * diffuse_i * diffuse_m
//                                            + spec * specular_i * specular_m )
//
// Lighting of indices sums the luminances of the lights:
//
//   d     = sum over lights of att * spot * max(L.n, 0) * diffuse_i
//   s     = sum over lights of att * spot * spec * specular_i
//   index = min(a_m + d (1 - s) (d_m - a_m) + s (s_m - a_m), s_m)
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "shading/effect_notes.h"
#include "shading/power.h"

namespace tessera::detail {

/// Points that are lit at a time: vertices, or the pixels of eight blocks.
inline constexpr int kBatchPoints = 128;

/// Fields of a batch's points. Vectors are in eye space.
enum BatchField : std::uint8_t {
  kNormalX,
  kNormalY,
  kNormalZ,
  kPositionX,
  kPositionY,
  kPositionZ,
  // Vertex colour, which replaces tracked colours of the material.
  kVertexR,
  kVertexG,
  kVertexB,
  // Unit vector towards a local viewer.
  kViewX,
  kViewY,
  kViewZ,
  kNormalDotView,
  // The sum, then the result: a colour 0..1, or a masked index in red.
  kColorR,
  kColorG,
  kColorB,
  // The sum of the terms that the vertex colour multiplies.
  kTrackedR,
  kTrackedG,
  kTrackedB,
  kTextureS,
  kTextureT,
  // Squared footprint of a pixel in texels of level 0, the larger of both window axes.
  kFootprintSquared,
  kTexelR,
  kTexelG,
  kTexelB,
  kTexelA,
  kBatchFields
};
struct alignas(64) ShadingBatch {
  float field[kBatchFields][kBatchPoints];
};

using Rgb = std::array<float, 3>;
constexpr Rgb operator*(const Rgb& a, const Rgb& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
constexpr Rgb operator*(const Rgb& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }
constexpr Rgb operator+(const Rgb& a, const Rgb& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
constexpr bool is_black(const Rgb& c) { return c[0] == 0 && c[1] == 0 && c[2] == 0; }

/// A light in eye space.
struct EyeLight {
  Rgb ambient{0, 0, 0}, diffuse{1, 1, 1}, specular{1, 1, 1};
  bool directional = true;
  std::array<float, 3> position{0, 0, 1};         ///< or the unit vector towards a directional light
  std::array<float, 3> spot_direction{0, 0, -1};  ///< unit
  float spot_exponent = 0;
  float spot_cutoff = 180;                    ///< degrees; 180: no cone
  std::array<float, 3> attenuation{1, 0, 0};  ///< constant, linear, quadratic
};

struct SurfaceMaterial {
  Rgb ambient{0.2f, 0.2f, 0.2f}, diffuse{0.8f, 0.8f, 0.8f}, specular{0, 0, 0}, emission{0, 0, 0};
  float shininess = 0;
};

/// Colours of the material that the vertex colour replaces.
struct TrackedColors {
  bool ambient = false, diffuse = false, specular = false, emission = false;
  bool any() const { return ambient || diffuse || specular || emission; }
};

struct LightingModel {
  Rgb scene_ambient{0.2f, 0.2f, 0.2f};
  bool local_viewer = false;
  bool phong_highlight = false;   ///< (R.E)^shininess instead of (S.n)^shininess
  bool unit_normals = false;      ///< lit normals have length 1 or 0
  bool viewer_is_capped = false;  ///< Quality::viewer replaces a local viewer; for notes
};

/// Above this shininess highlights of unit normals are computed from the distance of two vectors: the
/// rounding error of their cosine, times the exponent, would be visible.
inline constexpr float kSharpShininess = 2048;

/// Below this cutoff, in degrees, a cone is tested by the distance of vectors: cosines near 1 are too coarse.
inline constexpr float kNarrowCone = 1;

/// Upper bound of all factors of a light's contribution (n.L, distance, attenuation, cone, highlight,
/// colours), so that a product with black is 0 and not NaN.
inline constexpr float kMaxFloat = std::numeric_limits<float>::max();

enum class LightKind : std::uint8_t { directional, point, attenuated_point, spot, attenuated_spot };
enum class HighlightKind : std::uint8_t { none, blinn_infinite, blinn_local, phong_infinite, phong_local };
inline constexpr int kLightKinds = 5;
inline constexpr int kHighlightKinds = 5;
constexpr bool is_spot(LightKind kind) {
  return kind == LightKind::spot || kind == LightKind::attenuated_spot;
}

/// One light on one material, with products of colours and other constants folded.
struct LightTerm {
  LightKind kind = LightKind::directional;
  HighlightKind highlight = HighlightKind::none;
  /// Shininess above kSharpShininess, unit normals: S.n or R.E is computed from the distance of the vectors.
  bool sharp = false;
  /// The highlight is ((S.n)^2)^(shininess / 2), which needs no root. Set for unit normals if S varies and no
  /// visible highlight has a square below 2^-126.
  bool squared = false;
  std::array<float, 3> position{};     ///< as in EyeLight
  std::array<float, 3> half_vector{};  ///< directional light, infinite viewer, Blinn: normalize(L + (0,0,1))
  std::array<float, 3> spot_direction{};
  std::array<float, 3> attenuation{};
  float spot_cosine = 0;
  /// Cones below kNarrowCone: largest squared distance of -L and the cone's axis. 0: spot_cosine decides.
  float spot_chord_squared = 0;
  Power spot_power;       ///< applied to the cosine of the angle to the axis
  Power highlight_power;  ///< applied to the base of the highlight: S.n, its square or R.E
  /// Bases at or below this value contribute no highlight: base^shininess * factor < 2^-32, or the base is
  /// below 2^-126. NaN if shininess is 0: the comparison is then never true, and every base contributes 1.
  float highlight_floor = 0;
  Rgb ambient{}, diffuse{}, specular{};  ///< light times material; black where tracked
  /// Colours of the light, to be multiplied by the vertex colour; black where not tracked.
  Rgb tracked_ambient{}, tracked_diffuse{}, tracked_specular{};
};

/// Lighting of one surface: the front or back of a material under a list of lights.
struct LightingProgram {
  bool renormalize = false;    ///< normals were interpolated
  bool negate_normal = false;  ///< a back face
  bool needs_normal = false, needs_position = false, needs_view = false;
  bool tracked = false;  ///< any colour of the material is the vertex colour
  Rgb base{};            ///< sum of the constant terms
  Rgb tracked_base{};    ///< sum of the constant terms that the vertex colour multiplies
  std::vector<LightTerm> terms;
  bool index = false;                     ///< the result is an index: d is summed in red, s in green
  std::array<float, 3> indexes{0, 1, 1};  ///< ambient, diffuse, specular
  float index_modulus = 2;                ///< 2^bits of the buffer
};

/// Proven reach of a light on a surface (light_reach.h).
enum class LightReach : std::uint8_t {
  unknown,
  behind,          ///< behind every normal: no diffuse and no specular light
  outside_cone,    ///< every point is outside the light's cone: no light at all
  below_threshold  ///< so weak that the draw does without it
};

/// Plans a surface: the program holds only what lights and material need.
/// @param notes         receives the effects of each light
/// @param term_storage  memory for the terms; its contents are discarded
/// @param reach         per light; empty: nothing is proven
LightingProgram plan_lighting(const SurfaceMaterial& material, const TrackedColors& tracked,
                              const std::vector<EyeLight>& lights, const LightingModel& model,
                              const EffectNotes& notes, std::vector<LightTerm> term_storage = {},
                              std::span<const LightReach> reach = {});

/// The material of a surface whose colour is an index.
struct IndexMaterial {
  std::array<float, 3> indexes{0, 1, 1};  ///< ambient, diffuse, specular
  float shininess = 0;
  float modulus = 2;  ///< 2^bits of the buffer
};
/// plan_lighting() for lighting of indices.
LightingProgram plan_index_lighting(const IndexMaterial& material, const std::vector<EyeLight>& lights,
                                    const LightingModel& model, const EffectNotes& notes,
                                    std::vector<LightTerm> term_storage = {},
                                    std::span<const LightReach> reach = {});

/// Lights the first `count` points of the batch, whole vectors of lanes: reads the fields that the program
/// needs, writes the colour or index. Unused points may hold any bits. Bit-identical to
/// light_point_reference() on every instruction set.
using LightPoints = void(const LightingProgram& program, ShadingBatch& batch, int count);
LightPoints* light_points(InstructionSet isa);

}  // namespace tessera::detail
