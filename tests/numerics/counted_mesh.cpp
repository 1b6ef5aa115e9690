#include "tests/numerics/counted_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "tests/numerics/bounds.h"

namespace tessera::test {
namespace {

struct Tally {
  // Miscounted pixels.
  long double cracks = 0;
  long double doubles = 0;
  long double strays = 0;
  int meshes = 0;
  int overlapping = 0;
  // Expected pixels.
  std::size_t pixels = 0;
  std::size_t once = 0;
  std::size_t never = 0;

  /// Adds the miscounted pixels; returns the index of the first one, or the pixel count if there is none.
  std::size_t add(const std::vector<int>& counts, const Expected& expected) {
    ++meshes;
    std::size_t first = counts.size();
    std::optional<bool> overlaps;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const Cover cover = expected.pixels.empty() ? Cover::once : expected.pixels[i];
      const bool crack = cover == Cover::once && counts[i] == 0;
      const bool stray = cover == Cover::never && counts[i] > 0;
      const bool may_fold = expected.folds_along_cuts && cover == Cover::at_most_once;
      bool again = cover != Cover::never && counts[i] > 1 && !may_fold;
      if (again && expected.overlaps) {
        if (!overlaps) overlapping += *(overlaps = expected.overlaps());
        again = !*overlaps;
      }
      cracks += crack;
      doubles += again;
      strays += stray;
      ++pixels;
      once += cover == Cover::once;
      never += cover == Cover::never;
      const bool is_wrong = crack || again || stray;
      if (is_wrong && first == counts.size()) first = i;
    }
    return first;
  }
};

std::vector<std::unique_ptr<CaseRenderer>> tesseras(const CaseFormat& format) {
  std::vector<std::unique_ptr<CaseRenderer>> all;
  for (const InstructionSet set : available_instruction_sets())
    for (const int tile_size : {32, 64, 128})
      all.push_back(make_tessera(format, {.threads = 1, .tile_size = tile_size, .instruction_set = set}));
  return all;
}

}  // namespace

void CountedMesh::shuffle(MeshRandom& random) {
  for (std::size_t i = triangles(); i > 0; --i) {
    const auto last = indices.begin() + static_cast<std::ptrdiff_t>(3 * (i - 1));
    std::swap_ranges(last, last + 3, indices.begin() + 3 * static_cast<std::ptrdiff_t>(random.random() % i));
    std::rotate(last, last + random.between(0, 2), last + 3);
    if (random.coin()) std::swap(last[1], last[2]);
  }
}

CaseDraw counting(const CountedMesh& mesh) {
  return {.positions = mesh.positions, .indices = mesh.indices, .color = {0, 0, 1 / 255.0f, 1}, .add = true};
}

CountedMesh mesh_of(const std::vector<WindowPoint>& points, int width, int height) {
  CountedMesh mesh;
  for (const WindowPoint& p : points)
    mesh.add_vertex(static_cast<double>(p.x) / (128.0 * width) - 1,
                    static_cast<double>(p.y) / (128.0 * height) - 1);
  return mesh;
}

bool Grid::folds() const {
  bool folded = false;
  for_each_cell([&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    folded |= !has_diagonal(p, q, r, s) && !has_diagonal(q, r, s, p);
  });
  return folded;
}

bool Grid::is_convex() const {
  bool convex = true;
  for_each_cell([&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    convex &= has_diagonal(p, q, r, s) && has_diagonal(q, r, s, p);
  });
  return convex;
}

void Grid::cut_into(CountedMesh& mesh, MeshRandom& random) const {
  for_each_cell([&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    const bool first = has_diagonal(p, q, r, s) && (!has_diagonal(q, r, s, p) || random.coin());
    mesh.add_triangle(first ? p : q, first ? q : r, first ? r : s);
    mesh.add_triangle(first ? p : q, first ? r : s, first ? s : p);
  });
  mesh.shuffle(random);
}

void expect_coverage(const std::string& what, const CaseFormat& format,
                     const std::function<void(const Count& count, bool is_tessera)>& meshes) {
  Tally ours;
  Tally mesas;
  {
    const std::vector<std::unique_ptr<CaseRenderer>> renderers = tesseras(format);
    std::size_t frame = 0;
    int messages = 0;
    meshes(
        [&](const std::vector<CaseDraw>& draws, const std::string& name, const Expected& expected) {
          const std::vector<int> counts = renderers[frame++ % renderers.size()]->count(draws);
          const std::size_t wrong = ours.add(counts, expected);
          if (wrong == counts.size() || messages++ > 5) return;
          const auto width = static_cast<std::size_t>(format.width);
          ADD_FAILURE() << what << ", " << name << ": pixel (" << wrong % width << ", " << wrong / width
                        << ") from the top left is covered " << counts[wrong] << " times";
        },
        true);
  }
  const std::unique_ptr<CaseRenderer> mesa = make_mesa(format);
  if (mesa)
    meshes([&](const std::vector<CaseDraw>& draws, const std::string&,
               const Expected& expected) { mesas.add(mesa->count(draws), expected); },
           false);
  EXPECT_LE(ours.overlapping, ours.meshes / 100);
  EXPECT_GT(ours.pixels, 10000u) << what;
  EXPECT_TRUE(ours.once > 10000 || ours.never == ours.pixels)
      << what << ": too few pixels are certain to be covered";
  const auto row = [&](const std::string& kind, long double measured, long double by_mesa) {
    expect_within(what + ": " + kind, measured, 0, "pixels");
    if (mesa) report_mesa_figure(what + ": " + kind, by_mesa);
  };
  row("left out", ours.cracks, mesas.cracks);
  row("covered again", ours.doubles, mesas.doubles);
  if (ours.never > 0) row("covered beyond the edge", ours.strays, mesas.strays);
}

}  // namespace tessera::test
