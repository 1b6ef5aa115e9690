// Completion for zsh 5, by its function _arguments.
#include "engine/program/cli/completion.h"
#include "engine/program/cli/shell_words.h"
#include "engine/program/cli/value_kind.h"

namespace tessera::program::cli {
namespace {

using Source = ValueKind::Source;

/// Text in a specification, in which brackets and colons have a meaning.
std::string escaped(const std::string& text) {
  return replaced(replaced(replaced(text, "[", "\\["), "]", "\\]"), ":", "\\:");
}

/// Action that proposes values of a kind.
std::string action(const ValueKind& kind) {
  switch (kind.source) {
    case Source::text: return "";
    case Source::files: return "_files";
    case Source::folders: return "_files -/";
    case Source::choices: break;
    case Source::listed: return "{compadd -- ${${(f)\"$(" + kind.command + " 2>/dev/null)\"}%% *}}";
  }
  if (kind.is_list) return "_values -s , value " + joined(kind.choices, " ");
  return "(" + joined(kind.choices, " ") + ")";
}

/// ":message:action", for the value of an option or an operand.
std::string value_part(const OptionDoc& option, const std::vector<CommandDoc>& commands) {
  if (option.value.empty()) return "";
  return ":" + escaped(plain_value(option)) + ":" + action(value_kind(option, commands));
}

std::string option_specifications(const OptionDoc& option, const std::vector<CommandDoc>& commands) {
  const bool repeats = option.text.find("may be repeated") != std::string::npos;
  const std::string exclusion = repeats ? "*" : "(" + joined(option.names, " ") + ")";
  std::string text;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    std::string sign = is_long && !option.value.empty() ? "=" : "";
    if (has_optional_value(option)) sign = "=-";
    text += " \\\n        " +
            in_single_quotes(exclusion + name + sign + "[" + escaped(option.text) + "]" +
                             (has_optional_value(option) ? ":" : "") + value_part(option, commands));
  }
  return text;
}

std::string operand_specification(const CommandDoc& command, const std::vector<CommandDoc>& commands) {
  std::string text;
  for (const OptionDoc& operand : command.operands) {
    const bool repeats = operand.value.find("...") != std::string::npos;
    text += " \\\n        " + in_single_quotes((repeats ? "*" : ":") + value_part(operand, commands));
  }
  return text;
}

}  // namespace

std::string zsh_completion(const std::vector<CommandDoc>& commands) {
  std::string text =
      "#compdef tessera\n_tessera() {\n  local -a commands\n  if (( CURRENT == 2 )); then\n    commands=(\n";
  for (const CommandDoc& command : commands)
    text += "      " + in_single_quotes(command.name + ":" + replaced(command.text, ":", "\\:")) + "\n";
  text +=
      "    )\n    _describe command commands\n    return\n  fi\n  shift words\n  (( CURRENT-- ))\n"
      "  case $words[1] in\n";
  for (const CommandDoc& command : commands) {
    text += "    " + command.name + ")\n      _arguments -s";
    for (const OptionDoc& option : command.options) text += option_specifications(option, commands);
    text += operand_specification(command, commands) + " ;;\n";
  }
  // The file is a function of $fpath, or is sourced.
  return text +
         "  esac\n}\nif [[ $funcstack[1] == _tessera ]]; then _tessera \"$@\"; else compdef _tessera "
         "tessera; fi\n";
}

}  // namespace tessera::program::cli
