// Triangles that share edges cover each pixel exactly once: whole meshes drawn through the engine into a
// counting buffer. Corners are multiples of 1/256 pixel, so nothing is rounded before the fill rule applies.
// No tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "tests/numerics/bounds.h"
#include "tests/numerics/counted_mesh.h"
#include "tests/raster/random_triangles.h"

namespace tessera::test::coverage_test {
namespace {

constexpr int kSide = 64;
const CaseFormat kFormat{.width = kSide, .height = kSide};

int how_many(bool is_tessera, int normal, int in_long_tests) {
  return is_tessera && long_tests() ? in_long_tests : normal;
}

// A grid that extends beyond the frame on all sides. Inner vertices are arbitrary, or multiples of half a
// pixel (pixel centres, corners of pixels and tiles), or of 1/16 pixel (sample positions).
Grid jittered_grid(MeshRandom& random, double jitter, int max_cells = 24) {
  Grid grid{random.between(1, max_cells), random.between(1, max_cells), {}};
  const int snap = random.one_of({1, 16, 128, 256});
  const auto place = [&](int n, int last) {
    const double cell = (kSide + 8.0) * 256 / last;
    const double at = cell * (n + (n > 0 && n < last ? jitter * (random.unit() - 0.5) : 0)) - 1024;
    return std::llround(at / snap) * snap;
  };
  for (int j = 0; j <= grid.rows; ++j)
    for (int i = 0; i <= grid.columns; ++i) {
      const std::int64_t x = place(i, grid.columns);
      grid.points.push_back({x, place(j, grid.rows)});
    }
  return grid;
}

CountedMesh triangles_of(const Grid& grid, MeshRandom& random, int width = kSide, int height = kSide) {
  CountedMesh mesh = mesh_of(grid.points, width, height);
  grid.cut_into(mesh, random);
  return mesh;
}

TEST(ExactlyOnce, Grids) {
  expect_coverage("random grids", kFormat, [](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 10000, 1000000); ++n) {
      MeshRandom random(n);
      Grid grid = jittered_grid(random, random.unit());
      while (grid.folds()) grid = jittered_grid(random, random.unit());
      count({counting(triangles_of(grid, random))}, "mesh " + std::to_string(n), {});
    }
  });
}

// All grid lines lie on the borders and centres of pixels and tiles, or 1/256 pixel next to them.
TEST(ExactlyOnce, LinesAtPixelCentresAndTileBorders) {
  expect_coverage("lines at centres and tile borders", kFormat, [](const Count& count, bool is_tessera) {
    const auto lines = [](MeshRandom& random) {
      std::vector<std::int64_t> at{-1024, (kSide + 4) * 256};
      for (const int pixel : {0, 1, 31, 32, 33, 63})
        for (const int place : {-1, 0, 1, 127, 128, 129})
          if (random.coin()) at.push_back(256 * pixel + place);
      std::sort(at.begin(), at.end());
      return at;
    };
    for (int n = 0; n < how_many(is_tessera, 1000, 100000); ++n) {
      MeshRandom random(n);
      const std::vector<std::int64_t> x = lines(random), y = lines(random);
      Grid grid{static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1, {}};
      for (const std::int64_t at_y : y)
        for (const std::int64_t at_x : x) grid.points.push_back({at_x, at_y});
      count({counting(triangles_of(grid, random))}, "mesh " + std::to_string(n), {});
    }
  });
}

// Fans around a pixel's centre or corner, whose rim lies far outside the frame.
TEST(ExactlyOnce, Fans) {
  expect_coverage("fans around a pixel's centre", kFormat, [](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 2000, 100000); ++n) {
      MeshRandom random(n);
      const WindowPoint center{random.between(0, kSide) * 256 + random.between(0, 1) * 128,
                               random.between(0, kSide) * 256 + random.between(0, 1) * 128};
      const int spokes = random.between(5, 200);
      std::vector<WindowPoint> points{center};
      for (int i = 0; i < spokes; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.9 * random.unit()) / spokes;
        const double radius = 256 * kSide * (6 + 5 * random.unit());
        points.push_back({center.x + std::llround(radius * std::cos(angle)),
                          center.y + std::llround(radius * std::sin(angle))});
      }
      CountedMesh mesh = mesh_of(points, kSide, kSide);
      for (std::uint32_t i = 1; i < points.size(); ++i)
        mesh.add_triangle(0, i, i + 1 < points.size() ? i + 1 : 1);
      mesh.shuffle(random);
      count({counting(mesh)}, "fan " + std::to_string(n), {});
    }
  });
}

// Slivers 1/256 pixel wide and 16,384 pixels long, and needles from one point whose other ends are 1/256
// pixel apart.
TEST(ExactlyOnce, LongSlivers) {
  constexpr int kLong = 16384;
  constexpr int kShort = 2;
  constexpr int kCount = 256 * kShort;
  for (const bool lying : {true, false}) {
    const int width = lying ? kLong : kShort, height = lying ? kShort : kLong;
    expect_coverage(lying ? "slivers, lying" : "slivers, standing", {.width = width, .height = height},
                    [&](const Count& count, bool) {
                      MeshRandom random(0);
                      const auto point = [&](std::int64_t along, std::int64_t across) {
                        return lying ? WindowPoint{along, across} : WindowPoint{across, along};
                      };
                      Grid grid = lying ? Grid{1, kCount, {}} : Grid{kCount, 1, {}};
                      for (int j = 0; j <= grid.rows; ++j)
                        for (int i = 0; i <= grid.columns; ++i)
                          grid.points.push_back({lying ? i * kLong * 256 : i, lying ? j : j * kLong * 256});
                      count({counting(triangles_of(grid, random, width, height))}, "parallel", {});

                      for (const int corner : {0, kCount}) {
                        std::vector<WindowPoint> points{point(0, corner), point(0, kCount - corner)};
                        for (int k = 0; k <= kCount; ++k) points.push_back(point(kLong * 256, k));
                        CountedMesh mesh = mesh_of(points, width, height);
                        for (std::uint32_t k = 0; k < kCount; ++k) mesh.add_triangle(0, k + 2, k + 3);
                        mesh.add_triangle(0, 1, corner == 0 ? kCount + 2 : 2);
                        mesh.shuffle(random);
                        count({counting(mesh)}, "from corner " + std::to_string(corner), {});
                      }
                    });
  }
}

// Grids as quads and as rows of strips.
std::vector<CaseDraw> rows_of(const Grid& grid, Primitive primitive) {
  std::vector<CaseDraw> draws;
  for (int j = 0; j < grid.rows; ++j) {
    CountedMesh row = mesh_of(grid.points, kSide, kSide);
    for (int i = 0; i <= grid.columns; ++i)
      row.indices.insert(row.indices.end(), {grid.index(i, j), grid.index(i, j + 1)});
    draws.push_back(counting(row));
    draws.back().primitive = primitive;
  }
  return draws;
}
CaseDraw quads_of(const Grid& grid) {
  CountedMesh quads = mesh_of(grid.points, kSide, kSide);
  grid.for_each_cell([&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    quads.indices.insert(quads.indices.end(), {p, q, r, s});
  });
  CaseDraw draw = counting(quads);
  draw.primitive = Primitive::quads;
  return draw;
}
// A convex polygon around the frame, split by chords into polygons and fans.
std::vector<CaseDraw> parts_of_a_polygon(MeshRandom& random) {
  const int corners = random.between(4, 60);
  std::vector<WindowPoint> points;
  for (int i = 0; i < corners; ++i) {  // The polygon surrounds the frame for any number of corners.
    const double angle = 2 * std::numbers::pi * i / corners;
    points.push_back({128 * kSide + std::llround(40000 * std::cos(angle)),
                      128 * kSide + std::llround(40000 * std::sin(angle))});
  }
  std::vector<std::vector<std::uint32_t>> whole{{}};
  std::vector<std::vector<std::uint32_t>> parts;
  for (int i = 0; i < corners; ++i) whole[0].push_back(static_cast<std::uint32_t>(i));
  while (!whole.empty()) {
    std::vector<std::uint32_t> polygon = std::move(whole.back());
    whole.pop_back();
    const int size = static_cast<int>(polygon.size());
    std::rotate(polygon.begin(), polygon.begin() + random.between(0, size - 1), polygon.end());
    if (size == 3 || random.between(0, 3) == 0) {
      parts.push_back(std::move(polygon));
      continue;
    }
    const int other = random.between(2, size - 2);
    whole.emplace_back(polygon.begin(), polygon.begin() + other + 1);
    whole.emplace_back(polygon.begin() + other, polygon.end()).push_back(polygon[0]);
  }
  std::vector<CaseDraw> draws;
  for (std::vector<std::uint32_t>& part : parts) {
    if (random.coin()) std::reverse(part.begin(), part.end());
    CountedMesh mesh = mesh_of(points, kSide, kSide);
    mesh.indices = std::move(part);
    draws.push_back(counting(mesh));
    draws.back().primitive = random.coin() ? Primitive::polygon : Primitive::triangle_fan;
  }
  return draws;
}

TEST(ExactlyOnce, StripsQuadsFansAndPolygons) {
  expect_coverage("strips, quads, fans and polygons", kFormat, [](const Count& count, bool is_tessera) {
    for (int n = 0; n < how_many(is_tessera, 500, 50000); ++n) {
      MeshRandom random(n);
      const std::string number = " " + std::to_string(n);
      Grid grid = jittered_grid(random, 0.5 * random.unit(), 8);
      while (!grid.is_convex()) grid = jittered_grid(random, 0.5 * random.unit(), 8);
      count(rows_of(grid, Primitive::triangle_strip), "strips" + number, {});
      count(rows_of(grid, Primitive::quad_strip), "quad strips" + number, {});
      count({quads_of(grid)}, "quads" + number, {});
      count(parts_of_a_polygon(random), "parts" + number, {});
    }
  });
}

/// Packed colors of a multisampled buffer; each pixel shows the mean. Mesa's OSMesa has one sample only.
class SampledBuffer {
 public:
  explicit SampledBuffer(int samples)
      : buffer_({.width = kSide, .height = kSide, .depth = DepthFormat::none, .samples = samples}),
        words_(kSide * kSide) {}
  template <class Record>
  const std::vector<std::uint32_t>& draw(const Record& record) {
    Frame frame(buffer_);
    frame.clear({.color = Color{0, 0, 0, 1}, .stencil = 0});
    record(frame);
    renderer_.finish(frame);
    buffer_.read_packed_colors(words_);
    return words_;
  }

 private:
  FrameBuffer buffer_;
  Renderer renderer_{{.threads = 1}};
  std::vector<std::uint32_t> words_;
};

// Two checks, because plain draws and draws with fragment operations find samples on different paths. In the
// mean, a sample covered twice could hide one that was missed. So the stencil counts each sample, and samples
// whose count is not 1 are then painted white. For plain draws, an all-white mesh must leave no other pixel;
// and if no triangles overlap, individually coloured triangles show the same picture in reverse order.
TEST(ExactlyOnce, EverySampleOfAPixel) {
  const DrawState counts{.lighting = false,
                         .stencil = StencilState{.front = {.zpass = StencilOp::incr_wrap}},
                         .color_mask = {false, false, false, false}};
  const DrawState white{.material = {.diffuse = {1, 1, 1, 1}}, .lighting = false};
  const DrawState colored{.shading = Shading::flat, .lighting = false};
  DrawState shows = white;
  shows.stencil = StencilState{.front = {.func = Compare::notequal, .ref = 1}};
  const std::vector<float> whole{-1, -1, 0, 3, -1, 0, -1, 3, 0};
  for (const int samples : {4, 8}) {
    SampledBuffer buffer(samples);
    long double miscounted = 0;
    long double left_out = 0;
    long double overlapped = 0;
    for (int n = 0; n < (long_tests() ? 100000 : 500); ++n) {
      MeshRandom random(n);
      Grid grid = jittered_grid(random, random.unit());
      while (grid.folds()) grid = jittered_grid(random, random.unit());
      const CountedMesh mesh = triangles_of(grid, random);
      const Mesh drawn{.positions = mesh.positions, .position_components = 4, .indices = mesh.indices};
      const auto differing = [](const std::vector<std::uint32_t>& words, const auto& wanted) {
        long count = 0;
        for (std::size_t i = 0; i < words.size(); ++i) count += words[i] != wanted(i);
        return count;
      };
      const long miscounted_here = differing(buffer.draw([&](Frame& frame) {
        frame.draw(drawn, counts);
        frame.draw({.positions = whole}, shows);
      }),
                                             [](std::size_t) { return 0u; });
      const long left_out_here = differing(buffer.draw([&](Frame& frame) { frame.draw(drawn, white); }),
                                           [](std::size_t) { return 0xffffffu; });

      std::vector<float> positions, colors;
      for (const std::uint32_t i : mesh.indices)
        positions.insert(positions.end(), mesh.positions.begin() + 4 * static_cast<std::ptrdiff_t>(i),
                         mesh.positions.begin() + 4 * static_cast<std::ptrdiff_t>(i) + 4);
      for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const float r = static_cast<float>(random.unit()), g = static_cast<float>(random.unit());
        for (int k = 0; k < 3; ++k) colors.insert(colors.end(), {r, g, 1, 1});
      }
      std::vector<std::uint32_t> order(mesh.indices.size());
      std::iota(order.begin(), order.end(), 0u);
      const auto in_order = [&](Frame& frame) {
        frame.draw({.positions = positions, .position_components = 4, .colors = colors, .indices = order},
                   colored);
      };
      const std::vector<std::uint32_t> forwards = buffer.draw(in_order);
      std::reverse(order.begin(), order.end());
      const long overlapped_here =
          differing(buffer.draw(in_order), [&](std::size_t i) { return forwards[i]; });

      if (miscounted_here + left_out_here + overlapped_here > 0 && miscounted + left_out + overlapped == 0)
        ADD_FAILURE() << samples << " samples, mesh " << n << ": pixels miscounted " << miscounted_here
                      << ", left out " << left_out_here << ", overlapped " << overlapped_here;
      miscounted += static_cast<long double>(miscounted_here);
      left_out += static_cast<long double>(left_out_here);
      overlapped += static_cast<long double>(overlapped_here);
    }
    const std::string of_samples = "random grids, each of " + std::to_string(samples) + " samples: ";
    expect_within(of_samples + "not counted once", miscounted, 0, "pixels");
    expect_within(of_samples + "left out", left_out, 0, "pixels");
    expect_within(of_samples + "covered again", overlapped, 0, "pixels");
  }
}

}  // namespace
}  // namespace tessera::test::coverage_test
