#include "perf/prices/price_file.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/threads/processor_name.h"

namespace tessera::bench {
namespace {

namespace fs = std::filesystem;

/// Letters and digits of a text; everything else becomes single hyphens.
std::string file_word(const std::string& text) {
  std::string word;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.') word += c;
    else if (!word.empty() && word.back() != '-') word += '-';
  }
  while (!word.empty() && word.back() == '-') word.pop_back();
  return word;
}

fs::path cache_folder() {
  const auto folder_in = [](const char* variable) {
    const char* const value = std::getenv(variable);
    const fs::path path = value != nullptr ? value : "";
    return path.is_absolute() ? path : fs::path();  // relative paths are ignored
  };
  if (const fs::path cache = folder_in("XDG_CACHE_HOME"); !cache.empty()) return cache / "tessera";
  if (const fs::path home = folder_in("HOME"); !home.empty()) return home / ".cache" / "tessera";
  return {};
}

/// A finite number of the list.
double number_of(const nlohmann::json& price, const char* key) {
  const double number = price.at(key).get<double>();
  if (!std::isfinite(number)) throw Error(std::string(key) + ": expected a finite number");
  return number;
}

PriceItem item_of(const std::string& name) {
  for (std::size_t i = 0; i < kPriceItems; ++i)
    if (code(static_cast<PriceItem>(i)) == name) return static_cast<PriceItem>(i);
  throw Error("found \"" + name + "\", expected the name of a price");
}

}  // namespace

bool is_measured(const Price& price) { return price.nanoseconds != 0 || price.low != 0 || price.high != 0; }

PriceList empty_price_list(InstructionSet instruction_set) {
  PriceList list;
  list.processor = program::processor_name();
  list.instruction_set = name(instruction_set);
  list.version = version();
  return list;
}

std::string price_json(const PriceList& list) {
  nlohmann::ordered_json json{{"processor", list.processor},
                              {"instruction_set", list.instruction_set},
                              {"version", list.version},
                              {"prices", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < kPriceItems; ++i) {
    const auto item = static_cast<PriceItem>(i);
    const Price& price = list[item];
    if (!is_measured(price)) continue;
    json["prices"].push_back({{"item", code(item)},
                              {"unit", name(unit(item))},
                              {"nanoseconds", price.nanoseconds},
                              {"low", price.low},
                              {"high", price.high}});
  }
  return json.dump(2) + "\n";
}

PriceList parse_prices(const std::string& text, const std::string& source) {
  PriceList list;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    list.processor = json.at("processor").get<std::string>();
    list.instruction_set = json.at("instruction_set").get<std::string>();
    list.version = json.at("version").get<std::string>();
    for (const nlohmann::json& price : json.at("prices"))
      list[item_of(price.at("item").get<std::string>())] = {
          number_of(price, "nanoseconds"), number_of(price, "low"), number_of(price, "high")};
  } catch (const std::exception& error) {
    throw Error(source + ": is no price list: " + error.what() + "; \"tessera price\" writes it again");
  }
  return list;
}

fs::path cached_price_file(const PriceList& list) {
  const fs::path folder = cache_folder();
  if (folder.empty()) return {};
  return folder / ("prices-" + file_word(list.processor) + "-" + file_word(list.instruction_set) + "-" +
                   file_word(list.version) + ".json");
}

std::optional<PriceList> cached_prices(InstructionSet instruction_set) {
  const fs::path file = cached_price_file(empty_price_list(instruction_set));
  if (file.empty()) return {};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_prices(text, file.string());
}

fs::path cache_prices(const PriceList& list) {
  const fs::path file = cached_price_file(list);
  if (file.empty()) return {};
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    throw Error("cannot create the folder \"" + file.parent_path().string() + "\": " + error.message());
  program::write_file_atomically(file.string(), price_json(list));
  return file;
}

}  // namespace tessera::bench
