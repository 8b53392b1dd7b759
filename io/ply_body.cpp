// SPDX-License-Identifier: Apache-2.0
#include "io/ply_body.h"

#include "io/bytes.h"

#include <array>
#include <bit>
#include <utility>

namespace vitrine::io {
namespace {

template <class T, std::endian Order>
double load_double(std::byte const* at) {
  return static_cast<double>(load<T, Order>(at));
}

template <std::endian Order>
constexpr std::array<PlyLoad, 8> kLoads{load_double<std::int8_t, Order>,  load_double<std::uint8_t, Order>,
                                        load_double<std::int16_t, Order>, load_double<std::uint16_t, Order>,
                                        load_double<std::int32_t, Order>, load_double<std::uint32_t, Order>,
                                        load_double<float, Order>,        load_double<double, Order>};

/// Bytes that a record has at least: every list empty, every number of a text one digit and a space.
std::uint64_t least_bytes(PlyElement const& element, PlyFormat format) {
  std::uint64_t bytes = 0;
  for (PlyProperty const& property : element.properties)
    bytes += format == PlyFormat::ascii ? 2 : size_of(property.count_type.value_or(property.type));
  return bytes;
}

}  // namespace

PlyLoad ply_load(PlyType type, PlyFormat format) {
  auto const index = static_cast<std::size_t>(type);
  return format == PlyFormat::big_endian ? kLoads<std::endian::big>[index] : kLoads<std::endian::little>[index];
}

PlyBody::PlyBody(PlyHeader const& header, Blob const& file)
    : format_(header.format),
      file_(file),
      rest_(std::as_bytes(std::span(text(file).substr(header.bytes)))),
      lines_(text(file).substr(header.bytes), "PLY", header.lines) {}

Error PlyBody::error(std::string const& what) const {
  return Error(ErrorKind::invalid_input, "PLY " + what, damage_remedy(text(file_)));
}

void PlyBody::enter(PlyElement const& element) const {
  std::uint64_t const least = least_bytes(element, format_);
  std::uint64_t const left = format_ == PlyFormat::ascii ? lines_.bytes_left() + 1 : rest_.size();
  if (least > 0 && element.count > left / least)
    throw error("element " + shown(element.name) + ": " + std::to_string(element.count) + " announced, of " +
                std::to_string(least) + " bytes or more each, but only " + std::to_string(left) + " bytes are left");
}

std::optional<PlyLayout> PlyBody::layout(PlyElement const& element) const {
  if (format_ == PlyFormat::ascii || element.count == 0) return std::nullopt;
  PlyLayout layout;
  for (PlyProperty const& property : element.properties) {
    std::uint64_t values = 1;
    if (property.count_type) {
      std::size_t const count_bytes = size_of(*property.count_type);
      if (layout.stride + count_bytes > rest_.size()) return std::nullopt;
      PlyLoad const load_count = ply_load(*property.count_type, format_);
      double const count = load_count(rest_.data() + layout.stride);
      if (count < 0) return std::nullopt;
      layout.counts.push_back({layout.stride, load_count, count});
      values = std::uint64_t(count);
      layout.stride += count_bytes;
    }
    layout.offsets.push_back(layout.stride);
    layout.list_sizes.push_back(property.count_type ? values : 0);
    layout.stride += values * size_of(property.type);
  }
  if (layout.stride == 0 || element.count > rest_.size() / layout.stride) return std::nullopt;
  return layout;
}

void PlyBody::read_row(PlyElement const& element, PlyLayout const& layout, std::byte const* record, PlyRow& row) const {
  row.scalars.resize(element.properties.size());
  row.lists.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    PlyType const type = element.properties[i].type;
    PlyLoad const load_value = ply_load(type, format_);
    std::byte const* const values = record + layout.offsets[i];
    row.lists[i].resize(layout.list_sizes[i]);
    if (!element.properties[i].count_type) row.scalars[i] = load_value(values);
    for (std::size_t k = 0; k < row.lists[i].size(); ++k) row.lists[i][k] = load_value(values + k * size_of(type));
  }
}

void PlyBody::read_row(PlyElement const& element, std::uint64_t index, PlyRow& row) {
  row.scalars.assign(element.properties.size(), 0);
  row.lists.resize(element.properties.size());
  for (std::vector<double>& list : row.lists) list.clear();
  if (format_ == PlyFormat::ascii)
    read_text_row(element, index, row);
  else
    read_binary_row(element, index, row);
}

std::byte const* PlyBody::take(std::size_t bytes, PlyElement const& element, std::uint64_t index) {
  if (bytes > rest_.size())
    throw error("element " + shown(element.name) + ": the file ends within record " + std::to_string(index) + " of " +
                std::to_string(element.count));
  std::byte const* const taken = rest_.data();
  rest_ = rest_.subspan(bytes);
  return taken;
}

void PlyBody::read_binary_row(PlyElement const& element, std::uint64_t index, PlyRow& row) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    auto const& [name, type, count_type] = element.properties[i];
    PlyLoad const load_value = ply_load(type, format_);
    if (!count_type) {
      row.scalars[i] = load_value(take(size_of(type), element, index));
      continue;
    }
    double const count = ply_load(*count_type, format_)(take(size_of(*count_type), element, index));
    if (count < 0)
      throw error("element " + shown(element.name) + ": record " + std::to_string(index) + " has a list of " +
                  std::to_string(std::int64_t(count)) + " values");
    std::byte const* const values = take(std::size_t(count) * size_of(type), element, index);
    row.lists[i].resize(std::size_t(count));
    for (std::size_t k = 0; k < row.lists[i].size(); ++k) row.lists[i][k] = load_value(values + k * size_of(type));
  }
}

void PlyBody::read_text_row(PlyElement const& element, std::uint64_t index, PlyRow& row) {
  if (element.properties.empty()) return;
  lines_.next_line_of(element.name + " records", index, element.count);
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (!element.properties[i].count_type) {
      row.scalars[i] = lines_.number();
      continue;
    }
    std::int64_t const count = lines_.integer();
    if (count < 0) throw lines_.error("a list of " + std::to_string(count) + " values");
    for (std::int64_t k = 0; k < count; ++k) row.lists[i].push_back(lines_.number());
  }
}

void PlyBody::skip(PlyElement const& element) {
  if (element.properties.empty()) return;
  PlyRow row;
  for (std::uint64_t i = 0; i < element.count; ++i) read_row(element, i, row);
}

}  // namespace vitrine::io
