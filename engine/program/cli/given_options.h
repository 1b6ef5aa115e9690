// Options that have no effect are wrong usage: the conditions of options, and their check.
#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>

#include "engine/program/cli/usage_error.h"

namespace CLI {
class App;
}

namespace tessera::program::cli {

/// A condition without which an option has no effect.
struct OptionNeed {
  std::string_view option;  ///< "--threshold"
  bool is_met = false;
  std::string_view needed;  ///< continues the option's name: "needs --compare, the reference"
};

/// Names of the options and operands that a command line gives.
class GivenOptions {
 public:
  GivenOptions() = default;
  /// @param command  parsed
  explicit GivenOptions(const CLI::App& command);

  /// @param option  "--size", or the name of an operand
  bool has(std::string_view option) const { return names_.contains(option); }
  /// @throws UsageError for the first given option whose condition is not met
  void require(std::initializer_list<OptionNeed> needs) const;
  /// Refuses all given options but `allowed`.
  /// @param reason  continues the option's name: "has no effect with --list"
  /// @throws UsageError
  void allow_only(std::initializer_list<std::string_view> allowed, std::string_view reason) const;

 private:
  std::set<std::string, std::less<>> names_;
};

}  // namespace tessera::program::cli
