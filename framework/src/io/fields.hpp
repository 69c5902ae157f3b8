// SPDX-License-Identifier: BSD-3-Clause
// Taking lines of text apart. No allocation per line: a large graph has millions of numbers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace cambium {

/// Where a line comes from, for messages.
struct LineOrigin {
  const std::filesystem::path& file;
  int line = 0;      ///< 1-based
  bool cut = false;  ///< the last line of the file, and no newline ends it

  std::string where() const { return file.string() + ":" + std::to_string(line); }
};

/// The blank-separated fields of one line, from left to right. Errors are Error(data, file:line).
class Fields {
 public:
  Fields(std::string_view line, const LineOrigin& origin);

  bool more() const { return !rest_.empty(); }
  std::string_view word();                 ///< throws when there is none left
  double number();                         ///< finite
  std::int64_t integer(const char* what);  ///< not negative; `what` is named in messages
  void numbers(double* out, int count);
  /// Throws unless the line has one of these counts of fields, its first word included.
  void expect(int count, int or_count = -1) const;

  int count() const;  ///< all fields of the line
  std::string_view line() const { return line_; }
  const LineOrigin& origin() const { return origin_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view line_, rest_;
  const LineOrigin& origin_;
};

/// Calls on_line(trimmed line, LineOrigin) for every line that is not blank. Takes LF and CRLF,
/// UTF-8 byte order marks and a last line without end. Throws Error(data) on binary data.
template <class F>
void for_each_line(std::string_view text, const std::filesystem::path& file, F&& on_line);

std::string_view trimmed(std::string_view text);  ///< without blanks around it
/// Position of the first byte that no text has (control characters), or npos.
std::size_t find_binary(std::string_view text);
void refuse_binary(std::string_view text, const std::filesystem::path& file);
/// Foreign text for a message: at most 40 characters, unprintable bytes as '?'.
std::string quoted(std::string_view text);

template <class F>
void for_each_line(std::string_view text, const std::filesystem::path& file, F&& on_line) {
  refuse_binary(text, file);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const bool cut = end == std::string_view::npos;
    std::string_view content = trimmed(text.substr(0, end));
    // Joined files have such marks inside, too.
    while (content.starts_with(byte_order_mark)) content = trimmed(content.substr(3));
    if (!content.empty()) on_line(content, LineOrigin{file, line, cut});
    text.remove_prefix(cut ? text.size() : end + 1);
  }
}

}  // namespace cambium
