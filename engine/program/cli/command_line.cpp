#include "engine/program/cli/command_line.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <span>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/program/cli/command_docs.h"
#include "engine/program/cli/help_text.h"
#include "engine/program/cli/printable.h"
#include "engine/program/scene/suggest.h"

namespace tessera::program::cli {
namespace {

using Names = std::vector<std::string_view>;

/// Refuses "--name=": CLI11 would take the next argument as its value.
void refuse_empty_values(std::span<char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "--") break;
    if (argument.starts_with("--") && argument.ends_with('='))
      throw UsageError(std::string(argument.substr(0, argument.size() - 1)) +
                       ": found \"\", expected a value");
  }
}

/// Returns whether a word is a command that another program parses.
bool is_parsed_elsewhere(std::string_view word, const CLI::App& program) {
  const auto is_meant = [word](const CLI::App* command) {
    return command->get_name() == word && command->get_prefix_command();
  };
  return !program.get_subcommands(is_meant).empty();
}

/// Long option names, for suggestions.
Names option_names(const CLI::App& app) {
  Names names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  return names;
}

/// Names of the commands; they belong to the program.
Names command_names(const CLI::App& program) {
  Names names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string unexpected_argument(const CLI::App& program) {
  const CLI::App* command = program.get_subcommands().empty() ? nullptr : program.get_subcommands().front();
  const std::string word = program.remaining(true).front();
  const std::string message = "unexpected argument \"" + word + "\"";
  if (word.starts_with("--")) {
    const std::string typed = word.substr(2, std::min(word.find('='), word.size()) - 2);
    const Names names = option_names(command != nullptr ? *command : program);
    const std::string_view nearest = nearest_name(typed, names);
    return message + (nearest.empty() ? "" : "; did you mean \"--" + std::string(nearest) + "\"?");
  }
  if (command != nullptr || command_names(program).empty()) return message;
  std::error_code error;
  if (std::filesystem::exists(word, error))
    return message + "; did you mean \"tessera render " + word + "\"?";
  return unknown_command(word, program);
}

/// The message of a parser's error. For a missing value CLI11 has "--output: 1 required TEXT missing".
std::string message_of(const CLI::ParseError& error, const CLI::App& program) {
  const std::string message = error.what();
  const std::string name = message.substr(0, message.find(':'));
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  const CLI::App& command = parsed.empty() ? program : *parsed.front();
  const CLI::Option* const option = command.get_option_no_throw(name);
  if (option == nullptr || !message.ends_with(" missing")) return message;
  return name + ": found no value, expected " + option->get_option_text();
}

}  // namespace

std::string help_of(const CLI::App& app) {
  const int columns = help_columns();
  const std::vector<CommandDoc> commands = docs_of_commands(app);
  if (!commands.empty()) return program_help(doc_of(app), commands, columns);
  const std::string parent = app.get_parent() != nullptr ? app.get_parent()->get_name() + " " : "";
  return command_help(doc_of(app), parent + app.get_name(), columns);
}

void set_help(CLI::App& program) {
  program.formatter_fn(
      [](const CLI::App* app, const std::string&, CLI::AppFormatMode) { return help_of(*app); });
  program.set_help_flag("-h,--help", "print this help");
}

std::optional<int> parse_arguments(CLI::App& program, int count, char** arguments) {
  if (command_names(program).empty())
    program.set_version_flag("--describe", [&program] { return doc_json(doc_of(program)); })->group("");
  const std::span<char* const> words(arguments, static_cast<std::size_t>(count));
  if (words.size() < 2 || !is_parsed_elsewhere(words[1], program)) refuse_empty_values(words);
  try {
    program.parse(count, arguments);
  } catch (const CLI::Success& request_for_text) {
    return program.exit(request_for_text);  // --help and --version
  } catch (const CLI::ExtrasError&) {
    throw UsageError(unexpected_argument(program));
  } catch (const CLI::ParseError& error) {
    throw UsageError(message_of(error, program));
  }
  return std::nullopt;
}

std::string unknown_command(const std::string& word, const CLI::App& program) {
  return "unknown command \"" + word + "\"" + did_you_mean(word, command_names(program));
}

int report_usage(const std::string& name, const std::string& message, const std::string& help) {
  std::cerr << name << ": error: " << printable(message) << " (see " << help << " --help)\n";
  return kBadUsage;
}

}  // namespace tessera::program::cli
