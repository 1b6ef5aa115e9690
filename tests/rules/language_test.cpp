// How comments, messages and test names read: finds words of a private dialect, over-long lines and suite
// names that two files share. Each finding is printed as file:line: word: what to write instead.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/rules/source_files.h"

namespace tessera::rules::language_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kMaxColumns = 110;

struct Phrase {
  std::string_view text;  ///< lower case; matches whole words, in any case, over line ends within a comment
  std::string_view instead;
};

/// In comments, string literals and Markdown.
const std::vector<Phrase> kPhrases = {
    {"has no say", "name what is ignored"},
    {"have no say", "name what is ignored"},
    {"nobody", "name the thread, function or caller"},
    {"somebody", "name the thread, function or caller"},
    {"whoever", "name the thread, function or caller"},
    {"what of", "name the thing: 'the part of ... that'"},
    {"so many", "give the number or the limit"},
    {"looked at", "read, tested or used"},
    {"looks at", "reads, tests or uses"},
    {"comes about", "arises, or is computed"},
    {"come about", "arise, or are computed"},
    {"foretold", "predicted"},
    {"give or take", "to within"},
    {"of its own", "separate, private, or name the owner"},
    {"of their own", "separate, private, or name the owner"},
    {"of one's own", "separate, private, or name the owner"},
    {"the same of", "repeat the noun"},
    {"never not at all", "exactly once"},
    {"stands for nothing", "is not a valid value"},
    {"beside", "next to, besides, or relative to"},
    {"all is well", "PASS, or correct"},
    {"that are none", "state what is wrong with them"},
    {"that is none", "state what is wrong with it"},
    {"one after the other", "in order, or one at a time"},
    {"what is not", "give the noun: 'non-finite values'"},
    {"what they come to", "name the result"},
    {"what it comes to", "name the result"},
    {"thereof", "name the thing"},
    {"whereof", "name the thing"},
};

/// In C++ comments only: Markdown may speak of users.
const std::vector<Phrase> kCodePhrases = {
    {"who", "code is not a person: name the thread, function or caller"},
    {"anybody", "name the thread, function or caller"},
};

/// First words of a comment: the noun is missing.
const std::vector<Phrase> kBeginnings = {
    {"of", "begin with the noun"},
    {"the same as", "repeat the noun"},
    {"the same by", "repeat the noun"},
    {"the same for", "repeat the noun"},
    {"the same in", "repeat the noun"},
    {"the same where", "repeat the noun"},
    {"and", "one comment does not continue another"},
    {"what", "begin with the noun"},
    {"who", "begin with the noun"},
    {"whose", "begin with the noun"},
    {"which", "begin with the noun"},
    {"that", "begin with the noun"},
};

/// Findings that are right as they are.
struct Allowed {
  std::string_view file;    ///< relative to the root
  std::string_view phrase;  ///< of the lists above
  std::string_view reason;
};
const std::vector<Allowed> kAllowed = {
    {"tests/rules/language_test.cpp", "*", "the lists themselves"},
};

bool is_allowed(const std::string& file, std::string_view phrase) {
  return std::any_of(kAllowed.begin(), kAllowed.end(), [&](const Allowed& allowed) {
    return allowed.file == file && (allowed.phrase == phrase || allowed.phrase == "*");
  });
}

/// Text of one kind. Comments on successive lines are one passage, joined by spaces.
struct Passage {
  enum class Kind { comment, literal, prose } kind = Kind::comment;
  std::string text;
  std::vector<std::pair<std::size_t, int>> starts;  ///< (offset in `text`, line) of each line's part

  int line_at(std::size_t offset) const {
    int line = starts.front().second;
    for (const auto& [start, number] : starts)
      if (start <= offset) line = number;
    return line;
  }
  void append(std::string_view part, int line) {
    if (!text.empty()) text += ' ';
    starts.emplace_back(text.size(), line);
    text += part;
  }
};

/// Splits C++ into comments and string literals; the rest is dropped.
class Reader {
 public:
  explicit Reader(std::string text) : text_(std::move(text)) {}

  std::vector<Passage> read() {
    while (at_ < text_.size()) step();
    return std::move(passages_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void advance() {
    if (text_[at_] == '\n') {
      ++line_;
      line_has_code_ = false;
    }
    ++at_;
  }
  void step() {
    const char c = peek();
    if (c == '/' && peek(1) == '/') return read_line_comment();
    if (c == '/' && peek(1) == '*') return read_block_comment();
    if (std::isspace(static_cast<unsigned char>(c)) == 0) line_has_code_ = true;
    if (c == '"') return read_literal();
    if (c == '\'') return read_character();
    advance();
  }
  void read_line_comment() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::size_t begin = std::min(text_.find_first_not_of("/!", at_), end);
    if (text_[begin] == '<') ++begin;
    while (begin < end && text_[begin] == ' ') ++begin;
    const std::string_view part = std::string_view(text_).substr(begin, end - begin);
    // A trailing comment may continue on a line without code; a comment after code always starts anew.
    const bool continues = !line_has_code_ && comment_line_ == line_ - 1;
    if (!continues || part.empty()) passages_.push_back({.kind = Passage::Kind::comment});
    passages_.back().append(part, line_);
    comment_line_ = line_;
    while (at_ < end) advance();
  }
  void read_block_comment() {
    passages_.push_back({.kind = Passage::Kind::comment});
    const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
    passages_.back().append(std::string_view(text_).substr(at_ + 2, end - at_ - 2), line_);
    while (at_ < std::min(end + 2, text_.size())) advance();
  }
  bool is_raw() const { return at_ > 0 && text_[at_ - 1] == 'R'; }
  void read_literal() {
    const int line = line_;
    const std::size_t begin = at_ + 1;
    std::size_t end = begin;
    std::size_t after = 0;
    if (is_raw()) {
      const std::size_t open = text_.find('(', begin);
      const std::string closing = ")" + text_.substr(begin, open - begin) + "\"";
      end = std::min(text_.find(closing, open), text_.size());
      after = end + closing.size();
    } else {
      while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
      after = end + 1;
    }
    passages_.push_back({.kind = Passage::Kind::literal});
    passages_.back().append(std::string_view(text_).substr(begin, end - begin), line);
    while (at_ < std::min(after, text_.size())) advance();
    line_has_code_ = true;
  }
  void read_character() {
    const bool is_separator = at_ > 0 && std::isalnum(static_cast<unsigned char>(text_[at_ - 1])) != 0;
    advance();
    if (is_separator) return;  // 1'000
    while (at_ < text_.size() && peek() != '\'' && peek() != '\n') {
      if (peek() == '\\') advance();
      advance();
    }
    if (peek() == '\'') advance();
  }

  std::string text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int comment_line_ = -1;  ///< of the last // comment
  bool line_has_code_ = false;
  std::vector<Passage> passages_;
};

std::vector<Passage> passages_of(const std::string& file) {
  if (!file.ends_with(".md")) return Reader(text_of(file)).read();
  Passage whole{.kind = Passage::Kind::prose};
  int number = 0;
  for (const std::string& line : lines_of(file)) whole.append(line, ++number);
  return {whole};
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '\''; }
bool is_word_at(const std::string& text, std::size_t at, std::size_t length) {
  const bool begins = at == 0 || !in_word(text[at - 1]);
  const bool ends = at + length >= text.size() || !in_word(text[at + length]);
  return begins && ends;
}

struct Finding {
  std::string file;
  int line = 0;
  std::string text;
};
std::string where(const Finding& found) {
  return found.file + ":" + std::to_string(found.line) + ": " + found.text;
}
Finding finding(const std::string& file, int line, const Phrase& phrase) {
  return {file, line, std::string(phrase.text) + ": " + std::string(phrase.instead)};
}

void find_in(const Passage& passage, const std::string& file, std::vector<Finding>& found) {
  const std::string text = lower(passage.text);
  const auto search = [&](const std::vector<Phrase>& phrases) {
    for (const Phrase& phrase : phrases)
      for (std::size_t at = text.find(phrase.text); at != std::string::npos;
           at = text.find(phrase.text, at + 1))
        if (is_word_at(text, at, phrase.text.size()) && !is_allowed(file, phrase.text))
          found.push_back(finding(file, passage.line_at(at), phrase));
  };
  search(kPhrases);
  if (passage.kind != Passage::Kind::comment) return;
  search(kCodePhrases);
  for (const Phrase& phrase : kBeginnings)
    if (text.starts_with(phrase.text) && is_word_at(text, 0, phrase.text.size()) &&
        !is_allowed(file, phrase.text))
      found.push_back(finding(file, passage.line_at(0), phrase));
}

/// One failure that lists all findings and their number per folder.
void report(const std::vector<Finding>& found) {
  std::map<std::string, int> per_folder;
  std::string text;
  for (const Finding& one : found) {
    text += where(one) + '\n';
    const std::size_t slash = one.file.rfind('/');
    ++per_folder[slash == std::string::npos ? "." : one.file.substr(0, slash)];
  }
  for (const auto& [folder, count] : per_folder) text += folder + ": " + std::to_string(count) + '\n';
  EXPECT_TRUE(found.empty()) << text << found.size() << " findings";
}

std::vector<std::string> literals_and_comments(const std::string& code) {
  std::vector<std::string> texts;
  for (const Passage& passage : Reader(code).read()) texts.push_back(passage.text);
  return texts;
}

TEST(LanguageReader, FindsCommentsAndLiterals) {
  EXPECT_THAT(literals_and_comments("int a;  ///< one\n// two\n// three\nf(\"four\\\"\"); /* five */"),
              ElementsAre("one two three", "four\\\"", " five "));
  EXPECT_THAT(literals_and_comments("int a = 1'000;  // one\nint b = '\"';  // two\n"),
              ElementsAre("one", "two"));
  EXPECT_THAT(literals_and_comments("g(R\"x(// \"no\")x\");  // yes"), ElementsAre("x(// \"no\"", "yes"));
}

TEST(LanguageReader, FindsWholePhrasesOverLineEnds) {
  std::vector<Finding> found;
  for (const Passage& passage : Reader("\n// holds so\n// many; no whom, wholly\n// Of it\n").read())
    find_in(passage, "file.cpp", found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(where(found[0]).substr(0, 20), "file.cpp:2: so many:");
  found.clear();
  for (const Passage& passage : Reader("int a;  ///< of it\n").read()) find_in(passage, "file.cpp", found);
  ASSERT_EQ(found.size(), 1u);
}

TEST(Language, CommentsAndMessagesUsePlainTerms) {
  std::vector<std::string> files = all_cpp_files();
  const std::vector<std::string> documents = all_markdown_files();
  files.insert(files.end(), documents.begin(), documents.end());
  std::vector<Finding> found;
  for (const std::string& file : files)
    for (const Passage& passage : passages_of(file)) find_in(passage, file, found);
  report(found);
}

TEST(Language, AllowedFilesExist) {
  for (const Allowed& allowed : kAllowed) {
    EXPECT_FALSE(text_of(std::string(allowed.file)).empty());
    EXPECT_FALSE(allowed.reason.empty()) << allowed.file;
  }
}

/// Code points of UTF-8 text.
std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

TEST(Language, LinesFitTheColumnLimit) {
  std::vector<Finding> found;
  for (const std::string& file : all_cpp_files()) {
    int number = 0;
    for (const std::string& line : lines_of(file)) {
      ++number;
      if (columns(line) > kMaxColumns)
        found.push_back({file, number, std::to_string(columns(line)) + " columns"});
    }
  }
  report(found);
}

struct TestName {
  std::string suite, name;
  int line = 0;
};
/// TEST, TEST_F, TEST_P and the typed ones that begin a line.
std::vector<TestName> tests_of(const std::string& file) {
  static const std::vector<std::string> kMacros = {"TEST(", "TEST_F(", "TEST_P(", "TYPED_TEST(",
                                                   "TYPED_TEST_P("};
  std::vector<TestName> found;
  int number = 0;
  for (const std::string& line : lines_of(file)) {
    ++number;
    const bool is_test = std::any_of(kMacros.begin(), kMacros.end(),
                                     [&](const std::string& macro) { return line.starts_with(macro); });
    const std::size_t open = line.find('(');
    const std::size_t comma = line.find(',');
    const std::size_t close = line.find(')');
    if (!is_test || close == std::string::npos || comma > close) continue;
    const std::size_t name = line.find_first_not_of(' ', comma + 1);
    found.push_back({line.substr(open + 1, comma - open - 1), line.substr(name, close - name), number});
  }
  return found;
}

TEST(Language, SuiteNamesAreUnique) {
  std::vector<Finding> found;
  std::map<std::string, std::string> files;
  for (const std::string& file : all_cpp_files()) {
    std::set<std::string> reported;
    for (const TestName& test : tests_of(file)) {
      const auto [first, is_new] = files.emplace(test.suite, file);
      if (!is_new && first->second != file && reported.insert(test.suite).second)
        found.push_back({file, test.line, "suite " + test.suite + " is also in " + first->second});
    }
  }
  EXPECT_GT(files.size(), 100u);
  report(found);
}

// Unity builds compile several test files as one, and their helpers share names such as kSide.
TEST(Language, NamespacesOfTestFilesAreNamedAfterTheFiles) {
  int files = 0;
  for (const std::string& file : all_cpp_files()) {
    if (!file.ends_with("_test.cpp")) continue;
    const std::string namespace_end = "::" + std::filesystem::path(file).stem().string() + " {";
    EXPECT_NE(text_of(file).find(namespace_end + "\n"), std::string::npos)
        << file << ": expected a namespace whose name ends with \"" << namespace_end << '"';
    ++files;
  }
  EXPECT_GT(files, 150);
}

TEST(Language, TestNamesStateTheBehaviour) {
  std::vector<Finding> found;
  for (const std::string& file : all_cpp_files())
    for (const TestName& test : tests_of(file)) {
      const std::string& name = test.name;
      const bool continues_suite =
          name.starts_with("Of") && name.size() > 2 && std::isupper(static_cast<unsigned char>(name[2])) != 0;
      if (continues_suite) found.push_back({file, test.line, test.suite + "." + name + " begins with Of"});
    }
  report(found);
}

}  // namespace
}  // namespace tessera::rules::language_test
