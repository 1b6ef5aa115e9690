// User stages that pass their values through: what calling a stage costs.
#pragma once

#include "engine/tessera/tessera.hpp"

namespace tessera::bench {

/// Colours are read and written in place, so there is nothing to do.
inline const FragmentStage kPassingFragmentStage{
    .run = [](const FragmentBlock&, void*) {}, .name = "pass colours", .reads = {.color = true}};
/// Clip positions likewise.
inline const VertexStage kPassingVertexStage{.run = [](const VertexBlock&, void*) {},
                                             .name = "pass positions",
                                             .reads = {.clip = true},
                                             .writes = {.clip = true}};

}  // namespace tessera::bench
