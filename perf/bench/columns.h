// Meaning of the columns of a table: one line per column, printed below the table.
#pragma once

#include <span>
#include <string>

#include "perf/bench/text.h"

namespace tessera::bench {

struct Column {
  const char* heading;
  const char* meaning;  ///< with the unit
};

/// One line per column, after an empty one.
inline std::string column_lines(std::span<const Column> columns) {
  std::string text = "\n";
  for (const Column& column : columns) text += formatted("%-22s %s\n", column.heading, column.meaning);
  return text;
}

}  // namespace tessera::bench
