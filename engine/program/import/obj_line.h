// Lines of OBJ and MTL files: keywords, words and numbers.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace tessera::program {

/// One line: a keyword and its arguments, of which each call reads the next. Borrows the text.
class ObjLine {
 public:
  ObjLine(std::string_view text, const std::string& file, std::size_t number);

  /// Empty for a line without one, and for a comment.
  std::string_view keyword() const { return keyword_; }
  /// The next argument; empty at the end and before a comment.
  std::string_view word();
  /// The next argument if it is a finite number; otherwise nothing is read.
  std::optional<double> find_number();
  /// @throws Error  unless the next argument is a number in the range of floats
  double number();
  /// @throws Error  as number()
  std::array<double, 3> three_numbers();
  /// All arguments that were not read: a name, which may hold spaces and '#'.
  std::string_view rest() const;
  /// @throws Error  with the file and the number of the line
  [[noreturn]] void fail(const std::string& message) const;

 private:
  double number_in(std::string_view word, int numbers_before, int expected) const;

  std::string_view rest_;
  std::string_view keyword_;
  const std::string* file_;
  std::size_t number_;
};

/// Calls read(ObjLine&, offset) for each line; the offset is that of the next line in the text, in bytes.
/// - Skips a byte order mark. Lines end with LF, CR or both.
/// - A final backslash continues a line, except in comments. The number of the line is that of its start.
template <class Read>
void for_each_obj_line(std::string_view text, const std::string& file, const Read& read);

// Implementation

/// The text before the end of the line, without its final backslash.
struct ObjLinePart {
  std::string_view text;
  bool is_continued = false;
};

/// Removes the first line of the text.
ObjLinePart take_line(std::string_view& text);

bool is_obj_comment(std::string_view line);

template <class Read>
void for_each_obj_line(std::string_view text, const std::string& file, const Read& read) {
  const std::size_t size = text.size();
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::string joined;
  for (std::size_t number = 1, lines = 1; !text.empty(); number += lines) {
    ObjLinePart part = take_line(text);
    std::string_view whole = part.text;
    lines = 1;
    if (part.is_continued && !is_obj_comment(whole)) {
      joined = whole;
      for (; part.is_continued && !text.empty(); ++lines) {
        part = take_line(text);
        joined += ' ';
        joined += part.text;
      }
      whole = joined;
    }
    ObjLine line(whole, file, number);
    if (!line.keyword().empty()) read(line, size - text.size());
  }
}

}  // namespace tessera::program
