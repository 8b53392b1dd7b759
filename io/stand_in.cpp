// SPDX-License-Identifier: Apache-2.0
#include "io/stand_in.h"

#include "io/blob.h"
#include "stages/error.h"

#include <algorithm>
#include <string>

namespace vitrine::io {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// Capitals are small letters; `start` has none.
bool starts(std::string_view text, std::string_view start) {
  return text.size() >= start.size() &&
         std::equal(start.begin(), start.end(), text.begin(), [](char a, char b) { return a == lower(b); });
}

bool is_web_page(std::string_view text) {
  text = without_mark(text);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return starts(text, "<!doctype html") || starts(text, "<html");
}

/// By the mark in front, and characters of ASCII after it: two bytes may begin anything.
bool is_utf16(std::string_view text) {
  if (text.size() < 8) return false;
  std::size_t const high = text.starts_with("\xFE\xFF") ? 0 : 1;
  if (high == 1 && !text.starts_with("\xFF\xFE")) return false;
  auto const is_ascii = [&](std::size_t at) { return text[at + high] == 0 && text[at + 1 - high] > 0; };
  return is_ascii(2) && is_ascii(4) && is_ascii(6);
}

}  // namespace

void refuse_stand_in(std::span<std::byte const> bytes, std::string_view what) {
  std::string_view const text = characters(bytes);
  auto const refuse = [&](std::string const& found, std::string const& remedy) {
    throw Error(ErrorKind::invalid_input, "the " + std::string(what) + " is " + found, remedy);
  };
  if (text.starts_with("version https://git-lfs"))
    refuse("a Git-LFS pointer, not the " + std::string(what) + " itself", "run `git lfs pull` in the archive");
  if (is_web_page(text)) refuse("a web page", "download it again; what was saved is the server's answer");
  if (is_utf16(text)) refuse("UTF-16 text", "save it again as plain text or UTF-8");
}

}  // namespace vitrine::io
