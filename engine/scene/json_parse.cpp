// The library's parser, watched: it would let a second key of the same name win in silence.
#include <cstdio>
#include <set>

#include "engine/scene/json_value.h"

namespace tessera::json {
namespace {

// Follows the parser through the file and knows the pointer of where it is.
class Watch {
 public:
  explicit Watch(const std::string& file) : file_(file) {}

  void see(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key) {
      enter_key(parsed.get_ref<const std::string&>());
    } else if (event == Event::object_end || event == Event::array_end) {
      levels_.pop_back();
    } else {
      if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
      if (event == Event::object_start || event == Event::array_start) open(event == Event::array_start);
    }
  }

  std::string pointer() const {
    std::string text;
    for (const Level& level : levels_)
      if (level.is_array ? level.index > 0 : !level.key.empty()) text += "/" + (level.is_array ? std::to_string(level.index - 1) : level.key);
    return text.empty() ? "(top level)" : text;
  }

 private:
  struct Level {
    bool is_array = false;
    std::size_t index = 0;  // elements seen so far
    std::string key;        // the current one
    std::set<std::string> keys;
  };

  void open(bool is_array) {
    constexpr std::size_t kDeepest = 64;
    if (levels_.size() == kDeepest) throw Error(file_ + ": " + pointer() + ": nested deeper than " + std::to_string(kDeepest) + " levels");
    levels_.push_back({.is_array = is_array});
  }

  void enter_key(const std::string& key) {
    Level& object = levels_.back();
    object.key = key;
    if (!object.keys.insert(key).second) throw Error(file_ + ": " + pointer() + ": the key \"" + key + "\" occurs twice in one object");
  }

  const std::string& file_;
  std::vector<Level> levels_;
};

}  // namespace

Json parse(std::string_view text, const std::string& file) {
  Watch watch(file);
  const auto callback = [&](int, Json::parse_event_t event, Json& parsed) {
    watch.see(event, parsed);
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), callback, /*allow_exceptions=*/true, /*ignore_comments=*/true);
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while ..."
    std::string message = error.what();
    if (const std::size_t bracket = message.find("] "); bracket != std::string::npos) message.erase(0, bracket + 2);
    constexpr std::string_view kPrefix = "parse error at ";
    if (message.starts_with(kPrefix)) throw Error(file + ": " + message.substr(kPrefix.size()));
    throw Error(file + ": " + watch.pointer() + ": " + message);
  }
}

}  // namespace tessera::json
