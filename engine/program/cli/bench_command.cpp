#include "engine/program/cli/bench_command.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>

#include <unistd.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program::cli {
namespace {

namespace fs = std::filesystem;

struct Measurement {
  const char* command;
  const char* program;
  const char* word;  ///< first argument of the program; empty: none
};
constexpr Measurement kMeasurements[] = {{"bench", "tessera-bench", ""},
                                         {"price", "tessera-bench", "price"},
                                         {"accuracy", "tessera-accuracy", ""}};

const Measurement* find_measurement(const std::string& command) {
  for (const Measurement& measurement : kMeasurements)
    if (command == measurement.command) return &measurement;
  return nullptr;
}

/// Paths at which a program may be: next to this one, or in ../libexec/tessera.
std::vector<fs::path> places_of(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) throw Error("cannot read /proc/self/exe, which locates " + name + ": " + error.message());
  return {folder / name, folder.parent_path() / "libexec" / "tessera" / name};
}

/// The output of a shell command.
std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string text;
  char block[4096];
  while (const std::size_t count = pipe ? std::fread(block, 1, sizeof block, pipe.get()) : 0)
    text.append(block, count);
  return text;
}

}  // namespace

void exec_measurement(const std::string& command, const std::vector<std::string>& arguments) {
  const Measurement& measurement = *find_measurement(command);
  const std::string name = measurement.program;
  std::vector<std::string> words{name};
  if (*measurement.word != '\0') words.emplace_back(measurement.word);
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  for (const fs::path& program : places_of(name)) {
    ::execv(program.c_str(), pointers.data());
    if (errno != ENOENT) throw Error("cannot start \"" + program.string() + "\": " + std::strerror(errno));
  }
  throw Error("found no " + name +
              " next to this program or in ../libexec/tessera; it is built with the program and part of the "
              "package tessera");
}

std::optional<CommandDoc> measurement_doc(const std::string& command) {
  const Measurement* const measurement = find_measurement(command);
  if (measurement == nullptr) return std::nullopt;
  for (const fs::path& program : places_of(measurement->program)) {
    const bool is_quotable = program.string().find('\'') == std::string::npos;
    if (!is_quotable || ::access(program.c_str(), X_OK) != 0) continue;
    try {
      CommandDoc doc =
          parse_doc(output_of("'" + program.string() + "' " + measurement->word + " --describe 2>/dev/null"));
      doc.name = command;
      return doc;
    } catch (const std::exception&) {
      return std::nullopt;  // a program of another version
    }
  }
  return std::nullopt;
}

}  // namespace tessera::program::cli
