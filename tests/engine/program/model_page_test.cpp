// The picture of models that the documentation shows. TESSERA_WRITE_PAGE=1 writes it anew; check it by eye
// then.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "engine/program/imageio/picture.h"
#include "engine/program/scene/model_scene.h"
#include "tests/pictures/model_list.h"

namespace tessera::model_page_test {
using namespace program;
namespace {

constexpr int kWidth = 160, kHeight = 120, kColumns = 6;
const std::string kPage = TESSERA_SOURCE_DIR "/tests/pictures/models.png";

Picture draw_page() {
  const std::vector<std::string> models = test::page_models();
  const int rows = (static_cast<int>(models.size()) + kColumns - 1) / kColumns;
  Picture page(kColumns * kWidth, rows * kHeight);
  Renderer renderer;
  for (int i = 0; i < static_cast<int>(models.size()); ++i) {
    const Scene scene = model_scene(import_model(models[static_cast<std::size_t>(i)], ModelUse::display),
                                    models[static_cast<std::size_t>(i)], kWidth, kHeight);
    FrameBuffer buffer(scene.framebuffer);
    Frame frame(buffer);
    record(scene, frame);
    ImageTarget target = page.target();
    target.pixels = page.rgba.data() + i / kColumns * kHeight * target.stride_bytes +
                    4 * std::ptrdiff_t{kWidth} * (i % kColumns);
    target.width = kWidth;
    target.height = kHeight;
    renderer.finish(frame, target);
  }
  return page;
}

TEST(ModelPage, MatchesCommittedPicture) {
  for (const std::string& model : test::page_models())
    ASSERT_TRUE(std::filesystem::exists(model)) << model << ": bash .ci/packages installs it";
  ASSERT_EQ(test::page_models().size(), 30u);
  const Picture page = draw_page();
  if (std::getenv("TESSERA_WRITE_PAGE") != nullptr) write_picture(page, kPage, 9);
  const Picture shown = read_picture(kPage);
  ASSERT_EQ(shown.width, page.width);
  ASSERT_EQ(shown.height, page.height);
  const auto row_bytes = 4 * static_cast<std::size_t>(page.width);
  for (std::size_t i = 0; i < page.rgba.size(); i += i % 4 == 2 ? 2 : 1)  // skips alpha
    ASSERT_EQ(page.rgba[i], shown.rgba[i]) << "row " << i / row_bytes << ", column " << i % row_bytes / 4;
}

}  // namespace
}  // namespace tessera::model_page_test
