// The lighting equation as a program: a short list of terms, each by stages that hold only what that light
// needs with that material. One program lights the vertices of flat and Gouraud draws and the pixels of Phong
// draws.
//
//   colour = emission_m + ambient_scene * ambient_m
//          + sum over lights of att * spot * ( ambient_i * ambient_m + max(L.n, 0) * diffuse_i * diffuse_m +
//          spec * specular_i * specular_m )
//
// Lighting of indices sums the lights' luminances: d = sum of att * spot * max(L.n, 0) * diffuse_i, s
// likewise of the highlights, index = min(a_m + d (1 - s) (d_m - a_m) + s (s_m - a_m), s_m).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "framebuffer/instruction_set.h"
#include "shading/effect_notes.h"
#include "shading/power.h"

namespace tessera::detail {

inline constexpr int kBatchPoints = 128;  ///< points lit at a time: vertices, or the pixels of eight blocks

/// Structure of arrays: what is known of each point, and its colour. Eye space.
enum BatchField : std::uint8_t {
  kNormalX,
  kNormalY,
  kNormalZ,
  kPositionX,
  kPositionY,
  kPositionZ,
  kVertexR,
  kVertexG,
  kVertexB,  // the vertex colour, where it stands for a material's colour
  kViewX,
  kViewY,
  kViewZ,  // towards a local viewer, unit
  kNormalDotView,
  kColorR,
  kColorG,
  kColorB,  // the sum; the result, clamped to 0..1, or a masked index in the first
  kTrackedR,
  kTrackedG,
  kTrackedB,  // the sum of what the vertex colour multiplies
  kTextureS,
  kTextureT,          // texture coordinates
  kFootprintSquared,  // the larger square of how many texels of level 0 one goes by, by pixels to the right
                      // and up
  kTexelR,
  kTexelG,
  kTexelB,
  kTexelA,  // of the texture there
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
  std::array<float, 3> position{0, 0, 1};         ///< of a point; the unit vector towards a directional light
  std::array<float, 3> spot_direction{0, 0, -1};  ///< unit
  float spot_exponent = 0;
  float spot_cutoff = 180;                    ///< degrees
  std::array<float, 3> attenuation{1, 0, 0};  ///< constant, linear, quadratic
};

struct SurfaceMaterial {
  Rgb ambient{0.2f, 0.2f, 0.2f}, diffuse{0.8f, 0.8f, 0.8f}, specular{0, 0, 0}, emission{0, 0, 0};
  float shininess = 0;
};

/// Which of a material's colours the vertex colour replaces.
struct TrackedColors {
  bool ambient = false, diffuse = false, specular = false, emission = false;
  bool any() const { return ambient || diffuse || specular || emission; }
};

struct LightingModel {
  Rgb scene_ambient{0.2f, 0.2f, 0.2f};
  bool local_viewer = false;
  bool phong_highlight = false;  ///< (R.E)^shininess instead of (S.n)^shininess
  bool unit_normals = false;     ///< normals that are lit have length 1, or none
};

/// Above this highlights of unit normals are measured by how far vectors are apart: a cosine's own roundings,
/// times the exponent, would begin to show.
inline constexpr float kSharpShininess = 2048;

/// Below this angle in degrees a point is in a spot's cone by how far vectors are apart: their cosine, near
/// 1, is too coarse.
inline constexpr float kNarrowCone = 1;

/// What a light brings to a point is cut here, and what that is made of: n.L, distance, attenuation, cone,
/// highlight; and its colours, and vertex colours. Times black it is nothing then, and not NaN.
inline constexpr float kMaxFloat = std::numeric_limits<float>::max();

enum class LightKind : std::uint8_t { directional, point, attenuated_point, spot, attenuated_spot };
enum class HighlightKind : std::uint8_t { none, blinn_infinite, blinn_local, phong_infinite, phong_local };
inline constexpr int kLightKinds = 5, kHighlightKinds = 5;
constexpr bool is_spot(LightKind kind) {
  return kind == LightKind::spot || kind == LightKind::attenuated_spot;
}

/// One light on one material: products are taken, constants are folded.
struct LightTerm {
  LightKind kind = LightKind::directional;
  HighlightKind highlight = HighlightKind::none;
  // Two other ways to a highlight of unit normals than the power of S.n or R.E:
  bool sharp = false;    ///< above kSharpShininess, by the distance of n and S, or R and E
  bool squared = false;  ///< ((S.n)^2)^(s/2), without a root, where S differs from point to point and no
                         ///< power that is seen comes from a square below 2^-126
  std::array<float, 3> position{};     ///< or direction
  std::array<float, 3> half_vector{};  ///< directional light, infinite viewer, Blinn: normalize(L + (0,0,1))
  std::array<float, 3> spot_direction{};
  std::array<float, 3> attenuation{};
  float spot_cosine = 0;
  float spot_chord_squared = 0;  ///< of a cone below kNarrowCone: the square of how far -L and its direction
                                 ///< may be apart; 0: spot_cosine counts
  Power spot_power, highlight_power;  ///< of the cosine to the axis; of S.n, its square or R.E
  /// Up to here these make no highlight: their power, times what it is multiplied by, is below 2^-32, or they
  /// are below 2^-126. NaN, which nothing is up to, where the power is 1 for everything.
  float highlight_floor = 0;
  Rgb ambient{}, diffuse{}, specular{};  ///< light times material
  Rgb tracked_ambient{}, tracked_diffuse{},
      tracked_specular{};  ///< the light's, for the vertex colour to multiply
};

/// The whole of one surface: a material's front or back under a list of lights.
struct LightingProgram {
  bool renormalize = false;    ///< normals were interpolated
  bool negate_normal = false;  ///< a back face
  bool needs_normal = false, needs_position = false, needs_view = false, tracked = false;
  Rgb base{};  ///< emission + scene ambient
  Rgb tracked_base{};
  std::vector<LightTerm> terms;
  bool index = false;                     ///< the result is an index; red of the sum is d, green is s
  std::array<float, 3> indexes{0, 1, 1};  ///< ambient, diffuse, specular
  float index_modulus = 2;                ///< 2^bits: the index is masked
};

/// Plans the lighting of a surface. Terms that its lights and material cannot need are left out.
///
/// @param notes         receives the effects of each light
/// @param term_storage  memory for the terms; its contents are discarded
LightingProgram plan_lighting(const SurfaceMaterial& material, const TrackedColors& tracked,
                              const std::vector<EyeLight>& lights, const LightingModel& model,
                              const EffectNotes& notes, std::vector<LightTerm> term_storage = {});

/// The material of a surface whose colour is an index.
struct IndexMaterial {
  std::array<float, 3> indexes{0, 1, 1};  ///< ambient, diffuse, specular
  float shininess = 0;
  float modulus = 2;  ///< 2^bits of the buffer
};
/// The same for indices.
LightingProgram plan_index_lighting(const IndexMaterial& material, const std::vector<EyeLight>& lights,
                                    const LightingModel& model, const EffectNotes& notes,
                                    std::vector<LightTerm> term_storage = {});

/// Lights `count` points, whole vectors of lanes, of the batch: needs the fields that the program names,
/// leaves the colour or index. Points that nobody looks at may hold any bits. Bit-identical to
/// light_point_reference() on every instruction set.
using LightPoints = void(const LightingProgram& program, ShadingBatch& batch, int count);
LightPoints* light_points(InstructionSet isa);

}  // namespace tessera::detail
