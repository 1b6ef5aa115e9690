// The parts a scene file is read in; used by load_scene() only.
#pragma once

#include "json_reader.h"
#include "scene.h"

namespace tessera::reference {

/// @param aspect  width / height of the picture.
Camera parse_camera(const Value& v, double aspect);

/// The camera of a scene that names none.
Camera default_camera(double aspect);

std::vector<Light> parse_lights(const Value& v);

/// @param directory  what file paths are relative to.
Mesh parse_mesh(const Value& v, const std::string& name, const std::string& directory);

/// @param scene  all but the frame has been read.
std::vector<Command> parse_frame(const Value& v, const Scene& scene);

/// One clear of what there is and one draw of every mesh.
std::vector<Command> default_frame(const Scene& scene);

}  // namespace tessera::reference
