#include "engine/program/import/obj_check.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

/// Splits one line into words. Messages name its file and number.
class Line {
 public:
  Line(std::string_view text, const std::string& file, std::size_t number)
      : rest_(text), file_(file), number_(number) {}

  /// The next word; empty at the end.
  std::string_view word() {
    constexpr std::string_view kSpaces = " \t";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpaces), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpaces));
    rest_.remove_prefix(word.size());
    return word;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(file_ + ":" + std::to_string(number_) + ": " + message);
  }

  void expect_numbers(std::string_view keyword, int count) {
    for (int i = 0; i < count; ++i) {
      std::string_view text = word();
      if (text.empty() || text.front() == '#')
        fail("\"" + std::string(keyword) + "\" has " + std::to_string(i) + " numbers, expected " +
             std::to_string(count));
      const std::string found(text.substr(0, 40));
      if (text.front() == '+') text.remove_prefix(1);
      double x = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
      const bool is_number = error == std::errc{} && end == text.data() + text.size();
      if (!is_number || !(std::abs(x) <= std::numeric_limits<float>::max()))
        fail("found \"" + found + "\" after \"" + std::string(keyword) + "\", expected a finite number");
    }
  }

 private:
  std::string_view rest_;
  const std::string& file_;
  std::size_t number_;
};

/// Calls read(keyword, line) for each line.
template <class Read>
void for_each_line(std::string_view text, const std::string& file, const Read& read) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    Line line(text.substr(0, end), file, number);
    const std::string_view keyword = line.word();
    read(keyword, line);
    const bool two_characters = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (two_characters ? 2 : 1), text.size()));
  }
}

struct Counts {
  std::int64_t positions = 0;
  std::int64_t normals = 0;
};

std::int64_t index_of(std::string_view text, const Line& line) {
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size())
    line.fail("found \"" + std::string(text.substr(0, 40)) + "\", expected an index");
  return index;
}

/// Indices count from 1 forwards, or from -1 backwards.
void check_index(std::string_view text, std::int64_t count, const char* kind, const Line& line) {
  const std::int64_t index = index_of(text, line);
  if (index == 0 || index > count || index < -count)
    line.fail("index " + std::to_string(index) + " is out of bounds, there are " + std::to_string(count) +
              " " + kind + " before this line");
}

/// Indices beyond the last texture coordinate are allowed: the model then has no texture coordinates.
void check_texture_index(std::string_view text, const Line& line) {
  constexpr std::int64_t kMaxIndex = std::numeric_limits<int>::max();
  const std::int64_t index = index_of(text, line);
  if (index == 0 || index > kMaxIndex || index < -kMaxIndex)
    line.fail("texture index " + std::to_string(index) + " is out of bounds");
}

void check_face(Line& line, const Counts& counts) {
  constexpr int kMaxCorners = 1024;  // the cost of triangulation grows at least with the square
  int corners = 0;
  for (std::string_view corner = line.word(); !corner.empty() && corner.front() != '#';
       corner = line.word()) {
    const std::size_t slash = corner.find('/');
    check_index(corner.substr(0, slash), counts.positions, "vertices", line);
    if (slash != corner.npos) {
      const std::size_t second = corner.find('/', slash + 1);
      if (second != slash + 1) check_texture_index(corner.substr(slash + 1, second - slash - 1), line);
      if (second != corner.npos) check_index(corner.substr(second + 1), counts.normals, "normals", line);
    }
    ++corners;
  }
  if (corners < 3) line.fail("a face has " + std::to_string(corners) + " corners, expected at least 3");
  if (corners > kMaxCorners)
    line.fail("a face has " + std::to_string(corners) + " corners, must be at most " +
              std::to_string(kMaxCorners));
}

}  // namespace

void check_obj(std::string_view text, const std::string& file) {
  Counts counts;
  for_each_line(text, file, [&](std::string_view keyword, Line& line) {
    if (keyword == "v") {
      line.expect_numbers(keyword, 3);
      ++counts.positions;
    } else if (keyword == "vn") {
      line.expect_numbers(keyword, 3);
      ++counts.normals;
    } else if (keyword == "f") {
      check_face(line, counts);
    }
  });
}

std::map<std::string, MtlKeys, std::less<>> check_mtl(std::string_view text, const std::string& file) {
  std::map<std::string, MtlKeys, std::less<>> given;
  MtlKeys* material = nullptr;
  for_each_line(text, file, [&](std::string_view keyword, Line& line) {
    if (keyword == "newmtl") material = &given[std::string(line.word())];
    if (material != nullptr) {
      material->ambient |= keyword == "Ka";
      material->diffuse |= keyword == "Kd";
      material->illum |= keyword == "illum";
      material->texture |= keyword == "map_Kd";
      material->dissolve |= keyword == "d" || keyword == "Tr";
    }
    const bool is_color = keyword == "Ka" || keyword == "Kd" || keyword == "Ks" || keyword == "Ke";
    if (is_color) line.expect_numbers(keyword, 3);
    if (keyword == "Ns" || keyword == "d") line.expect_numbers(keyword, 1);
  });
  return given;
}

}  // namespace tessera::program
