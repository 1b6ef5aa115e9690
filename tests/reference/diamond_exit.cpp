// The segment is p(t) = a + t (b - a), 0 <= t <= 1. The diamond is the set where four linear functions f,
// plus or minus x plus or minus y from its centre, are below half a pixel. Each f bounds t on one side by a
// fraction with an infinitesimal part. The segment meets the diamond if some t is within all bounds.
#include "diamond_exit.h"

#include <array>
#include <compare>
#include <vector>

namespace tessera::reference {
namespace {

/// n + e1 e + e2 e^2 with an infinitely small e > 0: ordered by n, then e1, then e2.
struct Nearly {
  std::int64_t n = 0;
  std::int64_t e1 = 0;
  std::int64_t e2 = 0;
  auto operator<=>(const Nearly&) const = default;
};

Nearly operator*(std::int64_t factor, Nearly x) { return {factor * x.n, factor * x.e1, factor * x.e2}; }

// Bounds the terms of a fraction. A linear function of a vertex is at most 2 kMaxDifference, and so is its
// change along the segment.
static_assert(2 * kMaxDifference <= INT64_MAX / (2 * kMaxDifference + kSubpixels));

/// over / under, under > 0.
struct Fraction {
  Nearly over;
  std::int64_t under = 1;
};

bool less(const Fraction& a, const Fraction& b) { return b.under * a.over < a.under * b.over; }

constexpr std::int64_t kRadius = kSubpixels / 2;
constexpr std::array<Point, 4> kSides{{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};  // signs of x and y in each f

/// Distance of f from half a pixel at a vertex, shifted by (-e, -e^2).
Nearly room(Point side, Point vertex, Point center) {
  const Point p = vertex - center;
  return {kRadius - (side.x * p.x + side.y * p.y), side.x, side.y};
}

bool is_in_diamond(Point vertex, Point center) {
  for (const Point side : kSides)
    if (!(room(side, vertex, center) > Nearly{})) return false;
  return true;
}

bool meets_diamond(Point a, Point b, Point center) {
  std::vector<Fraction> below, above;  // lower and upper bounds of t
  for (const Point side : kSides) {
    // Change of f along the segment; t change < room.
    const std::int64_t change = side.x * (b.x - a.x) + side.y * (b.y - a.y);
    const Nearly at_a = room(side, a, center);
    if (change > 0) above.push_back({at_a, change});
    else if (change < 0) below.push_back({-1 * at_a, -change});
    else if (!(at_a > Nearly{})) return false;
  }
  const Fraction zero{{0, 0, 0}, 1};
  const Fraction one{{1, 0, 0}, 1};
  for (const Fraction& high : above)
    if (!less(zero, high)) return false;
  for (const Fraction& low : below) {
    if (!less(low, one)) return false;
    for (const Fraction& high : above)
      if (!less(low, high)) return false;
  }
  return true;
}

}  // namespace

bool exits_diamond(Point a, Point b, Point center) {
  return meets_diamond(a, b, center) && !is_in_diamond(b, center);
}

}  // namespace tessera::reference
