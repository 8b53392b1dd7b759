// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Looks at a gallery on this machine: browsers load no modules from file://.

#include <filesystem>
#include <memory>
#include <string>

namespace vitrine::tools {

/// Serves the files below a folder over HTTP while it lives: GET and HEAD, ranges, no listing. Names beginning with a
/// dot, and whatever lies outside the folder once symbolic links are followed, do not exist for it.
class GalleryServer {
 public:
  /// port 0: any free one. Errors: InvalidInput when there is no such folder, or host and port cannot be listened on.
  GalleryServer(std::filesystem::path const& gallery, std::string const& host, int port);
  ~GalleryServer();
  int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Prints the address and serves until SIGINT or SIGTERM. Returns 0. Errors: as above.
int serve(std::filesystem::path const& gallery, std::string const& host, int port);

}  // namespace vitrine::tools
