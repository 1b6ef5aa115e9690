#include "engine/program/cli/validators.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

#include "engine/program/scene/suggest.h"

namespace tessera::program::cli {

CLI::Validator one_of(const Names& names) {
  const auto check = [names](std::string& value) -> std::string {
    if (std::find(names.begin(), names.end(), value) != names.end()) return "";
    std::string list;
    for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    return "found \"" + value + "\", expected one of " + list + did_you_mean(value, names);
  };
  return {check, ""};
}

CLI::Validator integer_from(int min_value, int max_value) {
  const auto check = [min_value, max_value](std::string& value) -> std::string {
    int number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool is_number = error == std::errc() && end == value.data() + value.size();
    if (is_number && number >= min_value && number <= max_value) {
      value = std::to_string(number);
      return "";
    }
    return "found \"" + value + "\", expected an integer from " + std::to_string(min_value) + " to " +
           std::to_string(max_value);
  };
  return {check, ""};
}

CLI::Validator number_from(double min_value, double max_value) {
  const auto check = [min_value, max_value](std::string& value) -> std::string {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool is_number = error == std::errc() && end == value.data() + value.size();
    if (is_number && number >= min_value && number <= max_value) return "";
    std::ostringstream message;
    message << "found \"" << value << "\", expected a number from " << min_value << " to " << max_value;
    return message.str();
  };
  return {check, ""};
}

CLI::Validator positive_number() {
  const auto check = [](std::string& value) -> std::string {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool is_number = error == std::errc() && end == value.data() + value.size();
    if (is_number && std::isfinite(number) && number > 0) return "";
    return "found \"" + value + "\", expected a number above 0";
  };
  return {check, ""};
}

CLI::Validator not_empty(const std::string& expected) {
  const auto check = [expected](std::string& value) -> std::string {
    return value.empty() ? "found \"\", expected " + expected : "";
  };
  return {check, ""};
}

}  // namespace tessera::program::cli
