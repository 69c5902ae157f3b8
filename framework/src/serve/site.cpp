// SPDX-License-Identifier: BSD-3-Clause
#include "serve/site.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "cambium/error.hpp"
#include "serve/site_path.hpp"

namespace cambium::serve {
namespace {

namespace fs = std::filesystem;

constexpr const char* loopback = "127.0.0.1";

void say(httplib::Response& response, int status, const char* text) {
  response.status = status;
  response.set_content(std::string(text) + "\n", "text/plain; charset=utf-8");
}

/// The file in pieces: a tile may be large, and several are asked for at once.
void send_file(const fs::path& file, httplib::Response& response) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  const auto in = std::make_shared<std::ifstream>(file, std::ios::binary);
  if (error || !*in) return say(response, 404, "there is no such file");
  const char* type = content_type(file);
  response.status = 200;
  if (size == 0) return response.set_content("", type);
  response.set_content_provider(
      size, type, [in](std::size_t at, std::size_t length, httplib::DataSink& sink) {
        std::string piece(std::min<std::size_t>(length, 1 << 20), '\0');
        in->seekg(std::streamoff(at));
        in->read(piece.data(), std::streamsize(piece.size()));
        // False closes the connection: the file became shorter while it was sent.
        return in->gcount() > 0 && sink.write(piece.data(), std::size_t(in->gcount()));
      });
}

/// Another name would be a page of somebody else that lets its own name point here.
bool means_this_machine(const std::string& host, int port) {
  const std::string behind = fmt::format(":{}", port);
  return host == loopback + behind || host == "localhost" + behind;
}

void answer(const fs::path& root, int port, const httplib::Request& request,
            httplib::Response& response) {
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Cache-Control", "no-cache");  // the next export writes the same names
  if (!means_this_machine(request.get_header_value("Host"), port))
    return say(response, 403, "this server answers to 127.0.0.1 and localhost only");
  if (request.method != "GET" && request.method != "HEAD")
    return say(response, 405, "only GET and HEAD");
  const SitePath found = site_path(root, request.path);
  switch (found.answer) {
    case SitePath::Answer::file: return send_file(found.file, response);
    case SitePath::Answer::redirect: return response.set_redirect(request.path + "/", 301);
    case SitePath::Answer::refused: return say(response, 403, "outside of the folder");
    case SitePath::Answer::absent: return say(response, 404, "there is no such file");
  }
}

}  // namespace

struct Site::Server : httplib::Server {};

Site::Site(const fs::path& folder, int port) : server_(std::make_unique<Server>()) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error || !fs::is_directory(root))
    throw Error(ErrorCode::config, folder.string(), "is no folder");
  // The library's own options let two servers share a port, each with half of the requests.
  server_->set_socket_options([](int socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server_->new_task_queue = [] { return new httplib::ThreadPool(12); };
  server_->set_keep_alive_timeout(2);
  server_->set_tcp_nodelay(true);
  port_ = port == 0 ? server_->bind_to_any_port(loopback)
                    : (server_->bind_to_port(loopback, port) ? port : -1);
  if (port_ < 0)
    throw Error(ErrorCode::config, "--port",
                fmt::format("{}:{} is taken; name another port, or 0 for any free one", loopback,
                            port));
  server_->set_pre_routing_handler(
      [root, p = port_](const httplib::Request& request, httplib::Response& response) {
        answer(root, p, request, response);
        return httplib::Server::HandlerResponse::Handled;
      });
}

Site::~Site() = default;

void Site::run(const std::function<bool()>& stop) {
  std::atomic<bool> ended{false};
  std::jthread listener([&] {
    server_->listen_after_bind();
    ended = true;
  });
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(50)); };
  while (!stop() && !ended) wait();
  // Again and again: the library forgets a stop that comes before the listener has begun.
  for (; !ended; wait()) server_->stop();
}

}  // namespace cambium::serve
