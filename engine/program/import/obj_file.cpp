#include "engine/program/import/obj_file.h"

#include <charconv>
#include <limits>
#include <map>
#include <utility>

#include "engine/program/import/obj_line.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

constexpr std::uint32_t kMaxFaceCorners = 1024;  // the cost of triangulation grows with the square

std::int64_t index_of(std::string_view text, const ObjLine& line) {
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size())
    line.fail("found \"" + std::string(text.substr(0, 40)) + "\", expected an index");
  return index;
}

/// Turns an index that counts from 1 forwards, or from -1 backwards, into one that counts from 0.
/// @param count  number of elements before this line
std::size_t resolved(std::int64_t index, std::size_t count, const char* kind, const ObjLine& line) {
  const auto signed_count = static_cast<std::int64_t>(count);
  if (index == 0 || index > signed_count || index < -signed_count)
    line.fail("index " + std::to_string(index) + " is out of bounds, there are " + std::to_string(count) +
              " " + kind + " before this line");
  return static_cast<std::size_t>(index > 0 ? index - 1 : signed_count + index);
}

class ObjParser {
 public:
  ObjFile file;

  void read(ObjLine& line) {
    const std::string_view keyword = line.keyword();
    if (keyword == "v") {
      read_position(line);
    } else if (keyword == "vt") {
      for (int k = 0; k < 2; ++k)
        file.texcoords.push_back(static_cast<float>(line.find_number().value_or(0)));
    } else if (keyword == "vn") {
      for (const double x : line.three_numbers()) file.normals.push_back(static_cast<float>(x));
    } else if (keyword == "f") {
      read_element(Primitive::polygon, "a face", 3, kMaxFaceCorners, line);
    } else if (keyword == "l") {
      read_element(Primitive::line_strip, "a line", 2, std::numeric_limits<std::uint32_t>::max(), line);
    } else if (keyword == "p") {
      read_element(Primitive::points, "a point", 1, std::numeric_limits<std::uint32_t>::max(), line);
    } else if (keyword == "s") {
      read_smoothing_group(line);
    } else if (keyword == "usemtl") {
      read_material_name(line);
    } else if (keyword == "mtllib" && !line.rest().empty()) {
      file.material_files.emplace_back(line.rest());
    }
  }

 private:
  void read_position(ObjLine& line) {
    const std::array<double, 3> position = line.three_numbers();
    std::array<double, 3> color{1, 1, 1};
    bool has_color = true;
    for (double& x : color) {
      const std::optional<double> component = line.find_number();
      has_color &= component.has_value();
      x = component.value_or(1);
    }
    if (has_color && file.has_color.empty()) {
      file.colors.assign(3 * file.positions.size(), 1);
      file.has_color.assign(file.positions.size(), false);
    }
    if (has_color || !file.has_color.empty()) {
      for (const double x : color) file.colors.push_back(has_color ? static_cast<float>(x) : 1);
      file.has_color.push_back(has_color);
    }
    file.positions.push_back(position);
  }

  void read_element(Primitive primitive, const char* what, std::uint32_t min, std::uint32_t max,
                    ObjLine& line) {
    std::uint32_t corners = 0;
    for (std::string_view word = line.word(); !word.empty(); word = line.word()) {
      file.corners.push_back(corner(word, line));
      ++corners;
    }
    if (corners < min)
      line.fail(std::string(what) + " has " + std::to_string(corners) + " corners, expected at least " +
                std::to_string(min));
    if (corners > max)
      line.fail(std::string(what) + " has " + std::to_string(corners) + " corners, must be at most " +
                std::to_string(max));
    file.elements.push_back({primitive, corners, material_, smoothing_group_});
  }

  /// "position", "position/texcoord" or "position/texcoord/normal"; the last two may be empty.
  ObjCorner corner(std::string_view word, const ObjLine& line) const {
    const std::size_t slash = word.find('/');
    ObjCorner corner;
    corner.position = static_cast<std::uint32_t>(
        resolved(index_of(word.substr(0, slash), line), file.positions.size(), "vertices", line));
    if (slash == word.npos) return corner;
    word.remove_prefix(slash + 1);
    const std::size_t second = word.find('/');
    corner.texcoord = texcoord_index(word.substr(0, second), line);
    if (second != word.npos) corner.normal = normal_index(word.substr(second + 1), line);
    return corner;
  }

  std::int32_t texcoord_index(std::string_view text, const ObjLine& line) const {
    constexpr std::int64_t kMaxIndex = std::numeric_limits<std::int32_t>::max();
    const std::int64_t index = text.empty() ? 0 : index_of(text, line);
    if (index > kMaxIndex || index < -kMaxIndex)
      line.fail("texture index " + std::to_string(index) + " is out of bounds");
    const auto count = static_cast<std::int64_t>(file.texcoords.size() / 2);
    if (index == 0 || index < -count) return kNoObjIndex;
    // Coordinates of a later line are found at the end.
    return static_cast<std::int32_t>(index > 0 ? index - 1 : count + index);
  }

  std::int32_t normal_index(std::string_view text, const ObjLine& line) const {
    const std::int64_t index = text.empty() ? 0 : index_of(text, line);
    if (index == 0) return kNoObjIndex;
    return static_cast<std::int32_t>(resolved(index, file.normals.size() / 3, "normals", line));
  }

  /// A number, or "off"; anything else counts as off.
  void read_smoothing_group(ObjLine& line) {
    const std::string_view word = line.word();
    if (word.empty()) return;
    file.has_smoothing_groups = true;
    smoothing_group_ = word == "on" ? 1 : 0;
    std::from_chars(word.data(), word.data() + word.size(), smoothing_group_);
  }

  void read_material_name(const ObjLine& line) {
    const std::string name(line.rest());
    material_ = kNoObjIndex;
    if (name.empty()) return;
    const auto [entry, is_new] =
        material_numbers_.try_emplace(name, static_cast<std::int32_t>(file.material_names.size()));
    if (is_new) file.material_names.push_back(name);
    material_ = entry->second;
  }

  std::map<std::string, std::int32_t, std::less<>> material_numbers_;
  std::int32_t material_ = kNoObjIndex;
  std::uint32_t smoothing_group_ = 0;
};

/// Drops indices beyond the last texture coordinate.
void drop_missing_texcoords(ObjFile& file) {
  const auto count = static_cast<std::int32_t>(file.texcoords.size() / 2);
  for (ObjCorner& corner : file.corners)
    if (corner.texcoord >= count) corner.texcoord = kNoObjIndex;
}

}  // namespace

ObjFile parse_obj(std::string_view text, const std::string& file, const ReportProgress& progress) {
  constexpr std::size_t kReportInterval = 1 << 16;
  ObjParser parser;
  std::size_t lines = 0;
  for_each_obj_line(text, file, [&](ObjLine& line, std::size_t offset) {
    parser.read(line);
    if (progress && ++lines % kReportInterval == 0)
      progress(static_cast<double>(offset) / static_cast<double>(text.size()));
  });
  drop_missing_texcoords(parser.file);
  return std::move(parser.file);
}

}  // namespace tessera::program
