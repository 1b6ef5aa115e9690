// Reads quality caps.
#include "engine/program/scene/quality_names.h"
#include "engine/program/scene/read_scene.h"

namespace tessera::program {

Quality read_quality(const json::Value& value) {
  const json::Object object(
      value, {"shading", "renormalize", "viewer", "interpolation", "texture", "light_threshold"});
  Quality quality;
  if (const auto shading = object.find("shading")) quality.shading = shading->choice(kShadingCaps);
  if (const auto renormalize = object.find("renormalize")) quality.renormalize = renormalize->boolean();
  if (const auto viewer = object.find("viewer")) quality.viewer = viewer->choice(kViewerCaps);
  if (const auto interpolation = object.find("interpolation"))
    quality.interpolation = interpolation->choice(kInterpolationCaps);
  if (const auto texture = object.find("texture")) quality.texture = texture->choice(kTextureCaps);
  if (const auto threshold = object.find("light_threshold")) quality.light_threshold = threshold->real(0, 1);
  return quality;
}

}  // namespace tessera::program
