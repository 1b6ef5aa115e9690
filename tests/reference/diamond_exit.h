// The diamond-exit rule [GL 2.1, 3.4.1] in exact integers: a line of width 1 lights a pixel if it leaves the
// open diamond around the pixel's centre, |x - xc| + |y - yc| < 1/2.
#pragma once

#include "window.h"

namespace tessera::reference {

/// Whether the segment from `a` to `b` meets the diamond around `center` and does not end in it. Both ends
/// are shifted by (-e, -e^2), e infinitely small, so that no point lies on a diamond's border.
/// @pre coordinates are within kExtent pixels of the viewport's centre.
bool exits_diamond(Point a, Point b, Point center);

}  // namespace tessera::reference
