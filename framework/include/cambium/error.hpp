// SPDX-License-Identifier: BSD-3-Clause
// Errors are part of the interface: where, what was found, what was expected, what to do.
#pragma once
#include <stdexcept>
#include <string>

namespace cambium {

/// The value is the process exit code.
enum class ErrorCode { check = 1, config = 2, plugin = 3, data = 4, numeric = 5, cancelled = 130 };

class Error : public std::runtime_error {
 public:
  /// `where` is a path, `file:line` or `file:line:col`; empty when there is none.
  Error(ErrorCode code, std::string where, std::string what)
      : std::runtime_error(where.empty() ? what : where + ": " + what),
        code_(code),
        where_(std::move(where)),
        message_(std::move(what)) {}

  ~Error() override;  // out of line: one type identity for host and plugins

  ErrorCode code() const { return code_; }
  const std::string& where() const { return where_; }
  const std::string& message() const { return message_; }

 private:
  ErrorCode code_;
  std::string where_, message_;
};

/// Thrown by Context::check_cancelled().
class Cancelled : public Error {
 public:
  Cancelled() : Error(ErrorCode::cancelled, "", "cancelled") {}
  ~Cancelled() override;
};

}  // namespace cambium
