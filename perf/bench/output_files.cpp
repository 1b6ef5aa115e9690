#include "perf/bench/output_files.h"

#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "engine/program/imageio/atomic_file.h"
#include "engine/program/imageio/picture.h"

namespace tessera::bench {

void require_outputs(const BenchOptions& options) {
  namespace fs = std::filesystem;
  std::map<fs::path, std::string> option_of;
  const auto add = [&](const char* option, const std::string& file, const std::optional<fs::path>& target) {
    if (!target) return;
    if (const auto [other, is_new] = option_of.emplace(*target, option); !is_new)
      throw CLI::ValidationError(option, "found \"" + file + "\", which is also the file of " +
                                             other->second + ", expected another one");
  };
  for (const auto& [option, file] : {std::pair("--json", options.json_file),
                                     {"--csv", options.csv_file},
                                     {"--growth", options.growth_file},
                                     {"--trace", options.trace_file}})
    if (!file.empty()) add(option, file, file == "-" ? fs::path(file) : require_writable(file));
  if (!options.heatmap_file.empty())
    add("--heatmap", options.heatmap_file, require_writable_picture(options.heatmap_file));
  const std::string& folder = options.pictures_folder;
  if (folder.empty()) return;
  const fs::path picture = fs::path(folder) / "picture.png";
  if (fs::is_directory(folder)) require_writable(picture);
  // The folder must not be, or lie within, one of the output files.
  for (fs::path path = fs::weakly_canonical(fs::absolute(picture)).parent_path(); path.has_relative_path();
       path = path.parent_path())
    if (option_of.contains(path)) add("--pictures", folder, path);
}

}  // namespace tessera::bench
