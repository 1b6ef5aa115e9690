#include "engine/program/cli/command_docs.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace tessera::program::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::vector<OptionDoc>& options) {
  Json list = Json::array();
  for (const OptionDoc& option : options)
    list.push_back({{"names", option.names}, {"value", option.value}, {"text", option.text}});
  return list;
}

std::vector<OptionDoc> options_of(const Json& list) {
  std::vector<OptionDoc> options;
  for (const Json& json : list)
    options.push_back({.names = json.at("names"), .value = json.at("value"), .text = json.at("text")});
  return options;
}

}  // namespace

CommandDoc doc_of(const CLI::App& command) {
  CommandDoc doc{.name = command.get_name(),
                 .text = command.get_description(),
                 .examples = command.get_footer(),
                 .options = {},
                 .operands = {}};
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    OptionDoc entry{.names = {}, .value = option->get_option_text(), .text = option->get_description()};
    for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
    (entry.names.empty() ? doc.operands : doc.options).push_back(entry);
  }
  return doc;
}

std::vector<CommandDoc> docs_of_commands(const CLI::App& program) {
  std::vector<CommandDoc> docs;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    docs.push_back(doc_of(*command));
  return docs;
}

std::string doc_json(const CommandDoc& doc) {
  return Json{{"name", doc.name},
              {"text", doc.text},
              {"examples", doc.examples},
              {"options", json_of(doc.options)},
              {"operands", json_of(doc.operands)}}
      .dump();
}

CommandDoc parse_doc(const std::string& json) {
  const Json doc = Json::parse(json);
  return {.name = doc.at("name"),
          .text = doc.at("text"),
          .examples = doc.at("examples"),
          .options = options_of(doc.at("options")),
          .operands = options_of(doc.at("operands"))};
}

bool has_optional_value(const OptionDoc& option) { return option.value.starts_with("[="); }

std::string plain_value(const OptionDoc& option) {
  return has_optional_value(option) ? option.value.substr(2, option.value.size() - 3) : option.value;
}

std::string option_heading(const OptionDoc& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + name;
  const bool needs_space = !text.empty() && !option.value.empty() && !has_optional_value(option);
  return text + (needs_space ? " " : "") + option.value;
}

}  // namespace tessera::program::cli
