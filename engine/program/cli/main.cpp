// The program tessera. Exit codes are those of exit_codes.h; a line on stderr gives the reason of all but 0.
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/program/cli/bench_command.h"
#include "engine/program/cli/color_command.h"
#include "engine/program/cli/command_docs.h"
#include "engine/program/cli/command_line.h"
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/completion.h"
#include "engine/program/cli/display_command.h"
#include "engine/program/cli/gallery_command.h"
#include "engine/program/cli/info_command.h"
#include "engine/program/cli/manual_page.h"
#include "engine/program/cli/modes_command.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/render_command.h"
#include "engine/program/cli/scene_command.h"
#include "engine/program/cli/selftest_command.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/cli/validators.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

constexpr const char* kProgramExamples = R"(Examples:
  tessera render                                  the built-in teapot, as tessera.png
  tessera help render                             options of render
  tessera explain scene.json                      which effects run for each draw, and why
  tessera compare a.png b.png                     how much two pictures differ, and how visibly
  tessera color '#80ff00' --to lab                a colour in another colour space
  tessera display a.png --display vga14 -o b.png  a picture as a monitor shows it
  tessera info                                    this machine and its instruction sets
  tessera selftest                                check that this machine renders correctly
  tessera completion bash > /etc/bash_completion.d/tessera)";

int usage_error(const std::string& message, const CLI::App& program) {
  const bool in_command = !program.get_subcommands().empty();
  return report_usage("tessera", message,
                      "tessera" + (in_command ? " " + program.get_subcommands().front()->get_name() : ""));
}

/// Sets `threads` from TESSERA_THREADS unless an option did.
/// @throws UsageError
void read_threads_variable(int& threads) {
  const char* const value = std::getenv("TESSERA_THREADS");
  if (value == nullptr || *value == '\0' || threads != 0) return;
  std::string text = value;
  if (const std::string wrong = integer_from(1, 1024)(text); !wrong.empty())
    throw UsageError("TESSERA_THREADS: " + wrong);
  CLI::detail::lexical_cast(text, threads);  // integer_from() made it decimal
}

/// All commands, with the options of those that other programs execute.
std::vector<CommandDoc> all_docs(const CLI::App& program) {
  std::vector<CommandDoc> docs = docs_of_commands(program);
  for (CommandDoc& doc : docs) {
    const std::optional<CommandDoc> executed = measurement_doc(doc.name);
    if (!executed) continue;
    doc.options = executed->options;
    doc.operands = executed->operands;
    doc.examples = executed->examples;
  }
  return docs;
}

/// Values that parsing fills in.
struct Requests {
  RenderRequest render;
  ExplainRequest explain;
  CompareRequest compare;
  ModesRequest modes;
  ColorRequest color;
  DisplayCommandRequest display;
  SceneRequest scene;
  GalleryRequest gallery;
  SelftestRequest selftest;
  std::string shell;  ///< for `completion`
  std::string topic;  ///< for `help`: a command; empty: the program
};

/// The subcommands; they belong to the program.
struct Commands {
  CLI::App* render;
  CLI::App* explain;
  CLI::App* compare;
  CLI::App* modes;
  CLI::App* color;
  CLI::App* display;
  CLI::App* scene;
  CLI::App* gallery;
  CLI::App* info;
  CLI::App* selftest;
  CLI::App* bench;
  CLI::App* price;
  CLI::App* accuracy;
  CLI::App* formats;
  CLI::App* completion;
  CLI::App* man;
};

/// A command of tessera-bench or tessera-accuracy, which parse their arguments.
CLI::App* add_measurement(CLI::App& program, const char* name, const char* text, const char* examples) {
  CLI::App* command = program.add_subcommand(name, text);
  command->set_help_flag();
  command->prefix_command();
  command->footer(std::string("Examples:\n  ") + examples);
  return command;
}

CLI::App* add_completion(CLI::App& program, std::string& shell) {
  CLI::App* completion = program.add_subcommand("completion", "Print a completion script for a shell");
  completion->add_option("shell", shell, "bash, zsh or fish")
      ->option_text("bash|zsh|fish")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  completion->footer(
      "Examples:\n  tessera completion bash > /etc/bash_completion.d/tessera\n"
      "  tessera completion zsh > /usr/share/zsh/vendor-completions/_tessera\n"
      "  tessera completion fish > ~/.config/fish/completions/tessera.fish");
  return completion;
}

void add_help(CLI::App& program, std::string& topic) {
  CLI::App* help = program.add_subcommand("help", "Print the help of a command");
  help->add_option("command", topic, "a command; default: the program itself")->option_text("[COMMAND]");
  help->footer("Examples:\n  tessera help\n  tessera help render");
}

/// Prints the help of a command.
/// @param topic  empty: of the program
void print_help(const CLI::App& program, const std::string& topic) {
  if (measurement_doc(topic)) exec_measurement(topic, {"--help"});
  const std::vector<const CLI::App*> found =
      program.get_subcommands([&topic](const CLI::App* command) { return command->get_name() == topic; });
  if (found.empty() && !topic.empty()) throw UsageError(unknown_command(topic, program));
  std::cout << help_of(found.empty() ? program : *found.front());
}

/// Adds the subcommands in the order of --help.
Commands add_commands(CLI::App& program, Requests& requests) {
  const auto add_plain = [&program](const char* name, const char* text, const char* example) {
    CLI::App* command = program.add_subcommand(name, text);
    command->footer(std::string("Examples:\n  ") + example);
    return command;
  };
  Commands commands{};
  commands.render = add_render(program, requests.render);
  commands.explain = add_explain(program, requests.explain);
  commands.compare = add_compare(program, requests.compare);
  commands.modes = add_modes(program, requests.modes);
  commands.color = add_color(program, requests.color);
  commands.display = add_display(program, requests.display);
  commands.scene = add_scene(program, requests.scene);
  commands.gallery = add_gallery(program, requests.gallery);
  commands.info = add_plain("info", "Describe this machine and what Tessera uses of it", "tessera info");
  commands.selftest = add_selftest(program, requests.selftest);
  commands.bench =
      add_measurement(program, "bench", "Run benchmarks on this machine",
                      "tessera bench fill grid-2M\n  tessera bench --json before.json\n  tessera bench "
                      "--compare before.json");
  commands.price =
      add_measurement(program, "price", "Measure what effects cost on this machine",
                      "tessera price\n  tessera price pixel vertex_spot\n  tessera price --json prices.json");
  commands.accuracy =
      add_measurement(program, "accuracy", "Measure what accuracy costs in time",
                      "tessera accuracy -o costs\n  tessera accuracy -o costs --quick\n  tessera accuracy -o "
                      "costs --scenes none "
                      "mine.json");
  commands.formats =
      add_plain("formats", "List the file formats of scenes, models and pictures", "tessera formats");
  commands.completion = add_completion(program, requests.shell);
  commands.man = add_plain("man", "Print the manual page, for man -l -", "tessera man | man -l -");
  add_help(program, requests.topic);
  return commands;
}

/// The option --threads of the command that was parsed; null: it has none.
int* threads_of(const Commands& commands, Requests& requests) {
  if (commands.render->parsed()) return &requests.render.options.threads;
  if (commands.explain->parsed() && requests.explain.measure) return &requests.explain.threads;
  if (commands.compare->parsed()) return &requests.compare.threads;
  if (!requests.modes.comparison.folder.empty()) return &requests.modes.comparison.threads;
  if (commands.display->parsed()) return &requests.display.threads;
  if (commands.gallery->parsed()) return &requests.gallery.threads;
  return commands.selftest->parsed() ? &requests.selftest.threads : nullptr;
}

/// Runs the command that was parsed; without one, prints the help.
int run_command(const CLI::App& program, const Commands& commands, Requests& requests) {
  if (int* const threads = threads_of(commands, requests); threads != nullptr)
    read_threads_variable(*threads);
  // A closed pipe is an error of the write. Commands that print text end silently, as others in pipelines do.
  for (const CLI::App* writer :
       {commands.render, commands.compare, commands.modes, commands.display, commands.scene})
    if (writer->parsed()) std::signal(SIGPIPE, SIG_IGN);
  for (const CLI::App* command : {commands.bench, commands.price, commands.accuracy})
    if (command->parsed()) exec_measurement(command->get_name(), command->remaining());
  if (commands.selftest->parsed()) return selftest(requests.selftest);
  if (commands.render->parsed()) {
    RenderRequest& request = requests.render;
    if (!request.stats_name.empty())
      request.stats = request.stats_name == "json" ? StatsFormat::json : StatsFormat::text;
    return render(std::move(request));
  }
  if (commands.explain->parsed()) return explain(requests.explain);
  if (commands.compare->parsed()) return compare(requests.compare);
  if (!requests.modes.comparison.folder.empty()) {
    requests.modes.comparison.json = requests.modes.json;
    return compare_modes(requests.modes.comparison);
  }
  if (commands.modes->parsed()) std::cout << modes_text(requests.modes);
  else if (commands.color->parsed()) std::cout << colors_text(requests.color);
  else if (commands.display->parsed()) display(requests.display);
  else if (commands.scene->parsed()) write_model_scene(requests.scene);
  else if (commands.gallery->parsed()) gallery(requests.gallery);
  else if (commands.info->parsed()) std::cout << info_text();
  else if (commands.formats->parsed()) std::cout << formats_text();
  else if (commands.completion->parsed()) std::cout << completion_script(requests.shell, all_docs(program));
  else if (commands.man->parsed()) std::cout << manual_page(all_docs(program), std::string(version()));
  else print_help(program, requests.topic);
  return 0;
}

int run(int argument_count, char** arguments) {
  CLI::App program{"Tessera, a multithreaded tile-based software rasterizer", "tessera"};
  set_help(program);
  program.set_version_flag("--version", std::string("tessera " TESSERA_VERSION), "print the version");
  program.footer(kProgramExamples);
  program.require_subcommand(0, 1);
  Requests requests;
  const Commands commands = add_commands(program, requests);
  try {
    if (const std::optional<int> code = parse_arguments(program, argument_count, arguments)) return *code;
    return run_command(program, commands, requests);
  } catch (const UsageError& error) {
    return usage_error(error.what(), program);
  }
}

}  // namespace
}  // namespace tessera::program::cli

int main(int argument_count, char** arguments) {
  try {
    const int code = tessera::program::cli::run(argument_count, arguments);
    if (code == 0) tessera::program::cli::require_stdout_written();
    return code;
  } catch (const tessera::Cancelled&) {
    std::cerr << "tessera: interrupted; finished pictures are complete\n";
    return tessera::program::cli::kInterrupted;
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera: error: " << tessera::program::cli::printable(error.what()) << "\n";
  }
  return tessera::program::cli::kFailed;
}
