// Models of the Debian packages glmark2-data and assimp-testmodels.
#pragma once

#include <string>
#include <vector>

namespace tessera::test {

inline const std::string kGlmark2Models = "/usr/share/glmark2/models/";
inline const std::string kAssimpModels = "/usr/share/assimp/models/";

inline std::vector<std::string> page_models() {
  std::vector<std::string> paths;
  for (const char* name : {"bunny.obj", "asteroid-low.3ds"}) paths.push_back(kGlmark2Models + name);
  for (const char* name :
       {"OBJ/spider.obj", "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
        "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", "IFC/AC14-FZK-Haus.ifc", "Collada/teapots.DAE",
        "Collada/COLLADA.dae", "Collada/duck.dae", "Collada/human.zae", "MD2/faerie.md2", "IQM/mrfixit.iqm",
        "ASE/MotionCaptureROM.ase", "MS3D/jeep1.ms3d", "X/fromtruespace_bin32.x", "STL/Wuson.stl",
        "Q3D/earth.q3o", "BLEND/blender_269_regress1.blend"})
    paths.push_back(kAssimpModels + name);
  return paths;
}

}  // namespace tessera::test
