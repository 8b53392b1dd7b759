// SPDX-License-Identifier: Apache-2.0
#include "graph/wire.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <csignal>

namespace vitrine::graph {
namespace {

using nlohmann::json;

struct Pipe {
  int read, write;
  Pipe() {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    ::close(read);
    if (write >= 0) ::close(write);
  }
  void put(std::string_view bytes) const {
    ASSERT_EQ(::write(write, bytes.data(), bytes.size()), ssize_t(bytes.size()));
  }
};

std::string sent(json const& value) {
  Pipe const pipe;
  EXPECT_TRUE(send(pipe.write, value));
  std::string bytes(1 << 12, 0);
  bytes.resize(std::size_t(::read(pipe.read, bytes.data(), bytes.size())));
  return bytes;
}

TEST(Wire, MessagesArriveWholeHoweverShortTheReadsAre) {
  std::vector<json> const said = {{{"event", "stage"}, {"slug", "\xff"}}, json::object(), {{"n", 1.5}}};
  Pipe const pipe;
  Inbox inbox(pipe.read);
  std::vector<json> heard;
  for (json const& value : said)
    for (char const byte : sent(value)) {
      pipe.put({&byte, 1});
      EXPECT_TRUE(inbox.read([&](json const& message) { heard.push_back(message); }));
    }
  EXPECT_EQ(heard, said);
}

TEST(Wire, NonsenseEndsIt) {
  for (std::string const& bytes : {std::string("\xff\xff\xff\xff nonsense"), std::string("\x02\0\0\0\xff\xff", 6)}) {
    Pipe const pipe;
    pipe.put(bytes);
    EXPECT_FALSE(Inbox(pipe.read).read([](json const&) { ADD_FAILURE(); }));
  }
}

TEST(Wire, WhatIsNestedWithoutEndIsNonsense) {
  std::string bytes(60'000, '\x81');  // lists of one
  bytes += '\0';
  std::uint32_t const length = std::uint32_t(bytes.size());
  Pipe const pipe;
  pipe.put({reinterpret_cast<char const*>(&length), sizeof length});
  pipe.put(bytes);
  EXPECT_FALSE(Inbox(pipe.read).read([](json const&) { ADD_FAILURE(); }));
}

TEST(Wire, TheEndOfThePipeIsHeard) {
  Pipe pipe;
  ::close(std::exchange(pipe.write, -1));
  EXPECT_FALSE(Inbox(pipe.read).read([](json const&) {}));
}

TEST(Wire, NobodyListeningIsToldToTheSpeaker) {
  std::signal(SIGPIPE, SIG_IGN);
  Pipe pipe;
  ::close(std::exchange(pipe.read, ::dup(pipe.write)));
  EXPECT_FALSE(send(pipe.write, json::object()));
}

}  // namespace
}  // namespace vitrine::graph
