// SPDX-License-Identifier: Apache-2.0
#include "tools/report/escape.h"

namespace vitrine::report {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

bool control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

}  // namespace

std::string html(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        control(c) ? out += kReplacement : out += c;
    }
  }
  return out;
}

std::string markdown(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (control(c)) c = ' ';
    if (std::string_view("\\`*_[]<>&|#~!").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string shortened(std::string_view text, std::size_t characters) {
  std::size_t seen = 0, keep = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!starts_character(text[i])) continue;
    if (++seen == characters) keep = i;
    if (seen > characters) return std::string(text.substr(0, keep)) + "\xE2\x80\xA6";
  }
  return std::string(text);
}

}  // namespace vitrine::report
