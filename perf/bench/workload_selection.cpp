#include "perf/bench/workload_selection.h"

#include <algorithm>
#include <map>

#include <CLI/CLI.hpp>

namespace tessera::bench {
namespace {

/// Whether `name` selects the workload: by its full name or, if no workload has that name, by a prefix.
bool matches(const std::string& name, const WorkloadEntry& entry) {
  if (entry.name == name) return true;
  const bool is_full_name = find_workload(name) != nullptr;
  return !is_full_name && !name.empty() && entry.name.starts_with(name);
}
std::vector<const WorkloadEntry*> select_workloads(const std::vector<std::string>& names) {
  std::vector<const WorkloadEntry*> list;
  for (const std::string& name : names)
    if (std::none_of(workloads().begin(), workloads().end(),
                     [&](const WorkloadEntry& entry) { return matches(name, entry); }))
      throw CLI::ValidationError(
          "workloads", "found \"" + name + "\", expected the name of a workload or a prefix; see --list");
  for (const WorkloadEntry& entry : workloads())
    if (names.empty() || std::any_of(names.begin(), names.end(),
                                     [&](const std::string& name) { return matches(name, entry); }))
      list.push_back(&entry);
  return list;
}

}  // namespace

Selection prepare_workloads(const std::vector<std::string>& names) {
  Selection selection;
  std::map<std::string, std::string> fault_of_name;  // empty: one of its workloads can run
  for (const WorkloadEntry* entry : select_workloads(names)) {
    const std::string reason = entry->prepare ? entry->prepare() : "";
    const bool runs = reason.empty();
    if (runs) selection.entries.push_back(entry);
    else selection.skipped += entry->name + ": skipped, " + reason + "\n";
    for (const std::string& name : names)
      if (matches(name, *entry) && (runs || !fault_of_name.contains(name))) fault_of_name[name] = reason;
  }
  for (const auto& [name, reason] : fault_of_name)
    if (!reason.empty()) throw Error("no workload of \"" + name + "\" can run: " + reason);
  return selection;
}

}  // namespace tessera::bench
