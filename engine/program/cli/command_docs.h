// Descriptions of commands and their options, from which help, completions and the manual page are made.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tessera::program::cli {

struct OptionDoc {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for an operand
  std::string value;               ///< "FILE", "flat|gouraud|phong"; empty: a flag
  std::string text;
};
struct CommandDoc {
  std::string name;
  std::string text;
  std::string examples;  ///< lines; may begin with a heading
  std::vector<OptionDoc> options;
  std::vector<OptionDoc> operands;
};

/// Describes a command. Hidden options are left out.
CommandDoc doc_of(const CLI::App& command);
/// Describes all commands of a program, in the order of its help.
std::vector<CommandDoc> docs_of_commands(const CLI::App& program);

/// A description as JSON, in which other programs of the package describe their commands.
std::string doc_json(const CommandDoc& doc);
/// @throws std::exception  for text that doc_json() does not write
CommandDoc parse_doc(const std::string& json);

/// "[=text|json]": the value is optional and must be attached by "=".
bool has_optional_value(const OptionDoc& option);
/// The value without the brackets of an optional one: "text|json".
std::string plain_value(const OptionDoc& option);
/// "-o, --output FILE", "--stats[=text|json]"; the value of an operand.
std::string option_heading(const OptionDoc& option);

}  // namespace tessera::program::cli
