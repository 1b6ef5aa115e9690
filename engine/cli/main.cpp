// The program tessera. Exit codes: 0, 1 it failed, 2 it was called wrongly; then one line on stderr says why.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/cli/render_command.h"
#include "engine/scene/suggest.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::cli {
namespace {

constexpr int kFailed = 1, kBadUsage = 2;

constexpr const char* kExamples = R"(Examples:
  tessera render                                  the built-in teapot, as tessera.png
  tessera render scene.json -o picture.png        a scene
  tessera render bunny.obj --size 1280x720        a model, framed, as bunny.png
  tessera render --palette ega16 -o ega.png       16 colours, nearest entry
  tessera render --planes planes --stats          also every bitplane, and what the frame took)";

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

CLI::Validator integer_from(int least, int most) {
  const auto check = [least, most](std::string& value) -> std::string {
    int number = 0;
    if (CLI::detail::lexical_cast(value, number) && number >= least && number <= most) return "";
    return "found \"" + value + "\", expected an integer from " + std::to_string(least) + " to " + std::to_string(most);
  };
  return {check, ""};
}

// "640x480"
bool parse_size(const std::string& text, SceneOverrides& overrides) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return false;
  const auto parse = [](const std::string& digits, std::optional<int>& size) {
    const bool is_number = !digits.empty() && digits.size() <= 5 && digits.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) size = std::stoi(digits);
    return is_number && *size >= 1 && *size <= kMaxFrameBufferSize;
  };
  return parse(text.substr(0, cross), overrides.width) && parse(text.substr(cross + 1), overrides.height);
}

CLI::App* add_render(CLI::App& program, RenderRequest& request) {
  CLI::App* command = program.add_subcommand("render", "Render a scene (.json) or a model (.obj); without one, the built-in teapot");
  command->footer(kExamples);
  command->option_defaults()->take_last();
  command->add_option("input", request.input, "scene or model")->option_text("[SCENE.json | MODEL.obj]");
  command
      ->add_option("-o,--output", request.output,
                   "picture to write: .png, .ppm, .pgm, .raw or another format of OpenImageIO; default: the input's name with .png, here")
      ->option_text("FILE");
  command
      ->add_option_function<std::string>(
          "--size",
          [&request](const std::string& text) {
            if (!parse_size(text, request.overrides))
              throw CLI::ValidationError("--size", "found \"" + text + "\", expected WIDTHxHEIGHT, each 1 to " + std::to_string(kMaxFrameBufferSize));
          },
          "size of the picture, in place of the scene's")
      ->option_text("WIDTHxHEIGHT");
  command
      ->add_option_function<std::string>(
          "--shading",
          [&request](const std::string& name) {
            request.overrides.shading = name == "flat" ? Shading::flat : name == "gouraud" ? Shading::gouraud : Shading::phong;
          },
          "shading of every draw")
      ->option_text("flat|gouraud|phong")
      ->check(one_of({"flat", "gouraud", "phong"}));
  command->add_option("--color-bits", request.overrides.color_bits, "colour planes: 1 .. 24")->option_text("N")->check(integer_from(1, 24));
  command->add_option("--palette", request.overrides.palette, "palette; the colour buffer then holds indices")
      ->option_text("bw|gray|ega16|vga256|web216")
      ->check(one_of({"bw", "gray", "ega16", "vga256", "web216"}));
  command->add_option("--planes", request.planes_folder, "folder for every plane of colour, depth and stencil as color_00.pbm, ...; set bits are PBM's 1")
      ->option_text("DIR");
  command->add_option("--threads", request.options.threads, "threads; default: all cores")->option_text("N")->check(integer_from(1, 1024));
  command->add_option("--tile-size", request.options.tile_size, "pixels of a tile's side; default: chosen by the frame")
      ->option_text("32|64|128")
      ->check(one_of({"32", "64", "128"}));
  command
      ->add_option_function<std::string>(
          "--isa",
          [&request](const std::string& name) {
            request.options.instruction_set = name == "scalar" ? InstructionSet::scalar : name == "avx2" ? InstructionSet::avx2 : InstructionSet::avx512;
          },
          "instruction set; default: the best that this machine has")
      ->option_text("scalar|avx2|avx512")
      ->check(one_of({"scalar", "avx2", "avx512"}));
  command->add_flag("--explain", request.explain, "say for each draw what the code that runs for it contains, and why");
  command->add_flag("--stats", request.stats, "say on stderr what the frame took");
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
    const std::string typed = word.substr(2, word.find('=') == std::string::npos ? std::string::npos : word.find('=') - 2);
    const Names names = names_of(command != nullptr ? *command : program);
    const std::string_view nearest = nearest_name(typed, names);
    return message + (nearest.empty() ? "" : "; did you mean \"--" + std::string(nearest) + "\"?");
  }
  if (command != nullptr) return message;
  std::error_code error;
  if (std::filesystem::exists(word, error)) return message + "; did you mean \"tessera render " + word + "\"?";
  return "unknown command \"" + word + "\"" + did_you_mean(word, Names{"render"});
}

int usage_error(const std::string& message, const CLI::App& program) {
  const bool in_command = !program.get_subcommands().empty();
  std::cerr << "tessera: error: " << message << " (see tessera " << (in_command ? program.get_subcommands().front()->get_name() + " " : "") << "--help)\n";
  return kBadUsage;
}

int run(int argument_count, char** arguments) {
  CLI::App program{"Tessera, a multithreaded tile-based software rasterizer", "tessera"};
  program.set_version_flag("--version", std::string("tessera " TESSERA_VERSION));
  program.footer(kExamples);
  program.require_subcommand(0, 1);
  RenderRequest request;
  CLI::App* render_command = add_render(program, request);
  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);  // --help and --version
  } catch (const CLI::ExtrasError&) {
    return usage_error(unexpected_argument(program), program);
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), program);
  }
  if (!render_command->parsed()) {
    std::cout << program.help();
    return 0;
  }
  render(request);
  return 0;
}

}  // namespace
}  // namespace tessera::cli

int main(int argument_count, char** arguments) {
  try {
    return tessera::cli::run(argument_count, arguments);
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera: error: " << error.what() << "\n";
  }
  return tessera::cli::kFailed;
}
