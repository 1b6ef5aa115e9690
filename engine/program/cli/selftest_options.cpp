// Options of `tessera selftest`.
#include "engine/program/cli/command_options.h"
#include "engine/program/cli/given_options.h"
#include "engine/program/cli/validators.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kSelftestExamples = R"(Examples:
  tessera selftest
  tessera selftest --hashes > here.txt            on one machine
  tessera selftest --expect here.txt              on another)";

}  // namespace

CLI::App* add_selftest(CLI::App& program, SelftestRequest& request) {
  CLI::App* command = program.add_subcommand(
      "selftest", "Check that this machine renders scenes and exact cases correctly, in every configuration");
  command->footer(kSelftestExamples);
  command->option_defaults()->take_last();
  command
      ->add_option("--expect", request.expected,
                   "expected hashes of the scenes, from another machine or version; default: those of this "
                   "version")
      ->option_text("FILE")
      ->check(not_empty("FILE's name"));
  command->add_flag("--hashes", request.hashes,
                    "only print the hashes of the scenes on this machine, in the format of --expect");
  command
      ->add_option("--threads", request.threads,
                   "number of threads to compare with one; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  command->parse_complete_callback([command, &request] {
    if (command->remaining_size() > 0) return;  // reported as unexpected
    const GivenOptions given(*command);
    given.require({{"--expect", !request.hashes, "has no effect with --hashes, which compares nothing"},
                   {"--threads", !request.hashes, "has no effect with --hashes"}});
  });
  return command;
}

}  // namespace tessera::program::cli
