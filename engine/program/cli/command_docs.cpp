#include "engine/program/cli/command_docs.h"

#include <algorithm>
#include <sstream>

namespace tessera::program::cli {
namespace {

// "[=text|json]": the value is optional and must be attached by "=".
bool has_optional_value(const OptionDoc& option) { return option.value.starts_with("[="); }

// Returns the choices of a value such as "flat|gouraud|phong"; empty for any other value.
std::vector<std::string> choices(const OptionDoc& option) {
  std::vector<std::string> list;
  if (option.value.find('|') == std::string::npos || option.value.find(' ') != std::string::npos) return list;
  std::string values = option.value;
  if (has_optional_value(option)) values = values.substr(2, values.size() - 3);
  std::istringstream stream(values);
  for (std::string choice; std::getline(stream, choice, '|');) list.push_back(choice);
  return list;
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

bool takes_file(const OptionDoc& option) {
  return option.value.find("FILE") != std::string::npos || option.value == "DIR";
}

std::vector<std::string> command_names(const std::vector<CommandDoc>& commands) {
  std::vector<std::string> names;
  for (const CommandDoc& command : commands)
    if (!command.name.empty()) names.push_back(command.name);
  return names;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string in_single_quotes(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

std::string bash_script(const std::vector<CommandDoc>& commands) {
  std::string text =
      "# bash completion for tessera\n_tessera() {\n  local word=${COMP_WORDS[COMP_CWORD]} "
      "before=${COMP_WORDS[COMP_CWORD-1]} command= w\n"
      "  for w in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do [[ $w != -* ]] && { command=$w; break; }; done\n  "
      "COMPREPLY=()\n  case $command in\n";
  for (const CommandDoc& command : commands) {
    if (command.name.empty()) continue;
    text += "    " + command.name + ")\n      case $before in\n";
    std::vector<std::string> all;
    for (const OptionDoc& option : command.options) {
      all.insert(all.end(), option.names.begin(), option.names.end());
      const std::vector<std::string> values = choices(option);
      if (!values.empty() && !has_optional_value(option))
        text += "        " + joined(option.names, "|") + ") COMPREPLY=($(compgen -W \"" +
                joined(values, " ") + "\" -- \"$word\")); return;;\n";
      else if (takes_file(option))
        text +=
            "        " + joined(option.names, "|") + ") COMPREPLY=($(compgen -f -- \"$word\")); return;;\n";
    }
    const std::vector<std::string> operands = choices(command.operand);
    const std::string operand = operands.empty() ? "-f" : "-W \"" + joined(operands, " ") + "\"";
    text += "      esac\n      if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"" + joined(all, " ") +
            "\" -- \"$word\")); else COMPREPLY=($(compgen " + operand + " -- \"$word\")); fi;;\n";
  }
  text += "    *) COMPREPLY=($(compgen -W \"" + joined(command_names(commands), " ") +
          " --help --version\" -- \"$word\"));;\n  esac\n}\ncomplete -o filenames -F _tessera tessera\n";
  return text;
}

std::string zsh_script(const std::vector<CommandDoc>& commands) {
  const auto escaped = [](const std::string& text) {
    return replaced(replaced(replaced(text, "[", "\\["), "]", "\\]"), ":", "\\:");
  };
  std::string text = "#compdef tessera\n_tessera() {\n  local -a commands\n  commands=(";
  for (const CommandDoc& command : commands)
    if (!command.name.empty())
      text += in_single_quotes(command.name + ":" + replaced(command.text, ":", "\\:")) + " ";
  text +=
      ")\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n  shift words; (( CURRENT-- "
      "))\n  case $words[1] in\n";
  for (const CommandDoc& command : commands) {
    if (command.name.empty()) continue;
    text += "    " + command.name + ") _arguments";
    for (const OptionDoc& option : command.options)
      for (const std::string& option_name : option.names) {
        const std::vector<std::string> values = choices(option);
        std::string spec = option_name + "[" + escaped(option.text) + "]";
        if (!values.empty() && has_optional_value(option))
          spec = option_name + "=-[" + escaped(option.text) + "]::value:(" + joined(values, " ") + ")";
        else if (!values.empty()) spec += ":value:(" + joined(values, " ") + ")";
        else if (takes_file(option)) spec += ":file:_files";
        else if (!option.value.empty()) spec += ":" + escaped(option.value) + ":";
        text += " " + in_single_quotes(spec);
      }
    const std::vector<std::string> operands = choices(command.operand);
    text += operands.empty() ? " '*:file:_files';;\n" : " '1:value:(" + joined(operands, " ") + ")';;\n";
  }
  return text + "  esac\n}\n_tessera \"$@\"\n";
}

std::string fish_script(const std::vector<CommandDoc>& commands) {
  std::string text = "# fish completion for tessera\n";
  const std::string names = joined(command_names(commands), " ");
  for (const CommandDoc& command : commands) {
    if (command.name.empty()) continue;
    text += "complete -c tessera -f -n 'not __fish_seen_subcommand_from " + names + "' -a " + command.name +
            " -d " + in_single_quotes(command.text) + "\n";
    for (const OptionDoc& option : command.options) {
      text += "complete -c tessera -n '__fish_seen_subcommand_from " + command.name + "'";
      for (const std::string& option_name : option.names)
        text +=
            option_name.starts_with("--") ? " -l " + option_name.substr(2) : " -s " + option_name.substr(1);
      const std::vector<std::string> values = choices(option);
      if (!values.empty())
        text += std::string(has_optional_value(option) ? " -f" : " -x") + " -a " +
                in_single_quotes(joined(values, " "));
      else if (!option.value.empty()) text += takes_file(option) ? " -r -F" : " -x";
      text += " -d " + in_single_quotes(option.text) + "\n";
    }
    if (const std::vector<std::string> operands = choices(command.operand); !operands.empty())
      text += "complete -c tessera -f -n '__fish_seen_subcommand_from " + command.name + "' -a " +
              in_single_quotes(joined(operands, " ")) + "\n";
  }
  return text;
}

// Escapes text for roff: a line must not start with a dot or a quote, which mark requests, and "-" must not
// become a typographic hyphen.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
  return replaced(replaced(escaped, "\n.", "\n\\&."), "\n'", "\n\\&'");
}

}  // namespace

std::string completion_script(const std::string& shell, const std::vector<CommandDoc>& commands) {
  if (shell == "bash") return bash_script(commands);
  if (shell == "zsh") return zsh_script(commands);
  return fish_script(commands);
}

std::string man_page(const std::vector<CommandDoc>& commands, const std::string& version) {
  std::string text =
      ".TH TESSERA 1 \"\" \"tessera " + roff(version) +
      "\"\n.SH NAME\ntessera \\- a multithreaded, tile\\-based software rasterizer\n.SH SYNOPSIS\n";
  for (const CommandDoc& command : commands)
    if (!command.name.empty()) text += ".B tessera " + command.name + "\n[options]\n.br\n";
  text += ".SH COMMANDS\n";
  for (const CommandDoc& command : commands) {
    if (command.name.empty()) continue;
    text += ".SS tessera " + command.name +
            (command.operand.value.empty() ? "" : " \\fI" + roff(command.operand.value) + "\\fR") + "\n" +
            roff(command.text) + "\n";
    for (const OptionDoc& option : command.options) {
      text += ".TP\n.BR ";
      std::vector<std::string> names;
      for (const std::string& option_name : option.names) names.push_back(roff(option_name));
      text += joined(names, " \", \" ") +
              (option.value.empty() ? "" : " \" \" \\fI" + roff(option.value) + "\\fR") + "\n" +
              roff(option.text) + "\n";
    }
    if (!command.examples.empty()) text += ".PP\n.nf\n" + roff(command.examples) + "\n.fi\n";
  }
  text +=
      ".SH ENVIRONMENT\n.TP\n.B TESSERA_THREADS\ndefault of \\-\\-threads\n"
      ".TP\n.B NO_COLOR\nif set and not empty, pictures in the terminal consist of letters\n"
      ".SH EXIT STATUS\n0 success, 1 failure, 2 wrong usage, 3 the picture differs from its reference or the "
      "self\\-test failed, 130 interrupted\n";
  return text;
}

}  // namespace tessera::program::cli
