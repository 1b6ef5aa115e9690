// Replaces mesa_workload.cpp if OSMesa's header was not found.
#include <stdexcept>

#include "perf/rivals/mesa_workload.h"

namespace tessera::rivals {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(
      "--rivals is not available: this program was built without GL/osmesa.h (Debian package "
      "libosmesa6-dev)");
}

}  // namespace

std::unique_ptr<bench::Workload> mesa_workload(const bench::GlWorkload&, int, int, MesaDriver, int) {
  fail();
}
double mesa_finish_ms(int, int, MesaDriver, int) { fail(); }
std::string mesa_name(MesaDriver, int) { fail(); }

}  // namespace tessera::rivals
