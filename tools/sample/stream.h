// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Many small records into a file: filled in parallel, written in order.

#include "stages/parallel.h"

#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace vitrine::sample {

constexpr std::size_t kBlock = 4096, kBlocksAtOnce = 64;

/// Makes the folder and opens the file; whatever fails later throws.
inline std::ofstream create(std::filesystem::path const& path) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  std::ofstream file;
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file.open(path, std::ios::binary);
  return file;
}

/// n records of `bytes` each: fill(i, where).
template <class Fill>
void write_records(std::ofstream& file, std::size_t n, std::size_t bytes, Fill const& fill) {
  std::vector<char> buffer(std::min(n, kBlock * kBlocksAtOnce) * bytes);
  for (std::size_t begin = 0; begin < n; begin += kBlock * kBlocksAtOnce) {
    std::size_t const count = std::min(kBlock * kBlocksAtOnce, n - begin);
    parallel_for(count, kBlock, [&](std::size_t i) { fill(begin + i, buffer.data() + i * bytes); });
    file.write(buffer.data(), std::streamsize(count * bytes));
  }
}

/// n pieces of text: print(i, text) appends.
template <class Print>
void write_lines(std::ofstream& file, std::size_t n, Print const& print) {
  for (std::size_t begin = 0; begin < n; begin += kBlock * kBlocksAtOnce) {
    std::vector<std::string> texts(kBlocksAtOnce);
    parallel_blocks(std::min(kBlock * kBlocksAtOnce, n - begin), kBlock, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) print(begin + i, texts[from / kBlock]);
    });
    for (std::string const& text : texts) file.write(text.data(), std::streamsize(text.size()));
  }
}

template <class T>
char* put(char* where, T value) {
  std::memcpy(where, &value, sizeof value);
  return where + sizeof value;
}

/// Shortest text that reads back as the same number, after a space.
template <class T>
void print(std::string& text, T value) {
  char digits[32];
  text += ' ';
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace vitrine::sample
