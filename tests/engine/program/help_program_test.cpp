// Help and manual page.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/engine/program/program.h"
#include "tests/engine/program/terminal_shell.h"

namespace tessera::help_program_test {
namespace {

constexpr const char* kCommands[] = {"render",  "explain",    "compare",  "modes", "color", "display",
                                     "scene",   "info",       "selftest", "bench", "price", "accuracy",
                                     "formats", "completion", "man",      "help"};

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Options of a command as help shows them on a wide terminal, each in one line.
std::vector<std::string> option_lines(const std::string& help) {
  std::vector<std::string> options;
  for (const std::string& line : lines_of(help)) {
    const bool continues = line.starts_with("          ") && !options.empty() && !options.back().empty();
    if (line.starts_with("  -")) options.push_back(line);
    else if (continues) options.back() += line;
  }
  return options;
}

/// The longest word of a line, in bytes.
std::size_t longest_word(const std::string& line) {
  std::istringstream words(line);
  std::size_t longest = 0;
  for (std::string word; words >> word;) longest = std::max(longest, word.size());
  return longest;
}

/// Help of a program, with COLUMNS set.
class HelpProgram : public Program {
 protected:
  ~HelpProgram() override { ::unsetenv("COLUMNS"); }
  Result run_with_columns(const std::string& columns, const std::string& arguments) const {
    ::setenv("COLUMNS", columns.c_str(), 1);
    return run(arguments);
  }
};

TEST_F(HelpProgram, HelpOfCommandIsThatOfItsOption) {
  EXPECT_EQ(run("help").out, run("--help").out);
  EXPECT_EQ(run("help").out, run("").out);
  for (const std::string command : kCommands) {
    const Result named = run("help " + command);
    EXPECT_EQ(named.code, 0) << command;
    EXPECT_EQ(named.err, "") << command;
    EXPECT_EQ(named.out, run(command + " --help").out) << command;
    EXPECT_TRUE(contains(named.out, "Usage: tessera " + command)) << named.out;
    EXPECT_TRUE(contains(run("help").out, "\n  " + command + " ")) << command;
  }
}

TEST_F(HelpProgram, WrapsToColumns) {
  for (const int columns : {40, 57, 80, 132})
    for (const std::string command : kCommands)
      for (const std::string& line :
           lines_of(run_with_columns(std::to_string(columns), "help " + command).out)) {
        const bool fits = line.size() <= static_cast<std::size_t>(columns);
        // Names of values, and single words, are not broken.
        const bool is_heading = line.starts_with("  -") || line.starts_with("  [");
        EXPECT_TRUE(fits || is_heading || longest_word(line) + 16 > static_cast<std::size_t>(columns))
            << command << ", " << columns << " columns: " << line;
      }
  EXPECT_EQ(run_with_columns("80", "help render").out, run_with_columns("", "help render").out)
      << "the standard output is no terminal";
  EXPECT_EQ(run_with_columns("40", "help render").out, run_with_columns("7", "help render").out);
}

TEST_F(HelpProgram, IsAsWideAsTheTerminal) {
  ::unsetenv("COLUMNS");
  TerminalShell terminal({"sh", "-c", "'" TESSERA_PROGRAM "' help render; echo the end"}, {},
                         folder_.string());
  ASSERT_TRUE(terminal.wait_for("the end")) << terminal.screen();
  const std::string wide =
      run_with_columns(std::to_string(TerminalShell::kColumns), "help render").out + "the end\n";
  std::string shown = terminal.screen();
  std::erase(shown, '\r');
  EXPECT_TRUE(wide.starts_with(shown)) << shown;
  EXPECT_NE(wide, run_with_columns("80", "help render").out + "the end\n");
}

TEST_F(HelpProgram, ShowsNoTextOfTheParser) {
  for (const std::string command : kCommands) {
    const std::string help = run_with_columns("200", "help " + command).out;
    for (const char* text : {"Needs:", "Excludes:", "REQUIRED", ":FLOAT", ":INT", " TEXT", " in [", "{text}",
                             "Positionals", "this help message", "{false}"})
      EXPECT_FALSE(contains(help, text)) << command << ": " << text;
  }
  EXPECT_TRUE(contains(run_with_columns("200", "help render").out, "\n  --stats[=text|json]  "))
      << "optional value";
}

TEST_F(HelpProgram, NamesDefaultOfEachValue) {
  for (const std::string command : kCommands)
    for (const std::string& line : option_lines(run_with_columns("2000", "help " + command).out)) {
      const bool has_value =
          line.starts_with("  -") && line.find(' ', line.find("--")) != std::string::npos &&
          std::isupper(static_cast<unsigned char>(line[line.find(' ', line.find("--")) + 1])) != 0;
      if (!has_value) continue;
      EXPECT_TRUE(contains(line, "default") || contains(line, "required")) << command << ": " << line;
    }
}

class ManualPage : public Program {
 protected:
  ManualPage() : page_(run("man").out) { write("tessera.1", page_); }

  /// The output of a shell command in the test's folder.
  std::string output_of(const std::string& command) const {
    const std::string whole = "cd '" + folder_.string() + "' && " + command + " >printed.txt 2>&1";
    const int status = std::system(whole.c_str());
    return content("printed.txt") + (status < 0 ? "no shell" : "");
  }
  static bool has(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
  }

  const std::string page_;
};

TEST_F(ManualPage, HasSectionsExitCodesAndAllOptions) {
  for (const char* section :
       {"NAME", "SYNOPSIS", "DESCRIPTION", "COMMANDS", "ENVIRONMENT", "FILES", "EXIT STATUS", "EXAMPLES"})
    EXPECT_TRUE(contains(page_, std::string(".SH ") + section + "\n")) << section;
  for (const char* code : {"0", "1", "2", "3", "130"})
    EXPECT_TRUE(contains(page_, std::string(".TP\n.B ") + code + "\n")) << code;
  for (const std::string command : kCommands) {
    EXPECT_TRUE(contains(page_, ".SS tessera " + command)) << command;
    ::setenv("COLUMNS", "2000", 1);
    for (const std::string& line : option_lines(run("help " + command).out)) {
      const std::size_t begin = line.find("--");
      std::string name = line.substr(begin, line.find_first_of(" [", begin) - begin);
      for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2) name.insert(at, "\\");
      EXPECT_TRUE(contains(page_, "\\fB" + name + "\\fR")) << command << ": " << line;
    }
    ::unsetenv("COLUMNS");
  }
}

TEST_F(ManualPage, HasNoWarnings) {
  if (!has("mandoc") && !has("groff")) GTEST_SKIP() << "neither mandoc nor groff";
  if (has("mandoc")) {
    EXPECT_EQ(output_of("mandoc -T lint tessera.1"), "");
  }
  if (has("groff")) {
    EXPECT_EQ(output_of("groff -man -ww -z -Tutf8 tessera.1"), "");
  }
}

}  // namespace
}  // namespace tessera::help_program_test
#endif
