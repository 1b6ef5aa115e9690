// The program's commands and options as data, and what is made of them for shells and for man.
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
  std::string name, text, examples;  ///< name empty: the program itself
  std::vector<OptionDoc> options;
  OptionDoc operand;  ///< without names; value empty: it takes none
};

/// A completion script for "bash", "zsh" or "fish".
std::string completion_script(const std::string& shell, const std::vector<CommandDoc>& commands);

/// tessera(1), in the language of man.
std::string man_page(const std::vector<CommandDoc>& commands, const std::string& version);

}  // namespace tessera::program::cli
