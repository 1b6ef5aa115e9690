// Builds JSON values from the events of nlohmann's SAX parser. Its DOM parser would silently accept duplicate
// keys and search all keys of an object for each new one; with a callback it would also visit all elements of
// a list after each object in it.
#include <set>

#include "engine/program/scene/json_value.h"

namespace tessera::program::json {
namespace {

// Receives the parser's events and tracks the JSON pointer of the current value. Event handlers return true
// to continue.
class Reader {
 public:
  Reader(const std::string& file, Json& whole) : file_(file), whole_(whole) {}

  bool null() { return put(Json()); }
  bool boolean(bool value) { return put(Json(value)); }
  bool number_integer(Json::number_integer_t value) { return put(Json(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return put(Json(value)); }
  bool number_float(Json::number_float_t value, const std::string&) { return put(Json(value)); }
  bool string(std::string& value) { return put(Json(std::move(value))); }
  bool binary(Json::binary_t&) { return true; }  // does not occur in JSON text
  bool start_object(std::size_t) { return open(false); }
  bool start_array(std::size_t) { return open(true); }
  bool key(std::string& name) {
    Level& object = levels_.back();
    object.key = name;
    if (!object.keys.insert(name).second)
      throw Error(file_ + ": " + pointer() + ": the key \"" + name + "\" occurs twice in one object");
    return true;
  }
  bool end_object() {
    Json object(Json::value_t::object);
    auto& members = object.get_ref<Json::object_t&>();
    // ordered_json has constant keys, so growing would copy all members instead of moving them.
    members.reserve(levels_.back().members.size());
    for (Member& member : levels_.back().members)
      members.emplace_back(std::move(member.key), std::move(member.value));
    return close(std::move(object));
  }
  bool end_array() {
    Json array(Json::value_t::array);
    array.get_ref<Json::array_t&>() = std::move(levels_.back().elements);
    return close(std::move(array));
  }
  template <class Exception>
  bool parse_error(std::size_t, const std::string&, const Exception& error) {
    throw error;
  }

  /// Returns the JSON pointer of the value that is being read.
  std::string pointer() const {
    std::string text;
    for (const Level& level : levels_)
      if (level.is_array || !level.key.empty())
        text += "/" + (level.is_array ? std::to_string(level.elements.size()) : level.key);
    return text.empty() ? "(top level)" : text;
  }

 private:
  struct Member {
    std::string key;
    Json value;
  };
  struct Level {
    bool is_array = false;
    std::string key;  // the current one
    std::set<std::string> keys;
    Json::array_t elements;
    std::vector<Member> members;
  };

  bool open(bool is_array) {
    constexpr std::size_t kMaxDepth = 64;
    if (levels_.size() == kMaxDepth)
      throw Error(file_ + ": " + pointer() + ": nested deeper than " + std::to_string(kMaxDepth) + " levels");
    levels_.emplace_back();
    levels_.back().is_array = is_array;
    return true;
  }

  bool close(Json value) {
    levels_.pop_back();
    return put(std::move(value));
  }

  bool put(Json value) {
    if (levels_.empty()) whole_ = std::move(value);
    else if (levels_.back().is_array) levels_.back().elements.push_back(std::move(value));
    else levels_.back().members.push_back(Member{levels_.back().key, std::move(value)});
    return true;
  }

  const std::string& file_;
  Json& whole_;
  std::vector<Level> levels_;
};

}  // namespace

Json parse(std::string_view text, const std::string& file) {
  Json whole;
  Reader reader(file, whole);
  try {
    Json::sax_parse(text.begin(), text.end(), &reader, Json::input_format_t::json, /*strict=*/true,
                    /*ignore_comments=*/true);
    return whole;
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while ..."
    std::string message = error.what();
    if (const std::size_t bracket = message.find("] "); bracket != std::string::npos)
      message.erase(0, bracket + 2);
    constexpr std::string_view kPrefix = "parse error at ";
    if (message.starts_with(kPrefix)) throw Error(file + ": " + message.substr(kPrefix.size()));
    throw Error(file + ": " + reader.pointer() + ": " + message);
  }
}

}  // namespace tessera::program::json
