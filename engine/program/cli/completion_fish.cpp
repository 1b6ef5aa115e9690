// Completion for fish 3.
#include "engine/program/cli/completion.h"
#include "engine/program/cli/shell_words.h"
#include "engine/program/cli/value_kind.h"

namespace tessera::program::cli {
namespace {

using Source = ValueKind::Source;

constexpr const char* kFishBegin = R"(# fish completion for tessera
function __tessera_command
    set -l words (commandline -opc)
    test (count $words) -gt 1; and test $words[2] = $argv[1]
end
function __tessera_no_command
    test (count (commandline -opc)) -eq 1
end
complete -c tessera -f
)";

/// Quotes as fish does: a backslash before a quote or a backslash.
std::string in_fish_quotes(const std::string& text) {
  return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

/// Options of `complete` that propose values of a kind, and nothing else.
std::string arguments(const ValueKind& kind) {
  switch (kind.source) {
    case Source::text: return " -f";
    case Source::files: return " -F";
    case Source::folders: return " -f -a '(__fish_complete_directories (commandline -ct))'";
    case Source::choices: break;
    case Source::listed: return " -f -a '(" + kind.command + " 2>/dev/null | string split -f 1 \" \")'";
  }
  if (kind.is_list)
    return " -f -a '(__fish_complete_list , \"printf %s\\\\\\\\n " + joined(kind.choices, " ") + "\")'";
  return " -f -a " + in_fish_quotes(joined(kind.choices, " "));
}

std::string option_line(const OptionDoc& option, const std::vector<CommandDoc>& commands) {
  std::string text;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.value.empty()) {
    if (!has_optional_value(option)) text += " -r";
    text += arguments(value_kind(option, commands));
  }
  return text + " -d " + in_fish_quotes(option.text) + "\n";
}

}  // namespace

std::string fish_completion(const std::vector<CommandDoc>& commands) {
  std::string text = kFishBegin;
  for (const CommandDoc& command : commands) {
    text += "complete -c tessera -n __tessera_no_command -a " + command.name + " -d " +
            in_fish_quotes(command.text) + "\n";
    const std::string condition = "complete -c tessera -n '__tessera_command " + command.name + "'";
    for (const OptionDoc& option : command.options) text += condition + option_line(option, commands);
    if (!command.operands.empty())
      text += condition + arguments(value_kind(command.operands.front(), commands)) + "\n";
  }
  return text +
         "complete -c tessera -n __tessera_no_command -l help -d 'print this help'\n"
         "complete -c tessera -n __tessera_no_command -l version -d 'print the version'\n";
}

}  // namespace tessera::program::cli
