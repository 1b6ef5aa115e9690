// Models of the Debian packages glmark2-data and assimp-testmodels, and of tests/models.
#pragma once

#include <string>
#include <vector>

namespace tessera::test {

inline const std::string kGlmark2Models = "/usr/share/glmark2/models/";
inline const std::string kAssimpModels = "/usr/share/assimp/models/";
inline const std::string kOwnModels = TESSERA_SOURCE_DIR "/tests/models/gltf/";

/// Models of the page. Plain ones first, then those with textures, then those that are transparent or have
/// lines.
inline std::vector<std::string> page_models() {
  std::vector<std::string> paths{kGlmark2Models + "bunny.obj"};
  for (const char* name : {"OBJ/spider.obj",
                           "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
                           "IFC/AC14-FZK-Haus.ifc",
                           "Collada/COLLADA.dae",
                           "Collada/human.zae",
                           "ASE/MotionCaptureROM.ase",
                           "X/fromtruespace_bin32.x",
                           "STL/Wuson.stl",
                           "Q3D/earth.q3o",
                           "BLEND/blender_269_regress1.blend",
                           "Collada/duck.dae",
                           "Collada/teapots.DAE",
                           "Collada/kwxport_test_vcolors.dae",
                           "glTF2/BoxTextured-glTF/BoxTextured.gltf",
                           "glTF2/textureTransform/TextureTransformTest.gltf",
                           "3DS/cube_with_diffuse_texture.3DS",
                           "FBX/embedded_ascii/box.FBX",
                           "LWO/LWO2/MappingModes/earth_spherical_y.lwo",
                           "MD2/sydney.md2",
                           "MDL/MDL3 (3DGS A4)/minigun.MDL",
                           "MS3D/jeep1.ms3d",
                           "IQM/mrfixit.iqm",
                           "SMD/holy_grailref.smd",
                           "3DS/cubes_with_alpha.3DS",
                           "FBX/phong_cube.fbx",
                           "LWO/LWO2/transparency.lwo"})
    paths.push_back(kAssimpModels + name);
  for (const char* name : {"blended_window.gltf", "masked_leaf.gltf", "lines_beside_triangles.gltf"})
    paths.push_back(kOwnModels + name);
  return paths;
}

/// Models that are compared with Mesa and the reference renderer.
inline std::vector<std::string> compared_models() {
  std::vector<std::string> paths = page_models();
  paths.push_back(kGlmark2Models + "asteroid-low.3ds");
  for (const char* name : {"MD2/faerie.md2", "Collada/earthCylindrical.DAE", "X/test.x", "BVH/01_01.bvh"})
    paths.push_back(kAssimpModels + name);
  for (const char* name : {"lines.gltf", "textured.gltf", "unlit_vertex_colors.gltf"})
    paths.push_back(kOwnModels + name);
  return paths;
}

}  // namespace tessera::test
