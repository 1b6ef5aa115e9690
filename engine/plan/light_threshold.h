// Lights that Quality::light_threshold leaves out of a draw: their summed contributions are proven to stay
// below it.
#pragma once

#include "engine/plan/draw_plan.h"
#include "shading/light_reach.h"

namespace tessera::detail {

/// The colours that lights are multiplied by on one face.
struct ReflectedColors {
  Rgb ambient{}, diffuse{}, specular{};
  float shininess = 0;
  TrackedColors tracked;  ///< vertex colours replace these
};

/// Upper bound of the contribution of a light to any component of a lit colour, at any point of a draw.
///
///   |contribution| <= att_max * (|ambient| + n_max * |diffuse| + |specular|)
///
/// - Colours are products of light and material. Those of negative lights count by their absolute value.
/// - att_max: 1 / (kc + kl d + kq d^2) at the smallest distance d of the light from the box of the draw's
///   positions. Infinite if a factor is negative, or the sum is not above 0.
/// - n_max: the largest length of a normal, which bounds n.L. Highlights are bounded by 1, and unbounded if
///   normals may be longer than 1.
/// - Cones count as 1.
/// - The ambient part of a directional light is constant and is never left out. Lights behind the draw have
///   only an ambient part, lights outside of whose cone it is have none (light_reach.h).
struct ContributionBounds {
  /// @param has_samples  several samples per pixel
  /// @param isa          for the scan of the mesh
  ContributionBounds(const DrawPlan& plan, const RecordedDraw& draw, bool has_samples, InstructionSet isa);
  double of(const EyeLight& light, LightReach reach, const ReflectedColors& colors) const;

 private:
  bool is_bounded_ = false;  // positions, normals and vertex colours have bounds
  VectorBox positions_;      // eye space
  double max_normal_ = 1;    // length of a lit normal
  Rgb max_vertex_color_{};   // absolute values
};

/// Sets LightReach::below_threshold in plan.light_reach of a face for the lights with the smallest bounds, as
/// long as their sum is below the threshold.
/// @pre plan.light_reach holds what is proven, whatever PlanOptions::elide is: pictures do not depend on it
void leave_out_weak_lights(DrawPlan& plan, int face, const ReflectedColors& colors,
                           const ContributionBounds& bounds, float threshold);

}  // namespace tessera::detail
