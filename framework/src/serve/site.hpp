// SPDX-License-Identifier: BSD-3-Clause
// A folder as a site for the browser of this machine.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>

namespace cambium::serve {

/// Listens on 127.0.0.1 and nowhere else; answers GET and HEAD with files of the folder.
class Site {
 public:
  /// `port` 0 takes any free one. Throws Error(config) when the port is taken or the folder is none.
  Site(const std::filesystem::path& folder, int port);
  ~Site();
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  int port() const { return port_; }
  /// Serves until `stop()` is true; it is asked several times a second.
  void run(const std::function<bool()>& stop);

 private:
  struct Server;
  std::unique_ptr<Server> server_;
  int port_ = 0;
};

}  // namespace cambium::serve
