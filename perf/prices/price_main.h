// tessera price: measures what effects cost on this machine.
#pragma once

namespace tessera::bench {

/// @param argv  the first element is skipped
/// @return the exit code
int price_main(int argc, char** argv);

}  // namespace tessera::bench
