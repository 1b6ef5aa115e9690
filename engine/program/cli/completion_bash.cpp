// Completion for bash 4.4 and later.
#include "engine/program/cli/completion.h"
#include "engine/program/cli/shell_words.h"
#include "engine/program/cli/value_kind.h"

namespace tessera::program::cli {
namespace {

using Source = ValueKind::Source;

// Readline completes the names of files and folders itself, because it quotes spaces. "=" separates words.
constexpr const char* kBashBegin = R"(# bash completion for tessera
_tessera_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }
_tessera_list() { mapfile -t COMPREPLY < <(compgen -P "${word%"${word##*,}"}" -W "$1" -- "${word##*,}"); }
_tessera_files() { compopt -o default; }
_tessera_folders() { compopt -o dirnames; }
_tessera() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if [[ $word == = ]]; then
    word=
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  if (( COMP_CWORD == 1 )); then
)";
constexpr const char* kBashEnd = R"(  esac
}
complete -F _tessera tessera
)";

/// Command that proposes values of a kind; empty: none are.
std::string proposal(const ValueKind& kind) {
  switch (kind.source) {
    case Source::text: return "";
    case Source::files: return "_tessera_files";
    case Source::folders: return "_tessera_folders";
    case Source::choices: break;
    case Source::listed:
      return "_tessera_words \"$(" + kind.command +
             " 2>/dev/null | while read -r w _; do echo \"$w\"; done)\"";
  }
  return std::string(kind.is_list ? "_tessera_list" : "_tessera_words") + " \"" + joined(kind.choices, " ") +
         "\"";
}

std::string command_case(const CommandDoc& command, const std::vector<CommandDoc>& commands) {
  std::string text = "    " + command.name + ")\n      case $before in\n";
  std::vector<std::string> names;
  for (const OptionDoc& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    // A value that is optional must follow "=".
    const std::string condition = has_optional_value(option) ? "[[ $COMP_LINE == *=* ]] && " : "";
    if (!option.value.empty())
      text +=
          "        " + joined(option.names, "|") + ") " + condition +
          (proposal(value_kind(option, commands)).empty() ? ":" : proposal(value_kind(option, commands))) +
          (condition.empty() ? "; return" : " && return") + " ;;\n";
  }
  text += "      esac\n      if [[ $word == -* ]]; then _tessera_words \"" + joined(names, " ") + "\"\n";
  if (!command.operands.empty()) {
    const std::string operand = proposal(value_kind(command.operands.front(), commands));
    if (!operand.empty()) text += "      else " + operand + "\n";
  }
  return text + "      fi ;;\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandDoc>& commands) {
  std::string names;
  for (const CommandDoc& command : commands) names += command.name + " ";
  std::string text = kBashBegin;
  text +=
      "    _tessera_words \"" + names + "--help --version\"\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n";
  for (const CommandDoc& command : commands) text += command_case(command, commands);
  return text + kBashEnd;
}

std::string completion_script(const std::string& shell, const std::vector<CommandDoc>& commands) {
  if (shell == "bash") return bash_completion(commands);
  return shell == "zsh" ? zsh_completion(commands) : fish_completion(commands);
}

}  // namespace tessera::program::cli
