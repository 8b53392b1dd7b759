// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Words and numbers of the text formats, line by line. Internal to io.

#include "stages/error.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vitrine::io {

/// '\r' where the first two lines end so, or no line otherwise, as some exporters still write them; else '\n'.
char line_end(std::string_view text);

/// Walks lines that hold something, and the words in each; whatever is not there or is no number is an Error with its
/// line.
class TextScanner {
 public:
  /// `format` ("PLY") names the file in errors; `line`: number of the line before the first; text after `comment` is
  /// skipped.
  TextScanner(std::string_view text, std::string format, std::uint64_t line = 0, char comment = '\0')
      : rest_(text), format_(std::move(format)), line_(line), line_end_(line_end(text)), comment_(comment) {}

  /// Goes to the next line with a word in it; false at the end of the text.
  bool next_line();

  /// The same; an Error that says which of `count` `unit` is missing when there is none.
  void next_line_of(std::string_view unit, std::uint64_t index, std::uint64_t count);

  /// The next word of this line; empty at its end.
  std::string_view word();
  /// What is left of this line, without spaces at its ends.
  std::string_view rest_of_line();
  /// All words that are left of this line; valid until the next call.
  std::span<std::string_view const> words();

  /// A word of this line as a number, also nan and inf; beyond a double's range it becomes 0 or infinity.
  double number(std::string_view word) const;
  double number() { return number(word()); }
  std::int64_t integer(std::string_view word) const;
  std::int64_t integer() { return integer(word()); }

  /// Bytes after this line.
  std::size_t bytes_left() const { return rest_.size(); }
  std::uint64_t line() const { return line_; }

  /// InvalidInput "PLY line 12: what".
  Error error(std::string const& what, std::string remedy = "export the model again") const;

 private:
  std::string_view rest_;    ///< after the current line
  std::string_view unread_;  ///< of the current line
  std::vector<std::string_view> words_;
  std::string format_;
  std::uint64_t line_;
  char line_end_;
  char comment_;
};

/// A word as errors show it: at most 40 bytes, without control characters.
std::string shown(std::string_view word);

/// A number as errors show it: whole ones without a fraction.
std::string shown(double value);

/// What a user can do about bytes that make no sense: says so when a binary file went through a text conversion.
std::string damage_remedy(std::string_view bytes);

}  // namespace vitrine::io
