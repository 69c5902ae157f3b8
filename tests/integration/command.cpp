// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <cmath>
#include <optional>

#include "cambium/files.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

// A disk is full for the child when a file would grow beyond the limit: EFBIG in place of ENOSPC.
void limit_files(std::size_t bytes) {
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, SIG_IGN);
}

pid_t start(std::vector<std::string> arguments, const std::filesystem::path& out,
            const std::filesystem::path& err, std::optional<std::size_t> largest_file = {}) {
  arguments.insert(arguments.begin(), built("bin/cambium").string());
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  // Opened before the fork: a child may be killed before its first line, and both are read then.
  const int out_file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const pid_t child = ::fork();
  if (child != 0) {
    ::close(out_file), ::close(err_file);
    return child;
  }
  ::dup2(out_file, 1), ::dup2(err_file, 2);
  ::setenv("CAMBIUM_CACHE", (out.parent_path() / "cache").c_str(), 1);
  if (largest_file) limit_files(*largest_file);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

Outcome finish(pid_t child, const std::filesystem::path& out, const std::filesystem::path& err) {
  int status = 0;
  ::waitpid(child, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_file(out), read_file(err)};
}

}  // namespace

Outcome run_cambium(const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  return finish(start(arguments, folder / "out", folder / "err"), folder / "out", folder / "err");
}

Outcome run_cambium_on_full_disk(const std::vector<std::string>& arguments,
                                 std::size_t largest_file) {
  const TemporaryFolder folder;
  return finish(start(arguments, folder / "out", folder / "err", largest_file), folder / "out",
                folder / "err");
}

Outcome run_cambium_interrupted(const std::vector<std::string>& arguments,
                                const std::function<void()>& moment, int signal) {
  const TemporaryFolder folder;
  const pid_t child = start(arguments, folder / "out", folder / "err");
  moment();
  ::kill(child, signal);
  return finish(child, folder / "out", folder / "err");
}

nlohmann::json read_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(read_file(path));
}

double metric(const nlohmann::json& report, const std::string& name) {
  for (const auto& m : report["metrics"])
    if (m["name"] == name) return m["value"];
  ADD_FAILURE() << "no metric " << name << " in " << report["metrics"].dump(1);
  return std::nan("");
}

std::string pipeline(const std::string& name) { return source("pipelines/" + name).string(); }

}  // namespace cambium::testing
