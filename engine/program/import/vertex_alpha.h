// How the alpha of a model's vertex colours is used, for formats that do not say it.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/program/import/model.h"

namespace tessera::program {

/// Returns ModelAlpha::blend if some alpha is below 1. If all are 0, the program that wrote the file did not
/// mean them: they are set to 1.
/// @param colors  r g b a of each vertex
inline ModelAlpha alpha_of_colors(std::vector<float>& colors) {
  float min_alpha = 1, max_alpha = 0;
  for (std::size_t i = 3; i < colors.size(); i += 4) {
    min_alpha = std::min(min_alpha, colors[i]);
    max_alpha = std::max(max_alpha, colors[i]);
  }
  if (max_alpha > 0) return min_alpha < 1 ? ModelAlpha::blend : ModelAlpha::opaque;
  for (std::size_t i = 3; i < colors.size(); i += 4) colors[i] = 1;
  return ModelAlpha::opaque;
}

}  // namespace tessera::program
