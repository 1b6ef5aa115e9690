#include "engine/program/cli/help_text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include <sys/ioctl.h>
#include <unistd.h>

#include "engine/program/cli/words.h"

namespace tessera::program::cli {
namespace {

constexpr int kMinColumns = 40;
constexpr int kDefaultColumns = 80;
constexpr std::size_t kTextColumn = 30;   // text next to an option begins here
constexpr std::size_t kNarrowColumn = 8;  // text below an option begins here, on narrow terminals
constexpr std::size_t kNarrowWidth = 60;
constexpr std::size_t kMinCommentWidth = 20;

/// Characters of UTF-8 text, each of which takes a column.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// Parts of a shell command that stay together: each option with its values.
std::vector<std::string> command_parts(const std::string& command) {
  std::vector<std::string> parts;
  for (const std::string& word : words_of(command))
    if (parts.empty() || word.starts_with('-') || word == ">" || word == "<") parts.push_back(word);
    else parts.back() += " " + word;
  return parts;
}

/// Appends words, beginning at column `at` of the last line of `lines`; following lines begin at `indent`.
/// @param line_end  ends a line that continues
void append_wrapped(std::string& lines, const std::vector<std::string>& words, std::size_t at,
                    std::size_t indent, std::size_t columns, const std::string& line_end = "") {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t width = columns_of(words[i]);
    const std::size_t end = i + 1 < words.size() ? line_end.size() : 0;
    if (i > 0 && at + 1 + width + end <= columns) {
      lines += ' ';
      ++at;
    } else if (i > 0) {
      lines += line_end + "\n" + std::string(indent, ' ');
      at = indent;
    }
    lines += words[i];
    at += width;
  }
  lines += "\n";
}

/// A name, and next to it or below it its meaning.
std::string entry(const std::string& heading, const std::string& text, std::size_t columns) {
  const std::size_t column = columns < kNarrowWidth ? kNarrowColumn : kTextColumn;
  std::string lines = "  " + heading;
  if (text.empty()) return lines + "\n";
  const std::size_t end = columns_of(lines);
  if (end + 2 > column) lines += "\n" + std::string(column, ' ');
  else lines.resize(lines.size() + column - end, ' ');
  append_wrapped(lines, words_of(text), column, column, columns);
  return lines;
}

std::string entries(const std::string& heading, std::span<const OptionDoc> options, std::size_t columns) {
  if (options.empty()) return "";
  std::string text = "\n" + heading + ":\n";
  for (const OptionDoc& option : options) text += entry(option_heading(option), option.text, columns);
  return text;
}

/// Lines of examples. Comments, which two spaces separate, are wrapped in their column or, if that is narrow,
/// begin in the next line. A command that is too long continues after a backslash.
std::string example_lines(const std::string& examples, std::size_t columns) {
  std::string text = examples.empty() ? "" : "\n";
  std::istringstream lines(examples);
  for (std::string line; std::getline(lines, line);) {
    if (columns_of(line) <= columns) {
      text += line + "\n";
      continue;
    }
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.find("  ", begin);
    const std::size_t comment = line.find_first_not_of(' ', gap);
    if (gap != std::string::npos && comment + kMinCommentWidth <= columns) {
      text += line.substr(0, comment);
      append_wrapped(text, words_of(line.substr(comment)), comment, comment, columns);
      continue;
    }
    text += std::string(begin, ' ');
    append_wrapped(text, command_parts(line.substr(begin, gap - begin)), begin, begin + 4, columns, " \\");
    if (gap == std::string::npos) continue;
    text += std::string(begin + 4, ' ');
    append_wrapped(text, words_of(line.substr(gap)), begin + 4, begin + 4, columns);
  }
  return text;
}

std::string usage_line(const CommandDoc& command, const std::string& program, std::size_t columns) {
  std::string words = program + (command.options.empty() ? "" : " [OPTIONS]");
  for (const OptionDoc& operand : command.operands) words += " " + operand.value;
  std::string line = "Usage: ";
  append_wrapped(line, words_of(words), line.size(), line.size() + 4, columns);
  return line;
}

}  // namespace

int help_columns() {
  int columns = 0;
  if (const char* const variable = std::getenv("COLUMNS"))
    std::from_chars(variable, variable + std::strlen(variable), columns);
  winsize size{};
  if (columns <= 0 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
  return columns <= 0 ? kDefaultColumns : std::max(columns, kMinColumns);
}

std::string command_help(const CommandDoc& command, const std::string& program, int columns) {
  const auto width = static_cast<std::size_t>(columns);
  std::string text = usage_line(command, program, width) + "\n";
  append_wrapped(text, words_of(command.text), 0, 0, width);
  return text + entries("Operands", command.operands, width) + entries("Options", command.options, width) +
         example_lines(command.examples, width);
}

std::string program_help(const CommandDoc& whole, std::span<const CommandDoc> commands, int columns) {
  const auto width = static_cast<std::size_t>(columns);
  std::string text = "Usage: " + whole.name + " COMMAND [OPTIONS]\n\n";
  append_wrapped(text, words_of(whole.text), 0, 0, width);
  text += "\nCommands:\n";
  for (const CommandDoc& command : commands) text += entry(command.name, command.text, width);
  return text + entries("Options", whole.options, width) + example_lines(whole.examples, width);
}

}  // namespace tessera::program::cli
