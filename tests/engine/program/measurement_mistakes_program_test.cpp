// Mistakes on the command lines of `tessera bench`, `price` and `accuracy`, which other programs parse.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include "tests/engine/program/mistakes.h"

namespace tessera::measurement_mistakes_program_test {
namespace {

class MeasurementMistakes : public Mistakes {};

TEST_F(MeasurementMistakes, GiveOneLine) {
  write("notes.txt", "hello");
  write("still.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}})");
  const Mistake kRows[] = {
      {"bench nothing", 2,
       R"(workloads: found "nothing", expected the name of a workload or a prefix; see --list)"},
      {"bench --siz 3x3", 2, R"(unexpected argument "--siz"; did you mean "--size"?)"},
      {"bench --size 3", 2, R"(--size: found "3", expected WIDTHxHEIGHT, each 1 to 16384)"},
      {"bench --driver softpipe", 2, "--driver: needs --rivals"},
      {"bench --allowed 2", 2, "--allowed: needs --compare, the earlier results"},
      {"bench --list --json x.json", 2, "--json: has no effect with --list"},
      {"bench --trace t.json --repeats 3", 2,
       "--repeats: has no effect with --trace and --heatmap, which draw one frame"},
      {"bench --rivals --scaling", 2, "--scaling: excludes --rivals"},
      {"bench --compare none.json", 1, R"(cannot read "none.json": No such file or directory)"},
      {"bench --compare notes.txt", 1,
       "notes.txt: line 1, column 1: syntax error while parsing value - invalid literal; last read: 'h'"},
      {"bench --compare still.json", 1,
       "still.json: (top level): found an object, expected a report of tessera bench --json"},
      {"price nothing", 2, R"(names: found "nothing", expected the name of a price or a prefix; see --list)"},
      {"price --seconds 0", 2, R"(--seconds: found "0", expected a number from 0.001 to 3600)"},
      {"price --check none.json", 1, R"(cannot read "none.json": No such file or directory)"},
      {"price pixel --check still.json", 2,
       "names: has no effect with --check, which measures what is missing"},
      {"price --list --json x.json", 2, "--json: has no effect with --list"},
      {"accuracy", 2, "--output is required"},
      {"accuracy -o out --rounds 1", 2, R"(--rounds: found "1", expected an integer from 3 to 10000)"},
      {"accuracy -o out --scenes nothing", 2,
       R"(--scenes: found "nothing", expected none or prefixes of: wall-1, wall-2, wall-4, wall-8,)"},
      {"accuracy -o out --scenes none", 2, "--scenes: found none without files, expected a scene to measure"},
      {"accuracy -o out none.json", 1, R"(cannot read "none.json": No such file or directory)"},
      {"accuracy -o notes.txt --scenes none still.json", 1,
       R"(cannot create the folder "notes.txt": Not a directory)"},
      {"bench --json none/x.json", 1, R"(cannot write "none/x.json": there is no folder "none")"},
      {"bench --growth g.svg fill", 2, "workloads: have no effect with --growth, which has its own"},
      {"bench --csv x.csv --rivals", 2,
       "--csv: has no effect with --rivals and --scaling, which measure no single workloads"},
      {"bench --json x.json --trace t.json", 2,
       "--json: has no effect with --growth, --trace and --heatmap, which write to their own file only"},
      {"bench --json=", 2, R"(--json: found "", expected a value)"},
      {"price --check still.json --json x.json", 2,
       "--json: has no effect with --check, which writes no list"},
      {"accuracy -o", 2, "--output: found no value, expected DIR"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

}  // namespace
}  // namespace tessera::measurement_mistakes_program_test
#endif
