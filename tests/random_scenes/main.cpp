// random_scene SEED: prints the random scene of a seed.
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "tests/random_scenes/random_scene.h"

int main(int argument_count, char** arguments) {
  char* end = nullptr;
  const unsigned long long seed = argument_count == 2 ? std::strtoull(arguments[1], &end, 10) : 0;
  if (end == nullptr || *end != '\0' || end == arguments[1]) {
    std::cerr << "usage: random_scene SEED > FILE.json\n";
    return 2;
  }
  std::cout << tessera::test::random_scene(seed);
  return std::cout.good() ? 0 : 1;
}
