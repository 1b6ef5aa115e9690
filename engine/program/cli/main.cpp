// The program tessera. Exit codes: 0 success, 1 failure, 2 wrong usage, 3 the picture differs from its
// reference or the self-test failed, 130 interrupted. A line on stderr gives the reason.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/program/cli/bench_command.h"
#include "engine/program/cli/color_command.h"
#include "engine/program/cli/command_docs.h"
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/display_command.h"
#include "engine/program/cli/gallery_command.h"
#include "engine/program/cli/info_command.h"
#include "engine/program/cli/modes_command.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/render_command.h"
#include "engine/program/cli/scene_command.h"
#include "engine/program/cli/selftest_command.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/cli/validators.h"
#include "engine/program/scene/suggest.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;

constexpr const char* kProgramExamples = R"(Examples:
  tessera render                                  the built-in teapot, as tessera.png
  tessera render --help                           options of render
  tessera explain scene.json                      which effects run for each draw, and why
  tessera compare a.png b.png                     how much two pictures differ, and how visibly
  tessera color '#80ff00' --to lab                a colour in another colour space
  tessera display a.png --display vga14 -o b.png  a picture as a monitor shows it
  tessera info                                    this machine and its instruction sets
  tessera selftest                                check that this machine renders correctly
  tessera completion bash > /etc/bash_completion.d/tessera)";

/// Refuses "--name=": CLI11 would take the next argument as its value. Returns the error; empty: none.
std::string error_of_empty_value(std::span<char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "--") break;
    if (argument.starts_with("--") && argument.ends_with('='))
      return std::string(argument.substr(0, argument.size() - 1)) + ": found \"\", expected a value";
  }
  return "";
}

/// Long option names, for suggestions.
Names names_of(const CLI::App& app) {
  Names names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  return names;
}

std::string unexpected_argument(const CLI::App& program) {
  const CLI::App* command = program.get_subcommands().empty() ? nullptr : program.get_subcommands().front();
  const std::string word = program.remaining(true).front();
  const std::string message = "unexpected argument \"" + word + "\"";
  if (word.starts_with("--")) {
    const std::string typed =
        word.substr(2, word.find('=') == std::string::npos ? std::string::npos : word.find('=') - 2);
    const Names names = names_of(command != nullptr ? *command : program);
    const std::string_view nearest = nearest_name(typed, names);
    return message + (nearest.empty() ? "" : "; did you mean \"--" + std::string(nearest) + "\"?");
  }
  if (command != nullptr) return message;
  std::error_code error;
  if (std::filesystem::exists(word, error))
    return message + "; did you mean \"tessera render " + word + "\"?";
  return "unknown command \"" + word + "\"" +
         did_you_mean(word,
                      Names{"render", "explain", "compare", "info", "selftest", "bench", "price", "accuracy",
                            "modes", "color", "display", "scene", "gallery", "formats", "completion", "man"});
}

int usage_error(const std::string& message, const CLI::App& program) {
  const bool in_command = !program.get_subcommands().empty();
  std::cerr << "tessera: error: " << printable(message) << " (see tessera "
            << (in_command ? program.get_subcommands().front()->get_name() + " " : "") << "--help)\n";
  return kBadUsage;
}

/// Sets `threads` from TESSERA_THREADS unless an option did. Returns the error; empty: none.
std::string read_threads_variable(int& threads) {
  const char* const value = std::getenv("TESSERA_THREADS");
  if (value == nullptr || *value == '\0' || threads != 0) return "";
  std::string text = value;
  if (std::string wrong = integer_from(1, 1024)(text); !wrong.empty()) return wrong;
  CLI::detail::lexical_cast(text, threads);  // integer_from() made it decimal
  return "";
}

std::vector<CommandDoc> docs_of(const CLI::App& program) {
  std::vector<CommandDoc> docs;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    CommandDoc doc{.name = command->get_name(),
                   .text = command->get_description(),
                   .examples = command->get_footer(),
                   .options = {},
                   .operand = {}};
    for (const CLI::Option* option : command->get_options()) {
      OptionDoc entry{.names = {}, .value = option->get_option_text(), .text = option->get_description()};
      for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
      for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
      if (!entry.names.empty()) doc.options.push_back(entry);
      else if (doc.operand.value.empty()) doc.operand = entry;
      else doc.operand.value += " " + entry.value;
    }
    docs.push_back(doc);
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
      add_measurement(program, "bench", "Run benchmarks on this machine; see tessera bench --help",
                      "tessera bench fill grid-2M\n  tessera bench --json before.json\n  tessera bench "
                      "--compare before.json");
  commands.price =
      add_measurement(program, "price", "Measure what effects cost on this machine; see tessera price --help",
                      "tessera price\n  tessera price pixel vertex_spot\n  tessera price --json prices.json");
  commands.accuracy =
      add_measurement(program, "accuracy", "Measure what accuracy costs in time; see tessera accuracy --help",
                      "tessera accuracy -o costs\n  tessera accuracy -o costs --quick\n  tessera accuracy -o "
                      "costs --scenes none "
                      "mine.json");
  commands.formats =
      add_plain("formats", "List the file formats of scenes, models and pictures", "tessera formats");
  commands.completion = add_completion(program, requests.shell);
  commands.man = add_plain("man", "Print the manual page, for man -l -", "tessera man | man -l -");
  return commands;
}

int run(int argument_count, char** arguments) {
  CLI::App program{"Tessera, a multithreaded tile-based software rasterizer", "tessera"};
  program.set_version_flag("--version", std::string("tessera " TESSERA_VERSION));
  program.footer(kProgramExamples);
  program.require_subcommand(0, 1);
  Requests requests;
  const Commands commands = add_commands(program, requests);
  if (const std::string wrong = error_of_empty_value({arguments, static_cast<std::size_t>(argument_count)});
      !wrong.empty())
    return usage_error(wrong, program);
  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::Success& request_for_text) {
    return program.exit(request_for_text);  // --help and --version
  } catch (const CLI::ExtrasError&) {
    return usage_error(unexpected_argument(program), program);
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), program);
  }
  int* threads = nullptr;
  if (commands.render->parsed()) threads = &requests.render.options.threads;
  if (commands.explain->parsed() && requests.explain.measure) threads = &requests.explain.threads;
  if (commands.compare->parsed()) threads = &requests.compare.threads;
  const bool compares_modes = !requests.modes.comparison.folder.empty();
  if (compares_modes) threads = &requests.modes.comparison.threads;
  if (commands.display->parsed()) threads = &requests.display.threads;
  if (commands.gallery->parsed()) threads = &requests.gallery.threads;
  if (commands.selftest->parsed()) threads = &requests.selftest.threads;
  if (threads != nullptr)
    if (const std::string wrong = read_threads_variable(*threads); !wrong.empty())
      return usage_error("TESSERA_THREADS: " + wrong, program);
  // A closed pipe is an error of the write. Commands that print text end silently, as others in a pipeline
  // do.
  for (const CLI::App* writer :
       {commands.render, commands.compare, commands.modes, commands.display, commands.scene})
    if (writer->parsed()) std::signal(SIGPIPE, SIG_IGN);
  if (commands.selftest->parsed()) return selftest(requests.selftest);
  if (commands.bench->parsed()) exec_measurement("tessera-bench", commands.bench->remaining());
  if (commands.price->parsed()) {
    std::vector<std::string> words = commands.price->remaining();
    words.insert(words.begin(), "price");
    exec_measurement("tessera-bench", words);
  }
  if (commands.accuracy->parsed()) exec_measurement("tessera-accuracy", commands.accuracy->remaining());
  if (commands.render->parsed()) {
    RenderRequest& request = requests.render;
    if (!request.stats_name.empty())
      request.stats = request.stats_name == "json" ? StatsFormat::json : StatsFormat::text;
    return render(std::move(request));
  }
  if (commands.explain->parsed()) return explain(requests.explain);
  if (commands.compare->parsed()) return compare(requests.compare);
  if (compares_modes) {
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
  else if (commands.completion->parsed()) std::cout << completion_script(requests.shell, docs_of(program));
  else if (commands.man->parsed()) std::cout << man_page(docs_of(program), std::string(version()));
  else std::cout << program.help();
  return 0;
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
