// Scenes made of a single model.
#include <gtest/gtest.h>

#include "engine/program/scene/model_scene.h"

namespace tessera::model_scene_test {
using namespace program;
namespace {

TEST(ModelScene, IgnoresCamerasWithOverflowingProjection) {
  for (const ModelCamera& camera : {ModelCamera{.view = {}, .is_orthographic = true, .half_height = 1.7e308},
                                    ModelCamera{.view = {}, .half_height = 5e-324, .near = 0.25}}) {
    Model model;
    model.mesh.positions = {-1, -1, -5, 1, -1, -5, 0, 1, -5};
    model.mesh.indices = {0, 1, 2};
    model.parts = {{.material_name = {}, .material = {}, .first_index = 0, .index_count = 3}};
    model.cameras.push_back(camera);
    const Scene scene = model_scene(model, "m", 64, 48);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0], "m: no camera of the file shows the model; a default camera frames it");
  }
}

}  // namespace
}  // namespace tessera::model_scene_test
