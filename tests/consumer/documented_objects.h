// Objects that the examples in the comments of public headers use without declaring them. The examples are
// compiled and not run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include <tessera/screen.hpp>
#include <tessera/tessera.hpp>

namespace tessera {

extern Renderer renderer;
extern FrameBuffer buffer;
extern Frame frame;
extern Mesh mesh;
extern std::vector<std::uint8_t> pixels;

}  // namespace tessera

using namespace tessera;
