// Reads a model file in order, as bytes or as words, through a buffer of fixed size.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/import/byte_stream.h"

namespace tessera::program {

class ModelFile {
 public:
  static constexpr std::size_t kMaxTake = std::size_t{1} << 16;  ///< bytes of a word or of take()

  /// @param progress  receives the share of the file that is read
  /// @throws Error if the file cannot be read
  explicit ModelFile(const std::string& path, ReportProgress progress = {});
  /// A file in memory.
  /// @param bytes  must outlive this object
  ModelFile(std::string name, std::string_view bytes);

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Offset of the next byte.
  std::uint64_t offset() const { return loaded_ - static_cast<std::uint64_t>(end_ - at_); }
  std::uint64_t remaining() const { return size_ - std::min(offset(), size_); }

  /// Returns the next bytes without passing them: `count`, or as many as there are.
  std::string_view peek(std::size_t count);
  /// Returns the next `count` bytes, valid until the next call of a function of this object; null if fewer
  /// are left.
  const char* take(std::size_t count) {
    if (static_cast<std::size_t>(end_ - at_) < count && !load(count)) return nullptr;
    const char* const taken = at_;
    at_ += count;
    return taken;
  }
  /// Passes `count` bytes. Returns false if fewer are left.
  bool skip(std::uint64_t count);

  /// Returns the next word: what spaces and ends of lines separate. Empty at the end of the file. Valid until
  /// the next call of a function of this object. Lines end with LF, CR LF or CR.
  std::string_view word();
  /// Returns the rest of the line, at most kMaxTake bytes without spaces around them, and passes its end. If
  /// an earlier line ended with CR alone, a LF belongs to what follows, which may be binary.
  std::string_view rest_of_line();
  /// Number of the line where the last word or rest of a line began, from 1.
  std::uint64_t line() const { return line_; }

  /// @throws Error "<path>:<line>: <what>"
  [[noreturn]] void fail_at_line(const std::string& what) const;
  /// @throws Error "<path>: byte <offset>: <what>"
  [[noreturn]] void fail_at_byte(const std::string& what) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  /// Makes at least `count` bytes available. Returns false if the file has fewer.
  bool load(std::size_t count);
  void pass_line_end(char end);

  std::string path_;
  ReportProgress progress_;
  std::unique_ptr<std::FILE, Close> file_;  // null: in memory
  std::vector<char> buffer_;
  const char* at_ = nullptr;  // the next byte
  const char* end_ = nullptr;
  std::uint64_t loaded_ = 0;     // bytes up to end_
  std::uint64_t size_ = 0;       // bytes of the file
  std::uint64_t line_ = 1;       // line of the last word
  std::uint64_t next_line_ = 1;  // line of at_
  bool after_cr_ = false;        // word() ended at a CR: a LF belongs to the same end of line
  bool lines_end_with_cr_ = false;
};

}  // namespace tessera::program
