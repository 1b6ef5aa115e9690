// The program tessera. Exit codes: 0, 1 it failed, 2 it was called wrongly, 3 a picture differs from its
// reference or the self-test found something wrong, 130 it was interrupted; then one line on stderr says why.
#include <algorithm>
#include <charconv>
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
#include "engine/program/cli/command_docs.h"
#include "engine/program/cli/info_command.h"
#include "engine/program/cli/parse_overrides.h"
#include "engine/program/cli/printable.h"
#include "engine/program/cli/render_command.h"
#include "engine/program/cli/selftest_command.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/scene/suggest.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

constexpr int kFailed = 1, kBadUsage = 2;

constexpr const char* kExamples = R"(Examples:
  tessera render                                  the built-in teapot, as tessera.png
  tessera render scene.json -o picture.png        a scene
  tessera render truck.glb --size 1280x720        a model, as truck.png
  tessera render --palette ega16 -o ega.png       16 colours, nearest entry
  tessera render --planes planes --stats          also every bitplane, and what the frame took
  tessera render scene.json --frames 50 -o 'frame_{frame}.png'     an animation
  tessera render -o term                          the picture in the terminal
  tessera render scene.json --compare right.png --threshold 2      exits with 3 where it differs)";

constexpr const char* kProgramExamples = R"(Examples:
  tessera render                                  the built-in teapot, as tessera.png
  tessera render --help                           all that it can render, and how
  tessera info                                    this machine, and what is used of it
  tessera selftest                                is what it renders right?
  tessera completion bash > /etc/bash_completion.d/tessera)";

constexpr const char* kSelftestExamples = R"(Examples:
  tessera selftest
  tessera selftest --hashes > here.txt            on one machine
  tessera selftest --expect here.txt              on another)";

using Names = std::vector<std::string_view>;

CLI::Validator one_of(const Names& names) {
  const auto check = [names](std::string& value) -> std::string {
    if (std::find(names.begin(), names.end(), value) != names.end()) return "";
    std::string list;
    for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    return "found \"" + value + "\", expected one of " + list + did_you_mean(value, names);
  };
  return {check, ""};
}

// Transforms what was typed, which CLI11 would take for octal where it begins with 0.
CLI::Validator integer_from(int min_value, int max_value) {
  const auto check = [min_value, max_value](std::string& value) -> std::string {
    int number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc() && end == value.data() + value.size() && number >= min_value &&
        number <= max_value) {
      value = std::to_string(number);
      return "";
    }
    return "found \"" + value + "\", expected an integer from " + std::to_string(min_value) + " to " +
           std::to_string(max_value);
  };
  return {check, ""};
}

// An option that is given without a name is no option that is left out.
CLI::Validator not_empty(const std::string& expected) {
  const auto check = [expected](std::string& value) -> std::string {
    return value.empty() ? "found \"\", expected " + expected : "";
  };
  return {check, ""};
}

// For CLI11 "--name=" has no value, and takes the next argument.
std::string empty_value(std::span<char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "--") break;
    if (argument.starts_with("--") && argument.ends_with('='))
      return std::string(argument.substr(0, argument.size() - 1)) + ": found \"\", expected a value";
  }
  return "";
}

CLI::App* add_render(CLI::App& program, RenderRequest& request) {
  CLI::App* command = program.add_subcommand("render",
                                             "Render a scene (.json) or a model (.obj, .gltf, .glb, .ply, "
                                             ".stl, ...); without one, the built-in teapot");
  command->footer(kExamples);
  command->option_defaults()->take_last();
  command->add_option("input", request.input, "scene or model")
      ->option_text("[SCENE.json | MODEL]")
      ->check(not_empty("a scene's or a model's name"));
  command
      ->add_option("-o,--output", request.output.path,
                   "picture to write: .png, .ppm, .pgm, .pfm, .raw or another format of OpenImageIO, {frame} "
                   "in its name is the number; - is the "
                   "standard output (PPM), term the terminal; default: the input's name with .png, here, in "
                   "place of nothing but a PNG that says that Tessera made it")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command
      ->add_option("--compression", request.output.compression,
                   "of PNG files: 0 (none) .. 9 (smallest); default: 3")
      ->option_text("N")
      ->transform(integer_from(0, 9));
  command
      ->add_option_function<std::string>(
          "--size",
          [&request](const std::string& text) {
            if (!parse_size(text, request.overrides))
              throw CLI::ValidationError("--size", "found \"" + text +
                                                       "\", expected WIDTHxHEIGHT, each 1 to " +
                                                       std::to_string(kMaxFrameBufferSize));
          },
          "size of the picture, in place of the scene's")
      ->option_text("WIDTHxHEIGHT");
  command
      ->add_option_function<std::string>(
          "--shading",
          [&request](const std::string& name) {
            request.overrides.shading = name == "flat"      ? Shading::flat
                                        : name == "gouraud" ? Shading::gouraud
                                                            : Shading::phong;
          },
          "shading of every draw")
      ->option_text("flat|gouraud|phong")
      ->check(one_of({"flat", "gouraud", "phong"}));
  command->add_option("--color-bits", request.overrides.color_bits, "colour planes: 1 .. 24")
      ->option_text("N")
      ->transform(integer_from(1, 24));
  command->add_option("--palette", request.overrides.palette, "palette; the colour buffer then holds indices")
      ->option_text("bw|gray|ega16|vga256|web216")
      ->check(one_of({"bw", "gray", "ega16", "vga256", "web216"}));
  command
      ->add_option("--planes", request.planes_folder,
                   "folder for every plane of colour, depth, stencil and accumulation as color_00.pbm, ...; "
                   "set bits are PBM's 1")
      ->option_text("DIR")
      ->check(not_empty("DIR's name"));
  command
      ->add_option_function<std::string>(
          "--camera",
          [&request](const std::string& text) {
            if (!parse_camera(text, request.overrides))
              throw CLI::ValidationError(
                  "--camera",
                  "found \"" + text +
                      "\", expected EX,EY,EZ,TX,TY,TZ[,FOVY]: the eye, what it looks at, degrees");
          },
          "camera for the whole frame, in place of the scene's or the model's")
      ->option_text("EX,EY,EZ,TX,TY,TZ[,FOVY]");
  command
      ->add_option_function<std::string>(
          "--light",
          [&request](const std::string& text) {
            if (!parse_light(text, request.overrides))
              throw CLI::ValidationError(
                  "--light",
                  "found \"" + text + "\", expected X,Y,Z[,W]: a position, or with W = 0 a direction");
          },
          "white light for the whole frame, in place of the scene's; may be given more than once")
      ->option_text("X,Y,Z[,W]")
      ->trigger_on_parse();  // for each of them
  command
      ->add_option("--frames", request.frames,
                   "pictures of an animation, t = 0 .. 1; {frame} in names is the number")
      ->option_text("N")
      ->transform(integer_from(1, 1000000));
  command->add_option("--repeat", request.repeat, "render each picture N times; --stats tells the median")
      ->option_text("N")
      ->transform(integer_from(1, 1000000));
  command
      ->add_option("--compare", request.reference,
                   "picture that the last frame should be; exits with 3 where it is not")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command->add_option("--threshold", request.threshold, "levels of 255 that --compare lets pass; default: 0")
      ->option_text("N")
      ->transform(integer_from(0, 255));
  command->add_option("--threads", request.options.threads, "threads; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  command
      ->add_option("--tile-size", request.options.tile_size,
                   "pixels of a tile's side; default: chosen by the frame")
      ->option_text("32|64|128")
      ->check(one_of({"32", "64", "128"}));
  command
      ->add_option_function<std::string>(
          "--isa",
          [&request](const std::string& name) {
            request.options.instruction_set = name == "scalar" ? InstructionSet::scalar
                                              : name == "avx2" ? InstructionSet::avx2
                                                               : InstructionSet::avx512;
          },
          "instruction set; default: the best that this machine has")
      ->option_text("scalar|avx2|avx512")
      ->check(one_of({"scalar", "avx2", "avx512"}));
  command->add_flag("--explain", request.explain,
                    "list for each draw the effects that run or are skipped, and why");
  command
      ->add_flag("--stats{text}", request.stats_name,
                 "say what the frame took: for people on stderr, or with =json as JSON on stdout")
      ->option_text("[=text|json]")
      ->check(one_of({"text", "json"}));
  command
      ->add_option_function<std::string>(
          "--progress",
          [&request](const std::string& when) {
            request.progress = when == "always"  ? ShowProgress::always
                               : when == "never" ? ShowProgress::never
                                                 : ShowProgress::automatic;
          },
          "show progress on stderr; default: auto, on a terminal after a second")
      ->option_text("auto|always|never")
      ->check(one_of({"auto", "always", "never"}));
  command
      ->add_option_function<std::string>(
          "--log",
          [&request](const std::string& level) {
            request.log = level == "debug"  ? LogLevel::debug
                          : level == "info" ? LogLevel::info
                                            : LogLevel::warning;
          },
          "print what the library says, on stderr")
      ->option_text("debug|info|warning")
      ->check(one_of({"debug", "info", "warning"}));
  return command;
}

CLI::App* add_selftest(CLI::App& program, SelftestRequest& request) {
  CLI::App* command = program.add_subcommand(
      "selftest",
      "Render scenes and exact cases in every way that this machine has, and say whether all of it is right");
  command->footer(kSelftestExamples);
  command->option_defaults()->take_last();
  command
      ->add_option("--expect", request.expected,
                   "hashes that the scenes should come to, from another machine or version; default: those "
                   "of this version")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command->add_flag("--hashes", request.hashes,
                    "print what the scenes come to here, as --expect reads it, and nothing else");
  command
      ->add_option("--threads", request.threads, "threads beside one; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  command->parse_complete_callback([&request] {
    if (request.hashes && !request.expected.empty())
      throw CLI::ValidationError("--hashes",
                                 "it prints what scenes come to and compares nothing, --expect compares");
  });
  return command;
}

// Names of the long options and of the subcommands, for suggestions.
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
         did_you_mean(word, Names{"render", "info", "selftest", "bench", "formats", "completion", "man"});
}

int usage_error(const std::string& message, const CLI::App& program) {
  const bool in_command = !program.get_subcommands().empty();
  std::cerr << "tessera: error: " << printable(message) << " (see tessera "
            << (in_command ? program.get_subcommands().front()->get_name() + " " : "") << "--help)\n";
  return kBadUsage;
}

/// Threads that no option chose are those of TESSERA_THREADS. Returns what is wrong with it; empty: nothing.
std::string threads_of_environment(int& threads) {
  const char* const value = std::getenv("TESSERA_THREADS");
  if (value == nullptr || *value == '\0' || threads != 0) return "";
  std::string text = value;
  if (std::string wrong = integer_from(1, 1024)(text); !wrong.empty()) return wrong;
  CLI::detail::lexical_cast(text, threads);  // decimal now, as options are
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
      if (entry.names.empty()) doc.operand = entry;
      else doc.options.push_back(entry);
    }
    docs.push_back(doc);
  }
  return docs;
}

int run(int argument_count, char** arguments) {
  CLI::App program{"Tessera, a multithreaded tile-based software rasterizer", "tessera"};
  program.set_version_flag("--version", std::string("tessera " TESSERA_VERSION));
  program.footer(kProgramExamples);
  program.require_subcommand(0, 1);
  RenderRequest request;
  CLI::App* render_command = add_render(program, request);
  CLI::App* info = program.add_subcommand("info", "Say what this machine is and what is used of it");
  SelftestRequest selftest_request;
  CLI::App* selftest_command = add_selftest(program, selftest_request);
  CLI::App* bench = program.add_subcommand(
      "bench", "Measure what frames cost on this machine; tessera bench --help has its options");
  bench->set_help_flag();
  bench->prefix_command();
  CLI::App* formats = program.add_subcommand("formats", "List the formats of scenes, models and pictures");
  CLI::App* completion = program.add_subcommand("completion", "Print a completion script for a shell");
  std::string shell;
  completion->add_option("shell", shell, "bash, zsh or fish")
      ->option_text("bash|zsh|fish")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  CLI::App* man = program.add_subcommand("man", "Print the manual page, for man -l -");
  info->footer("Examples:\n  tessera info");
  bench->footer(
      "Examples:\n  tessera bench fill grid-2M\n  tessera bench --json before.json\n  tessera bench "
      "--compare before.json");
  formats->footer("Examples:\n  tessera formats");
  completion->footer(
      "Examples:\n  tessera completion bash > /etc/bash_completion.d/tessera\n  tessera completion zsh > "
      "/usr/share/zsh/vendor-completions/_tessera\n"
      "  tessera completion fish > ~/.config/fish/completions/tessera.fish");
  man->footer("Examples:\n  tessera man | man -l -");
  if (const std::string wrong = empty_value({arguments, static_cast<std::size_t>(argument_count)});
      !wrong.empty())
    return usage_error(wrong, program);
  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);  // --help and --version
  } catch (const CLI::ExtrasError&) {
    return usage_error(unexpected_argument(program), program);
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), program);
  }
  if (int* const threads = render_command->parsed()     ? &request.options.threads
                           : selftest_command->parsed() ? &selftest_request.threads
                                                        : nullptr;
      threads != nullptr)
    if (const std::string wrong = threads_of_environment(*threads); !wrong.empty())
      return usage_error("TESSERA_THREADS: " + wrong, program);
  if (selftest_command->parsed()) return selftest(selftest_request);
  if (bench->parsed()) exec_bench(bench->remaining());
  if (render_command->parsed()) {
    if (!request.stats_name.empty())
      request.stats = request.stats_name == "json" ? StatsFormat::json : StatsFormat::text;
    return render(std::move(request));
  }
  if (info->parsed()) std::cout << info_text();
  else if (formats->parsed()) std::cout << formats_text();
  else if (completion->parsed()) std::cout << completion_script(shell, docs_of(program));
  else if (man->parsed()) std::cout << man_page(docs_of(program), std::string(version()));
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
    std::cerr << "tessera: interrupted; finished pictures are whole\n";
    return tessera::program::cli::kInterrupted;
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera: error: " << tessera::program::cli::printable(error.what()) << "\n";
  }
  return tessera::program::cli::kFailed;
}
