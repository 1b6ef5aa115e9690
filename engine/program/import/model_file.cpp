#include "engine/program/import/model_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/stat.h>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

bool ends_line(char c) { return c == '\n' || c == '\r'; }
bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

ModelFile::ModelFile(const std::string& path, ReportProgress progress)
    : path_(path), progress_(std::move(progress)), file_(std::fopen(path.c_str(), "rb")) {
  struct stat status {};
  if (!file_ || ::fstat(::fileno(file_.get()), &status) != 0)
    throw Error("cannot read \"" + path + "\": " + std::strerror(errno));
  size_ = static_cast<std::uint64_t>(status.st_size);
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  buffer_.resize(kBufferBytes);
  at_ = end_ = buffer_.data();
}

ModelFile::ModelFile(std::string name, std::string_view bytes)
    : path_(std::move(name)),
      at_(bytes.data()),
      end_(bytes.data() + bytes.size()),
      loaded_(bytes.size()),
      size_(bytes.size()) {}

bool ModelFile::load(std::size_t count) {
  if (!file_) return static_cast<std::size_t>(end_ - at_) >= count;
  const auto kept = static_cast<std::size_t>(end_ - at_);
  std::memmove(buffer_.data(), at_, kept);
  std::size_t available = kept;
  while (available < std::max(count, kept + 1)) {
    const std::size_t read = std::fread(&buffer_[available], 1, buffer_.size() - available, file_.get());
    if (read == 0) break;
    available += read;
  }
  at_ = buffer_.data();
  end_ = at_ + available;
  loaded_ += available - kept;
  if (progress_ && size_ > 0) progress_(static_cast<double>(loaded_) / static_cast<double>(size_));
  return available >= count;
}

std::string_view ModelFile::peek(std::size_t count) {
  if (static_cast<std::size_t>(end_ - at_) < count) load(count);
  return {at_, std::min(count, static_cast<std::size_t>(end_ - at_))};
}

bool ModelFile::skip(std::uint64_t count) {
  while (count > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(count, kMaxTake));
    if (take(step) == nullptr) return false;
    count -= step;
  }
  return true;
}

void ModelFile::pass_line_end(char end) {
  if (!(end == '\n' && after_cr_)) ++next_line_;
  after_cr_ = end == '\r';
}

std::string_view ModelFile::word() {
  for (;;) {
    while (at_ < end_ && is_space(*at_)) {
      if (ends_line(*at_)) pass_line_end(*at_);
      else after_cr_ = false;
      ++at_;
    }
    if (at_ < end_ || !load(1)) break;
  }
  line_ = next_line_;
  after_cr_ = false;
  if (static_cast<std::size_t>(end_ - at_) <= kMaxTake) load(kMaxTake + 1);
  const char* const begin = at_;
  while (at_ < end_ && !is_space(*at_)) ++at_;
  if (static_cast<std::size_t>(at_ - begin) > kMaxTake)
    fail_at_line("found a word of more than " + std::to_string(kMaxTake) + " bytes");
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view ModelFile::rest_of_line() {
  if (static_cast<std::size_t>(end_ - at_) <= kMaxTake) load(kMaxTake + 1);
  after_cr_ = false;
  line_ = next_line_;
  const char* const begin = at_;
  const char* const limit = at_ + std::min(kMaxTake, static_cast<std::size_t>(end_ - at_));
  while (at_ < limit && !ends_line(*at_)) ++at_;
  const std::string_view line(begin, static_cast<std::size_t>(at_ - begin));
  if (at_ < end_ && ends_line(*at_)) {
    pass_line_end(*at_++);
    if (after_cr_ && !lines_end_with_cr_ && at_ < end_ && *at_ == '\n') ++at_;
    else lines_end_with_cr_ |= after_cr_;
    after_cr_ = false;
    return trimmed(line);
  }
  for (;;) {  // the line is longer
    const std::string_view next = peek(1);
    if (next.empty()) return trimmed(line);
    ++at_;
    if (!ends_line(next[0])) continue;
    pass_line_end(next[0]);
    return trimmed(line);
  }
}

void ModelFile::fail_at_line(const std::string& what) const {
  throw Error(path_ + ":" + std::to_string(line_) + ": " + what);
}

void ModelFile::fail_at_byte(const std::string& what) const {
  throw Error(path_ + ": byte " + std::to_string(offset()) + ": " + what);
}

}  // namespace tessera::program
