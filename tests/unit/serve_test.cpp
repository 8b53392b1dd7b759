// SPDX-License-Identifier: Apache-2.0
#include "tools/serve.h"

#include "stages/error.h"
#include "tests/support/folders.h"

#include <gmock/gmock.h>
#include <httplib.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;

class Serve : public testing::Test {
 protected:
  Serve() {
    test::write_file(folder.path() / "secret.txt", "secret");
    test::write_file(gallery / "index.html", "<!doctype html>");
    test::write_file(gallery / "models/cup/thumb.glb", "glTF0123456789");
    test::write_file(gallery / "viewer/draco/decoder.wasm", "wasm");
    test::write_file(gallery / ".vitrine/log.txt", "ours");
    test::write_file(gallery / "empty.json", "");
    fs::create_symlink(folder.path() / "secret.txt", gallery / "link.txt");
    fs::create_directory_symlink(folder.path(), gallery / "up");
    fs::create_symlink("index.html", gallery / "inner.html");
    server.emplace(gallery, "127.0.0.1", 0);
    client.emplace("127.0.0.1", server->port());
  }

  int status(std::string const& path) { return client->Get(path)->status; }

  /// Sends the request line as it stands: clients tidy paths before sending.
  std::string raw(std::string const& path) {
    int const socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(std::uint16_t(server->port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    std::string const request = "GET " + path + " HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n";
    EXPECT_EQ(::send(socket, request.data(), request.size(), 0), ssize_t(request.size()));
    std::string answer;
    char buffer[4096];
    for (ssize_t n; (n = ::recv(socket, buffer, sizeof buffer, 0)) > 0;) answer.append(buffer, std::size_t(n));
    ::close(socket);
    return answer;
  }

  test::TemporaryFolder folder;
  fs::path gallery = folder.path() / "gallery";
  std::optional<GalleryServer> server;
  std::optional<httplib::Client> client;
};

TEST_F(Serve, GivesAFileWithItsTypeAndAsksBrowsersToRevalidate) {
  auto const answer = client->Get("/models/cup/thumb.glb");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->body, "glTF0123456789");
  EXPECT_EQ(answer->get_header_value("Content-Type"), "model/gltf-binary");
  EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-cache");
  EXPECT_EQ(client->Get("/viewer/draco/decoder.wasm")->get_header_value("Content-Type"), "application/wasm");
}

TEST_F(Serve, GivesTheIndexOfAFolder) {
  EXPECT_EQ(client->Get("/")->body, "<!doctype html>");
  EXPECT_EQ(status("/models/"), 404);
  EXPECT_EQ(status("/models"), 404);
}

TEST_F(Serve, GivesEmptyFiles) { EXPECT_EQ(status("/empty.json"), 200); }

TEST_F(Serve, GivesHeadersAlone) {
  auto const answer = client->Head("/models/cup/thumb.glb");
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Length"), "14");
}

TEST_F(Serve, GivesARange) {
  auto const answer = client->Get("/models/cup/thumb.glb", {httplib::make_range_header({{4, 6}})});
  EXPECT_EQ(answer->status, 206);
  EXPECT_EQ(answer->body, "012");
}

TEST_F(Serve, SaysNotFound) { EXPECT_EQ(status("/models/none.glb"), 404); }

TEST_F(Serve, DoesNotWalkUp) {
  for (std::string const path :
       {"/../secret.txt", "/models/../../secret.txt", "/%2e%2e/secret.txt", "/models/%2e%2e/%2e%2e/secret.txt",
        "/..%2fsecret.txt", "//../secret.txt", "/%2e%2e%5csecret.txt"}) {
    std::string const answer = raw(path);
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 404")) << path;
    EXPECT_THAT(answer, testing::Not(testing::HasSubstr("secret"))) << path;
  }
}

TEST_F(Serve, TakesNoAbsolutePath) {
  EXPECT_THAT(raw("/" + (folder.path() / "secret.txt").string()), testing::StartsWith("HTTP/1.1 404"));
}

TEST_F(Serve, FollowsNoLinkOutOfTheGallery) {
  EXPECT_EQ(status("/link.txt"), 404);
  EXPECT_EQ(status("/up/secret.txt"), 404);
  EXPECT_EQ(status("/inner.html"), 200);
}

TEST_F(Serve, HidesNamesWithADot) { EXPECT_EQ(status("/.vitrine/log.txt"), 404); }

TEST_F(Serve, RefusesAPortInUse) { EXPECT_THROW(GalleryServer(gallery, "127.0.0.1", server->port()), Error); }

TEST_F(Serve, RefusesAMissingGallery) { EXPECT_THROW(GalleryServer(gallery / "none", "127.0.0.1", 0), Error); }

TEST(ServeUntilSignal, PrintsItsAddressAndEndsWithZeroOnSigterm) {
  test::TemporaryFolder const folder;
  int pipe_ends[2];
  ASSERT_EQ(::pipe(pipe_ends), 0);
  pid_t const child = ::fork();
  if (child == 0) {
    ::dup2(pipe_ends[1], STDOUT_FILENO);
    std::_Exit(serve(folder.path(), "127.0.0.1", 0));
  }
  ::close(pipe_ends[1]);
  char text[64] = {};
  EXPECT_GT(::read(pipe_ends[0], text, sizeof text - 1), 0);
  EXPECT_THAT(text, testing::StartsWith("http://127.0.0.1:"));
  ::kill(child, SIGTERM);
  int status = -1;
  ::waitpid(child, &status, 0);
  ::close(pipe_ends[0]);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace vitrine::tools
