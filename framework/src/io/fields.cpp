// SPDX-License-Identifier: BSD-3-Clause
#include "io/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"

namespace cambium {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Control characters that no text file has; bytes above 127 may be UTF-8 in a comment.
bool is_binary(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 32 && c != '\n' && c != '\r' && c != '\t' && c != '\f') || byte == 127;
}

std::size_t word_length(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && !is_blank(text[n])) ++n;
  return n;
}

void skip_blanks(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_blank(text[n])) ++n;
  text.remove_prefix(n);
}

std::string what_is_wrong(std::string_view word, std::errc error) {
  if (word.find(',') != std::string_view::npos)
    return fmt::format(
        "found '{}', expected a number with a decimal point; was the file written "
        "under a locale with decimal commas?",
        quoted(word));
  if (error == std::errc::result_out_of_range)
    return fmt::format("found '{}', which is beyond the range of a number", quoted(word));
  return fmt::format("found '{}', expected a number", quoted(word));
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  skip_blanks(text);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string quoted(std::string_view text) {
  std::string out(text.substr(0, 40));
  for (char& c : out)
    if (c < 32 || c == 127) c = '?';  // char is signed here: bytes above 127 are replaced too
  return text.size() > 40 ? out + "..." : out;
}

std::size_t find_binary(std::string_view text) {
  const auto it = std::find_if(text.begin(), text.end(), is_binary);
  return it == text.end() ? text.npos : std::size_t(it - text.begin());
}

void refuse_binary(std::string_view text, const std::filesystem::path& file) {
  // The whole file for zeros (fast), its beginning for the rest.
  std::size_t at = find_binary(text.substr(0, 4096));
  if (at == text.npos) at = text.find('\0');
  if (at == text.npos) return;
  throw Error(ErrorCode::data, file.string(),
              fmt::format("is binary, expected text: byte {} is 0x{:02x}; is it another file, "
                          "compressed or damaged?",
                          at, static_cast<unsigned char>(text[at])));
}

std::string format_number(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

Fields::Fields(std::string_view line, const LineOrigin& origin)
    : line_(line), rest_(line), origin_(origin) {
  skip_blanks(rest_);
}

std::string_view Fields::word() {
  if (rest_.empty()) fail(fmt::format("found {} fields, expected more", count()));
  const std::string_view out = rest_.substr(0, word_length(rest_));
  rest_.remove_prefix(out.size());
  skip_blanks(rest_);
  return out;
}

double Fields::number() {
  const std::string_view text = word();
  if (text.size() == 1 && text[0] >= '0' && text[0] <= '9') return text[0] - '0';  // most of them
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data() + plus, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) fail(what_is_wrong(text, error));
  if (!std::isfinite(value))
    fail(fmt::format("found '{}', expected a finite number", quoted(text)));
  return value;
}

std::int64_t Fields::integer(const char* what) {
  const std::string_view text = word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0)
    fail(fmt::format("found '{}', expected {}: an integer from 0 to 2^63 - 1", quoted(text), what));
  return value;
}

void Fields::numbers(double* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = number();
}

void Fields::expect(int count, int or_count) const {
  const int found = this->count();
  if (found == count || found == or_count) return;
  std::string_view tag = line_.substr(0, word_length(line_));
  fail(fmt::format("expected {}{} fields in a line '{}', found {}", count,
                   or_count < 0 ? "" : fmt::format(" or {}", or_count), quoted(tag), found));
}

int Fields::count() const {
  int n = !line_.empty() && !is_blank(line_[0]);
  for (std::size_t i = 1; i < line_.size(); ++i)  // first characters of words, without branches
    n += int(is_blank(line_[i - 1])) & int(!is_blank(line_[i]));
  return n;
}

void Fields::fail(const std::string& message) const {
  throw Error(ErrorCode::data, origin_.where(),
              origin_.cut ? message +
                                "; the line has no end, so the file may be truncated: copy it "
                                "again from its source"
                          : message);
}

}  // namespace cambium
