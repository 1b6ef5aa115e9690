// Generates shell completions and the manual page from a description of commands and options.
#pragma once

#include <string>
#include <vector>

namespace tessera::program::cli {

struct OptionDoc {
  std::vector<std::string> names;  ///< "-o", "--output"
  std::string value;               ///< "FILE", "flat|gouraud|phong"; empty: a flag
  std::string text;
};
struct CommandDoc {
  std::string name;  ///< empty: the program itself
  std::string text;
  std::string examples;
  std::vector<OptionDoc> options;
  OptionDoc operand;  ///< has no names; an empty value means that there is no operand
};

/// Returns a completion script for "bash", "zsh" or "fish".
std::string completion_script(const std::string& shell, const std::vector<CommandDoc>& commands);

/// Returns the manual page tessera(1) as roff.
std::string man_page(const std::vector<CommandDoc>& commands, const std::string& version);

}  // namespace tessera::program::cli
