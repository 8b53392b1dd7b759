// SPDX-License-Identifier: Apache-2.0
#include "tools/serve.h"

#include "io/blob.h"
#include "stages/error.h"

#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <optional>
#include <thread>

namespace vitrine::tools {
namespace {

namespace fs = std::filesystem;

struct MimeType {
  std::string_view ending, type;
};
constexpr MimeType kMimeTypes[] = {
    {".html", "text/html; charset=utf-8"},
    {".xhtml", "application/xhtml+xml"},
    {".css", "text/css"},
    {".js", "text/javascript"},
    {".mjs", "text/javascript"},
    {".json", "application/json"},
    {".wasm", "application/wasm"},
    {".glb", "model/gltf-binary"},
    {".jpg", "image/jpeg"},
    {".png", "image/png"},
    {".webp", "image/webp"},
    {".avif", "image/avif"},
    {".svg", "image/svg+xml"},
    {".csv", "text/csv; charset=utf-8"},
    {".txt", "text/plain; charset=utf-8"},
};

std::string mime_type(fs::path const& file) {
  auto const* const known = std::find_if(std::begin(kMimeTypes), std::end(kMimeTypes),
                                         [&](MimeType const& type) { return file.extension() == type.ending; });
  return std::string(known == std::end(kMimeTypes) ? "application/octet-stream" : known->type);
}

bool hidden(fs::path const& path) {
  return std::any_of(path.begin(), path.end(), [](fs::path const& name) { return name.native().starts_with('.'); });
}

/// The regular file that a request's (decoded) path names, if it lies in the canonical folder `root`.
std::optional<fs::path> find(fs::path const& root, std::string const& request) {
  fs::path const asked = fs::path(request).relative_path();
  if (hidden(asked) || request.find('\0') != std::string::npos) return {};
  std::error_code error;
  fs::path const file = fs::canonical(request.ends_with('/') ? root / asked / "index.html" : root / asked, error);
  if (error || !fs::is_regular_file(file, error)) return {};
  fs::path const inside = file.lexically_relative(root);
  return inside.empty() || hidden(inside) ? std::nullopt : std::optional(file);
}

void answer(fs::path const& root, httplib::Request const& request, httplib::Response& response) {
  response.set_header("Cache-Control", "no-cache");
  std::optional<fs::path> const file = find(root, request.path);
  if (!file) {
    response.status = 404;
    return response.set_content("not found\n", "text/plain");
  }
  io::Blob const blob = io::map_file(*file);
  if (blob.bytes.empty()) return response.set_content("", mime_type(*file));
  response.set_content_provider(blob.bytes.size(), mime_type(*file),
                                [blob](std::size_t from, std::size_t length, httplib::DataSink& sink) {
                                  return sink.write(reinterpret_cast<char const*>(blob.bytes.data()) + from, length);
                                });
}

}  // namespace

struct GalleryServer::Impl {
  httplib::Server server;
  int port = 0;
  std::thread thread;
};

GalleryServer::GalleryServer(fs::path const& gallery, std::string const& host, int port)
    : impl_(std::make_unique<Impl>()) {
  std::error_code error;
  fs::path const root = fs::canonical(gallery, error);
  if (error || !fs::is_directory(root))
    throw Error(ErrorKind::invalid_input, "no gallery at " + gallery.string(), "make it with vitrine convert");
  impl_->server.Get(
      ".*", [root](httplib::Request const& request, httplib::Response& response) { answer(root, request, response); });
  // Without the default SO_REUSEPORT, by which two servers would share a port unnoticed.
  impl_->server.set_socket_options([](socket_t socket) {
    int const yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  impl_->port = port == 0 ? impl_->server.bind_to_any_port(host) : impl_->server.bind_to_port(host, port) ? port : -1;
  if (impl_->port < 0)
    throw Error(ErrorKind::invalid_input, "cannot listen on " + host + " port " + std::to_string(port),
                "choose another --port");
  impl_->thread = std::thread([this] { impl_->server.listen_after_bind(); });
  while (!impl_->server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // stop() needs it so
}

GalleryServer::~GalleryServer() {
  impl_->server.stop();
  impl_->thread.join();
}

int GalleryServer::port() const { return impl_->port; }

int serve(fs::path const& gallery, std::string const& host, int port) {
  // Blocked before the server's threads start, so that they inherit it and the signal comes here.
  sigset_t ends, before;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ends, &before);
  {
    GalleryServer const server(gallery, host, port);
    std::cout << "http://" << host << ':' << server.port() << "/  (Ctrl-C ends)" << std::endl;
    int signal = 0;
    sigwait(&ends, &signal);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return 0;
}

}  // namespace vitrine::tools
