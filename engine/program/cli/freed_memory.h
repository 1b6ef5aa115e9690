// How the C library treats freed memory.
#pragma once

namespace tessera::program::cli {

/// Lets the process keep up to 64 MiB of freed memory per thread for its next frames, instead of giving each
/// frame's buffers back to the system and having them cleared anew: a tenth of the processor time of an
/// animation of 640x480. Without effect in C libraries other than glibc.
void keep_freed_memory();

}  // namespace tessera::program::cli
