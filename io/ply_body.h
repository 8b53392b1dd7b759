// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The records that follow a PLY header, in all three formats. Internal to io.

#include "io/blob.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vitrine::io {

/// One record, by property: scalars hold 0 for a list, lists are empty for a scalar.
struct PlyRow {
  std::vector<double> scalars;
  std::vector<std::vector<double>> lists;
};

/// Reads a number of the file as double; int32 and uint32 fit exactly.
using PlyLoad = double (*)(std::byte const* at);
PlyLoad ply_load(PlyType type, PlyFormat format);

/// Binary records of equal size, so that each can be found without those before it.
struct PlyLayout {
  std::size_t stride = 0;
  std::vector<std::size_t> offsets;       ///< by property; of a list's first value
  std::vector<std::uint64_t> list_sizes;  ///< by property; 0 for scalars

  struct Count {
    std::size_t offset;
    PlyLoad load;
    double value;
  };
  std::vector<Count> counts;  ///< of the lists

  /// Whether this record's lists have the sizes.
  bool fits(std::byte const* record) const {
    for (Count const& count : counts)
      if (count.load(record + count.offset) != count.value) return false;
    return true;
  }
};

/// Reads elements one after the other. Errors: InvalidInput where the file ends early, with element and record.
class PlyBody {
 public:
  PlyBody(PlyHeader const& header, Blob const& file);

  /// To be called before an element is read: refuses counts that the bytes left cannot hold.
  void enter(PlyElement const& element) const;

  /// The element's records as equal ones: of lists' sizes as in its first record (others may differ: see `fits`).
  /// Nothing when the file is ascii or too short for that.
  std::optional<PlyLayout> layout(PlyElement const& element) const;

  /// A record that has the layout.
  void read_row(PlyElement const& element, PlyLayout const& layout, std::byte const* record, PlyRow& row) const;
  /// The next record.
  void read_row(PlyElement const& element, std::uint64_t index, PlyRow& row);
  void skip(PlyElement const& element);
  void skip_bytes(std::size_t bytes) { rest_ = rest_.subspan(bytes); }

  PlyFormat format() const { return format_; }
  std::byte const* data() const { return rest_.data(); }
  std::size_t bytes_left() const { return rest_.size(); }  ///< binary only

  /// InvalidInput "PLY what", with what to do about it.
  Error error(std::string const& what) const;

 private:
  std::byte const* take(std::size_t bytes, PlyElement const& element, std::uint64_t index);
  void read_binary_row(PlyElement const& element, std::uint64_t index, PlyRow& row);
  void read_text_row(PlyElement const& element, std::uint64_t index, PlyRow& row);

  PlyFormat format_;
  Blob file_;
  std::span<std::byte const> rest_;  ///< binary
  TextScanner lines_;                ///< ascii
};

}  // namespace vitrine::io
