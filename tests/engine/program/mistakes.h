// Tables of mistakes on the command line: each must give one line and the documented exit code.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/engine/program/program.h"

namespace tessera {

struct Mistake {
  const char* arguments;
  int code;
  const char* message;  ///< how the line goes on after the program's name; a list of names may follow
};

class Mistakes : public Program {
 protected:
  void expect_one_line(const Mistake& mistake) const {
    const Result result = run(mistake.arguments);
    EXPECT_EQ(result.code, mistake.code) << mistake.arguments << "\n" << result.err;
    EXPECT_EQ(result.out, "") << mistake.arguments;
    const std::string command =
        std::string(mistake.arguments).substr(0, std::string(mistake.arguments).find(' '));
    const bool is_measured = command == "bench" || command == "price" || command == "accuracy";
    const std::string name = is_measured ? "tessera " + command : "tessera";
    const std::string expected = name + ": error: " + mistake.message;
    EXPECT_TRUE(result.err.starts_with(expected)) << mistake.arguments << "\n" << result.err << expected;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << mistake.arguments << "\n" << result.err;
    EXPECT_EQ(result.err.ends_with("--help)\n"), mistake.code == 2) << mistake.arguments << "\n"
                                                                    << result.err;
  }
};

}  // namespace tessera
