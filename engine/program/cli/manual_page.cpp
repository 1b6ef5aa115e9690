#include "engine/program/cli/manual_page.h"

#include <sstream>

#include "engine/program/cli/shell_words.h"

namespace tessera::program::cli {
namespace {

// Date of the page's text: a constant, so that every build prints the same page.
constexpr const char* kDate = "2026-11-30";

constexpr const char* kDescription =
    "Tessera renders scenes and models on the processor, bit for bit the same on every machine. If an option "
    "is given more than once, the last one holds, unless its description says otherwise. An option that "
    "would "
    "have no effect is an error.";
constexpr const char* kReasons =
    "Every status but 0 comes with a line on the standard error that gives the reason.";

struct Term {
  const char* name;
  const char* text;
};

// README.md has this table under "Exit codes".
constexpr Term kExitCodes[] = {
    {"0", "success"},
    {"1", "failure: a file cannot be read or written, a scene or a model is invalid, memory is exhausted"},
    {"2",
     "wrong usage: a command, an option or a value is unknown; options contradict each other or the "
     "input; an option has no effect"},
    {"3",
     "the picture differs from its reference (render --compare), the self-test failed, or a "
     "workload is slower than before (bench --compare)"},
    {"130", "interrupted by Ctrl-C"},
};

constexpr Term kVariables[] = {
    {"TESSERA_THREADS", "default of --threads, 1 to 1024"},
    {"NO_COLOR", "if set and not empty, pictures in the terminal consist of letters"},
    {"COLUMNS", "width of help in columns, in place of the terminal's"},
    {"TMPDIR", "folder for the model that the input - holds; default: /tmp"},
    {"XDG_CACHE_HOME", "folder of the cache; default: $HOME/.cache"},
};

constexpr Term kFiles[] = {
    {"tessera.png, INPUT.render.png",
     "pictures of render without -o, in the current folder; with several frames INPUT.render_{frame}.png"},
    {"$XDG_CACHE_HOME/tessera/prices-*.json", "prices that tessera price has measured"},
    {"libtessera_imageio.so.*, libtessera_import.so.*",
     "modules for the formats of pictures and models; searched next to the program, in ../lib and in the "
     "system's library path"},
    {"tessera-bench, tessera-accuracy",
     "programs of bench, price and accuracy; searched next to the program and in ../libexec/tessera"},
};

/// Escapes text: a line must not start with a dot or a quote, which mark requests, and "-" must not become a
/// typographic hyphen.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  escaped = replaced(replaced(replaced(escaped, "'", "\\(aq"), "^", "\\(ha"), "~", "\\(ti");
  if (escaped.starts_with('.')) escaped.insert(0, "\\&");
  return replaced(escaped, "\n.", "\n\\&.");
}

/// Escaped text in lines of at most 78 characters, or one word.
std::string roff_lines(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    constexpr std::size_t kMaxLine = 78;
    if (!line.empty() && line.size() + 1 + roff(word).size() > kMaxLine) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + roff(word);
  }
  return lines + line + "\n";
}

template <std::size_t N>
std::string terms(const std::string& heading, const Term (&list)[N]) {
  std::string text = ".SH " + heading + "\n";
  for (const auto& [name, description] : list)
    text += ".TP\n.B " + roff(name) + "\n" + roff_lines(description);
  return text;
}

std::string option_entry(const OptionDoc& option) {
  std::string heading;
  for (const std::string& name : option.names)
    heading += (heading.empty() ? "" : ", ") + std::string("\\fB") + roff(name) + "\\fR";
  const bool needs_space = !heading.empty() && !option.value.empty() && !has_optional_value(option);
  return ".TP\n" + heading + (needs_space ? " " : "") +
         (option.value.empty() ? "" : "\\fI" + roff(option.value) + "\\fR") + "\n" + roff_lines(option.text);
}

/// The lines of examples, without their heading and the tables after them.
std::string roff_examples(const std::string& examples) {
  std::istringstream lines(examples);
  std::string text;
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (!line.ends_with(':')) text += roff(line) + "\n";
  return text;
}

std::string command_section(const CommandDoc& command) {
  std::string heading = "tessera " + command.name;
  std::string text = roff_lines(command.text + ".");
  for (const OptionDoc& operand : command.operands) {
    heading += " " + operand.value;
    text += option_entry(operand);
  }
  for (const OptionDoc& option : command.options) text += option_entry(option);
  return ".SS " + roff(heading) + "\n" + text;
}

std::string synopsis(const std::vector<CommandDoc>& commands) {
  std::string text = ".SH SYNOPSIS\n";
  for (const CommandDoc& command : commands) {
    text += "\\fBtessera " + roff(command.name) + "\\fR [\\fIoptions\\fR]";
    for (const OptionDoc& operand : command.operands) text += " \\fI" + roff(operand.value) + "\\fR";
    text += "\n.br\n";
  }
  return text + "\\fBtessera\\fR \\-\\-help | \\-\\-version\n";
}

}  // namespace

std::string manual_page(const std::vector<CommandDoc>& commands, const std::string& version) {
  std::string text = ".TH TESSERA 1 \"" + std::string(kDate) + "\" \"tessera " + roff(version) +
                     "\" \"User Commands\"\n.SH NAME\ntessera \\- multithreaded, tile-based software "
                     "rasterizer\n" +
                     synopsis(commands) + ".SH DESCRIPTION\n" + roff_lines(kDescription) + ".SH COMMANDS\n";
  for (const CommandDoc& command : commands) text += command_section(command);
  text += terms("ENVIRONMENT", kVariables) + terms("FILES", kFiles) + terms("EXIT STATUS", kExitCodes) +
          ".PP\n" + roff_lines(kReasons) + ".SH EXAMPLES\n";
  for (const CommandDoc& command : commands)
    if (const std::string lines = roff_examples(command.examples); !lines.empty())
      text += ".SS tessera " + roff(command.name) + "\n.nf\n" + lines + ".fi\n";
  return text;
}

}  // namespace tessera::program::cli
