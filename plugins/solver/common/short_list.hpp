// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>

namespace cambium::pose_solver {

/// Items for a warning: the first five, and how many more there are. A file with ten thousand bad
/// lines gives one warning.
class ShortList {
 public:
  void add(const std::string& item) {
    if (count_++ < named) text_ += "\n  " + item;
  }
  std::size_t count() const { return count_; }
  std::string text() const {
    return count_ > named ? text_ + "\n  and " + std::to_string(count_ - named) + " more" : text_;
  }

 private:
  static constexpr std::size_t named = 5;
  std::size_t count_ = 0;
  std::string text_;
};

}  // namespace cambium::pose_solver
