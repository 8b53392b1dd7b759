// SPDX-License-Identifier: Apache-2.0
#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace vitrine::io {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  return line;
}

/// The first word of `line`, which is cut off from it.
std::string_view take_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_space(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_space(line[end])) ++end;
  std::string_view const word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

char line_end(std::string_view text) {
  constexpr auto none = std::string_view::npos;
  text = text.substr(0, 1 << 16);
  std::size_t const feed = text.find('\n'), first = text.find('\r');
  if (feed == none) return first == none ? '\n' : '\r';
  std::size_t const second = first == none ? none : text.find('\r', first + 1);
  return second < feed && second + 1 != feed ? '\r' : '\n';
}

bool TextScanner::next_line() {
  while (!rest_.empty()) {
    std::size_t const end = std::min(rest_.find(line_end_), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    if (comment_ != '\0') line = line.substr(0, line.find(comment_));
    unread_ = trimmed(line);
    if (!unread_.empty()) return true;
  }
  unread_ = {};
  return false;
}

void TextScanner::next_line_of(std::string_view unit, std::uint64_t index, std::uint64_t count) {
  if (next_line()) return;
  throw error("the file ends after " + std::to_string(index) + " of " + std::to_string(count) + " " + std::string(unit),
              "copy or export the file again and compare its size");
}

std::string_view TextScanner::word() { return take_word(unread_); }

std::string_view TextScanner::rest_of_line() { return trimmed(std::exchange(unread_, {})); }

std::span<std::string_view const> TextScanner::words() {
  words_.clear();
  for (std::string_view next = word(); !next.empty(); next = word()) words_.push_back(next);
  return words_;
}

double TextScanner::number(std::string_view text) const {
  if (text.empty()) throw error("a number is missing at the end of the line");
  std::string_view const digits = without_plus(text);
  double value = 0;
  auto const [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::result_out_of_range) {
    bool const tiny = digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos;
    value = tiny ? 0 : std::numeric_limits<double>::infinity();
    if (digits[0] == '-') value = -value;
  } else if (status != std::errc{} || end != digits.data() + digits.size()) {
    throw error(shown(text) + " is no number");
  }
  return value;
}

std::int64_t TextScanner::integer(std::string_view text) const {
  if (text.empty()) throw error("a whole number is missing at the end of the line");
  std::string_view const digits = without_plus(text);
  std::int64_t value = 0;
  auto const [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status != std::errc{} || end != digits.data() + digits.size()) throw error(shown(text) + " is no whole number");
  return value;
}

Error TextScanner::error(std::string const& what, std::string remedy) const {
  return Error(ErrorKind::invalid_input, format_ + " line " + std::to_string(line_) + ": " + what, std::move(remedy));
}

std::string shown(std::string_view word) {
  std::string result = "\"";
  for (char c : word.substr(0, 40)) result += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  return result + (word.size() > 40 ? "…\"" : "\"");
}

std::string shown(double value) {
  std::array<char, 32> digits;
  auto const [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

std::string damage_remedy(std::string_view bytes) {
  std::string_view const sample = bytes.substr(0, 1 << 20);
  std::size_t replaced = 0;
  for (std::size_t at = 0; (at = sample.find("\xEF\xBF\xBD", at)) != std::string_view::npos; at += 3) ++replaced;
  if (replaced < 16) return "copy or export the file again and compare its size";
  return "the file was converted as if it were text (" + std::to_string(replaced) +
         " replacement characters in its first MiB): get the original again, as binary";
}

}  // namespace vitrine::io
