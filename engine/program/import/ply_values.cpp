#include "engine/program/import/ply_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>

#include "engine/program/import/number_text.h"

namespace tessera::program {
namespace {

constexpr const char* kTooShort = "the file ends before the last element that its header announces";

std::int64_t truncated(double number) {
  constexpr double kLimit = 9223372036854775808.0;  // 2^63
  if (!(number > -kLimit)) return std::numeric_limits<std::int64_t>::min();
  return number < kLimit ? static_cast<std::int64_t>(number) : std::numeric_limits<std::int64_t>::max();
}

}  // namespace

void PlyValues::fail(const std::string& what) const {
  if (format_ == PlyFormat::ascii) file_.fail_at_line(what);
  file_.fail_at_byte(what);
}

template <class T>
T PlyValues::binary() {
  static_assert(std::endian::native == std::endian::little);
  const char* const bytes = file_.take(sizeof(T));
  if (bytes == nullptr) fail(kTooShort);
  std::array<char, sizeof(T)> value;
  std::memcpy(value.data(), bytes, sizeof(T));
  if (format_ == PlyFormat::big_endian) std::ranges::reverse(value);
  return std::bit_cast<T>(value);
}

std::string_view PlyValues::word() {
  const std::string_view word = file_.word();
  if (word.empty()) fail(kTooShort);
  return word;
}

double PlyValues::number(PlyType type) {
  if (format_ == PlyFormat::ascii) {
    const std::string_view text = word();
    const std::optional<double> value = number_of(text);
    if (!value) fail("found " + quoted(text) + ", expected a number");
    return *value;
  }
  switch (type) {
    case PlyType::int8: return binary<std::int8_t>();
    case PlyType::uint8: return binary<std::uint8_t>();
    case PlyType::int16: return binary<std::int16_t>();
    case PlyType::uint16: return binary<std::uint16_t>();
    case PlyType::int32: return binary<std::int32_t>();
    case PlyType::uint32: return binary<std::uint32_t>();
    case PlyType::float32: return double{binary<float>()};
    case PlyType::float64: return binary<double>();
  }
  return 0;
}

std::int64_t PlyValues::integer(PlyType type) {
  if (format_ == PlyFormat::ascii) {
    const std::string_view text = word();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) return value;
    const std::optional<double> number = number_of(text);
    if (!number || *number != static_cast<double>(truncated(*number)))
      fail("found " + quoted(text) + ", expected an integer");
    return truncated(*number);
  }
  switch (type) {
    case PlyType::int8: return binary<std::int8_t>();
    case PlyType::uint8: return binary<std::uint8_t>();
    case PlyType::int32: return binary<std::int32_t>();
    case PlyType::uint32: return binary<std::uint32_t>();
    default: return truncated(number(type));
  }
}

std::uint64_t PlyValues::list_length(const PlyProperty& list) {
  const std::int64_t length = integer(list.count_type);
  const std::uint64_t bytes = format_ == PlyFormat::ascii ? 1 : size_of(list.type);  // at least
  if (length < 0 || static_cast<std::uint64_t>(length) > file_.remaining() / bytes)
    fail("found a list of " + std::to_string(length) + " values, and " + std::to_string(file_.remaining()) +
         " bytes are left");
  return static_cast<std::uint64_t>(length);
}

void PlyValues::skip(const PlyProperty& property) {
  std::uint64_t count = property.is_list ? list_length(property) : 1;
  if (format_ != PlyFormat::ascii) {
    if (!file_.skip(count * size_of(property.type))) fail(kTooShort);
    return;
  }
  for (; count > 0; --count) word();
}

std::uint64_t PlyValues::plausible(const PlyElement& element) const {
  const std::uint64_t bytes = element.min_bytes(format_);
  return bytes == 0 ? 0 : std::min(element.count, file_.remaining() / bytes + 1);
}

}  // namespace tessera::program
