// SPDX-License-Identifier: Apache-2.0
#include "graph/wire.h"

#include "graph/bounded_json.h"

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace vitrine::graph {
namespace {

using Length = std::uint32_t;
constexpr Length kLongest = 1u << 30;

bool write_whole(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    ssize_t const written = ::write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(std::size_t(written));
  }
  return true;
}

}  // namespace

bool send(int pipe, StrictJson const& value) {
  std::string bytes(sizeof(Length), '\0');
  StrictJson::to_cbor(value, bytes);
  Length const length = Length(bytes.size() - sizeof(Length));
  std::memcpy(bytes.data(), &length, sizeof length);
  return length <= kLongest && write_whole(pipe, bytes);
}

bool Inbox::read(std::function<void(StrictJson const&)> const& take) {
  char piece[1 << 16];
  ssize_t const count = ::read(pipe_, piece, sizeof piece);
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  if (count == 0) return false;
  bytes_.append(piece, std::size_t(count));
  return hand_on(take);
}

bool Inbox::hand_on(std::function<void(StrictJson const&)> const& take) {
  std::size_t begin = 0;
  Length length = 0;
  while (bytes_.size() - begin >= sizeof length) {
    std::memcpy(&length, bytes_.data() + begin, sizeof length);
    if (length > kLongest) return false;
    if (bytes_.size() - begin - sizeof length < length) break;
    std::optional<StrictJson> const json = bounded_cbor({bytes_.data() + begin + sizeof length, length});
    if (!json) return false;
    take(*json);
    begin += sizeof length + length;
  }
  bytes_.erase(0, begin);
  return true;
}

}  // namespace vitrine::graph
