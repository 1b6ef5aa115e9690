#include "tests/numerics/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

namespace tessera::test {
namespace {

struct Row {
  std::string quantity;
  std::string unit;
  long double measured, promised;
  std::optional<long double> mesas{};
};
std::vector<Row>& rows() {
  static std::vector<Row> all;
  return all;
}

class Table : public testing::Environment {
 public:
  void TearDown() override {
    if (rows().empty()) return;
    std::size_t widest = 0;
    for (const Row& row : rows()) widest = std::max(widest, row.quantity.size());
    std::printf("\n%-*s  %12s  %12s  %12s\n", static_cast<int>(widest), "", "measured", "promised", "Mesa's");
    for (const Row& row : rows()) {
      std::printf("%-*s  %12.4Lg  %12.4Lg  ", static_cast<int>(widest), row.quantity.c_str(), row.measured,
                  row.promised);
      if (row.mesas) std::printf("%12.4Lg", *row.mesas);
      else std::printf("%12s", "");
      std::printf("  %s\n", row.unit.c_str());
    }
  }
};
const testing::Environment* const kTable = testing::AddGlobalTestEnvironment(new Table);

}  // namespace

void expect_within(const std::string& quantity, long double measured, long double promised,
                   const std::string& unit) {
  EXPECT_LE(measured, promised) << quantity << " (" << unit << ")";
  rows().push_back({quantity, unit, measured, promised});
}

void report_mesa_figure(const std::string& quantity, long double mesas) {
  for (Row& row : rows())
    if (row.quantity == quantity) row.mesas = mesas;
}

}  // namespace tessera::test
