#include "perf/prices/price_main.h"

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include <CLI/CLI.hpp>

#include "engine/program/cli/command_line.h"
#include "engine/program/cli/given_options.h"
#include "engine/program/cli/scene_input.h"
#include "engine/program/cli/standard_output.h"
#include "engine/program/cli/validators.h"
#include "engine/program/imageio/atomic_file.h"
#include "perf/prices/measure_prices.h"
#include "perf/prices/price_check.h"
#include "perf/prices/price_file.h"
#include "perf/prices/price_table.h"

namespace tessera::bench {
namespace {

using program::cli::write_to_stdout;

constexpr const char* kExamples = R"(Examples:
  tessera price                                   all prices; about two minutes
  tessera price pixel vertex_spot                 some of them
  tessera price --json prices.json                as JSON
  tessera price --check scene.json model.obj      predicted and measured times of scenes)";

struct PriceOptions {
  std::vector<std::string> names{};
  bool list = false;
  std::string json_file{};
  std::string instruction_set{};
  double seconds = 1;
  std::vector<std::string> checked{};  ///< scenes and models
};

constexpr int kCheckedWidth = 1280, kCheckedHeight = 960;

/// Refuses options without effect.
void check_use(const CLI::App& program, const PriceOptions& options) {
  if (program.remaining_size() > 0) return;  // reported as unexpected
  const program::cli::GivenOptions given(program);
  if (options.list) return given.allow_only({"--list"}, "has no effect with --list");
  const bool measures = options.checked.empty();
  given.require({{"names", measures, "has no effect with --check, which measures what is missing"},
                 {"--json", measures, "has no effect with --check, which writes no list"}});
}

void add_options(CLI::App& program, PriceOptions& options) {
  program.add_option("names", options.names, "codes of prices, or prefixes of them; default: all")
      ->option_text("[PRICE...]");
  program.add_flag("--list", options.list, "list all prices and what they count");
  program
      .add_option("--json", options.json_file,
                  "write the list as JSON; - is the standard output; default: none is written")
      ->option_text("FILE")
      ->check(program::cli::not_empty("FILE's name"));
  program.add_option("--isa", options.instruction_set, "instruction set; default: the best of this machine")
      ->option_text("scalar|avx2|avx512");
  program.add_option("--seconds", options.seconds, "seconds per price, 0.001 to 3600; default: 1")
      ->option_text("S")
      ->check(program::cli::number_from(0.001, 3600));
  program
      .add_option("--check", options.checked,
                  "compare predicted with measured times of scenes and models at 1280x960, one thread; "
                  "measures missing prices first; default: nothing is checked")
      ->option_text("FILE...")
      ->check(program::cli::not_empty("a scene's or a model's name"));
  program.parse_complete_callback([&program, &options] { check_use(program, options); });
}

InstructionSet instruction_set_of(const PriceOptions& options) {
  const std::vector<InstructionSet> sets = available_instruction_sets();
  if (options.instruction_set.empty()) return sets.front();
  std::string known;
  for (const InstructionSet set : sets) {
    if (name(set) == options.instruction_set) return set;
    known.append(known.empty() ? "" : ", ").append(name(set));
  }
  throw CLI::ValidationError("--isa", "found \"" + options.instruction_set + "\", expected one of " + known);
}

void list_prices() {
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    const auto item = static_cast<PriceItem>(i);
    std::cout << code(item) << std::string(34 - code(item).size(), ' ') << name(unit(item)) << "\n";
  }
}

/// A line on the terminal that counts up.
void show_progress(std::size_t measured, std::size_t pairs) {
  if (::isatty(STDERR_FILENO) == 0) return;
  std::cerr << "\rmeasured " << measured << " of " << pairs << (measured == pairs ? "\r\033[K" : "")
            << std::flush;
}

/// Measures prices in addition to those of `list`, shows them, and keeps the list in the cache.
PriceList measured_list(PriceList list, const std::vector<PriceItem>& items, const PriceOptions& options,
                        InstructionSet set, bool is_silent) {
  const std::vector<PriceItem> measured = measure_prices(list, items, set, options.seconds, show_progress);
  const std::filesystem::path cached = cache_prices(list);
  if (is_silent) return list;
  std::string text = price_table_heading(list);
  for (const PriceItem item : measured) text += price_line(list, item);
  if (!cached.empty()) text += "\nkept in " + cached.string() + "\n";
  write_to_stdout(text);
  return list;
}

void check_scenes(const PriceOptions& options, InstructionSet set) {
  // Files that cannot be read are found before anything is measured.
  std::vector<NamedScene> inputs;
  for (const std::string& file : options.checked) {
    const program::cli::SceneInput input(file, {.width = kCheckedWidth, .height = kCheckedHeight});
    inputs.push_back({std::filesystem::path(file).filename().string(), input.scene()});
  }
  PriceList list = cached_prices(set).value_or(empty_price_list(set));
  std::vector<PriceItem> missing = select_prices({});
  std::erase_if(missing, [&](PriceItem item) { return is_measured(list[item]); });
  if (!missing.empty()) list = measured_list(list, missing, options, set, false);
  const std::vector<CheckedScene> scenes = check_prices(inputs, list, set);
  std::string text = checked_heading();
  for (const CheckedScene& scene : scenes) text += checked_line(scene);
  write_to_stdout(text);
  if (scenes.size() == 1) write_to_stdout(predicted_items(scenes.front(), list));
  else write_to_stdout(checked_summary(scenes));
}

int run(const PriceOptions& options) {
  if (options.list) {
    list_prices();
    return 0;
  }
  const InstructionSet set = instruction_set_of(options);
  if (!options.checked.empty()) {
    check_scenes(options, set);
    return 0;
  }
  const bool is_silent = options.json_file == "-";
  if (!options.json_file.empty() && !is_silent) program::require_writable(options.json_file);
  const std::vector<PriceItem> items = select_prices(options.names);
  const PriceList known =
      options.names.empty() ? empty_price_list(set) : cached_prices(set).value_or(empty_price_list(set));
  const PriceList list = measured_list(known, items, options, set, is_silent);
  if (is_silent) write_to_stdout(price_json(list));
  else if (!options.json_file.empty()) program::write_file_atomically(options.json_file, price_json(list));
  return 0;
}

}  // namespace

int price_main(int argc, char** argv) {
  namespace cli = program::cli;
  CLI::App program("Measures what effects cost on this machine, in nanoseconds of one thread",
                   "tessera price");
  cli::set_help(program);
  program.footer(kExamples);
  PriceOptions options;
  try {
    add_options(program, options);
    const std::optional<int> done = cli::parse_arguments(program, argc, argv);
    const int code = done ? *done : run(options);
    cli::require_stdout_written();
    return code;
  } catch (const cli::UsageError& error) {
    return cli::report_usage("tessera price", error.what(), "tessera price");
  } catch (const CLI::ParseError& error) {
    return cli::report_usage("tessera price", error.what(), "tessera price");
  } catch (const std::bad_alloc&) {
    std::cerr << "tessera price: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "tessera price: error: " << error.what() << "\n";
  }
  return cli::kFailed;
}

}  // namespace tessera::bench
