#include <cctype>
#include <string_view>

#include "engine/program/import/number_text.h"
#include "engine/program/import/stl_formats.h"

namespace tessera::program {
namespace {

/// Compares without regard to case; `keyword` is in lower case.
bool is(std::string_view word, std::string_view keyword) {
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(word[i])) != keyword[i]) return false;
  return true;
}

bool begins_comment(std::string_view word) {
  return word.starts_with('#') || word.starts_with("//") || word.starts_with(';');
}

class TextReader {
 public:
  explicit TextReader(ModelFile& file) : file_(file) {}

  StlContent read() {
    bool is_inside = false;  // whether the word is inside a solid
    for (std::string_view word = file_.word(); !word.empty(); word = file_.word()) {
      if (is(word, "facet")) {
        is_inside = true;
        if (!read_facet()) break;
      } else if (is(word, "solid") || is(word, "endsolid")) {
        is_inside = is(word, "solid");
        file_.rest_of_line();
      } else if (!is_inside || begins_comment(word)) {
        file_.rest_of_line();
      } else {
        fail(word, "\"facet\" or \"endsolid\"");
      }
    }
    return std::move(content_);
  }

 private:
  [[noreturn]] void fail(std::string_view word, const char* expected) const {
    file_.fail_at_line("found " + quoted(word) + ", expected " + expected);
  }

  /// The next word that is not in a comment.
  std::string_view word() {
    std::string_view word = file_.word();
    for (; begins_comment(word); word = file_.word()) file_.rest_of_line();
    return word;
  }

  /// Returns false at the end of the file.
  bool read_numbers(Position& to) {
    for (double* number : {&to.x, &to.y, &to.z}) {
      const std::string_view found = word();
      if (found.empty()) return false;
      const std::optional<double> value = number_of(found);
      if (!value) fail(found, "a number");
      *number = *value;
    }
    return true;
  }

  /// Returns false, with a warning, if the end of the file cuts the facet off.
  bool read_facet() {
    Position normal{};
    corners_.clear();
    for (;;) {
      const std::string_view keyword = word();
      bool is_whole = !keyword.empty();
      if (is(keyword, "endfacet")) break;
      if (is(keyword, "normal")) is_whole = read_numbers(normal);
      else if (is(keyword, "vertex")) is_whole = read_numbers(corners_.emplace_back());
      else if (is_whole && !is(keyword, "outer") && !is(keyword, "loop") && !is(keyword, "endloop"))
        fail(keyword, "\"normal\", \"outer loop\", \"vertex\", \"endloop\" or \"endfacet\"");
      if (is_whole) continue;
      content_.warnings.push_back("ends within a facet, which is left out");
      return false;
    }
    if (corners_.size() < 3)
      file_.fail_at_line("the facet has " + std::to_string(corners_.size()) + " vertices, expected 3");
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i)
      content_.facets.add(normal, {corners_[0], corners_[i], corners_[i + 1]});
    return true;
  }

  ModelFile& file_;
  StlContent content_{.facets = StlFacets(false)};
  std::vector<Position> corners_;
};

}  // namespace

StlContent read_stl_text(ModelFile& file) { return TextReader(file).read(); }

}  // namespace tessera::program
