// SPDX-License-Identifier: BSD-3-Clause
// A network that makes a descriptor of an image. OpenCV's own headers stay behind this one.
#pragma once
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace learned_bev {

/// The ONNX file that comes with the plugin: 1 x 1 x 32 x 64 in, 1 x 64 out. model/train.py made
/// it.
std::string_view small_network();

/// Runs an ONNX network. One object serves all threads: each borrows a copy of the network.
class Network {
 public:
  /// `where` names the network in messages. Throws Error(data) when OpenCV cannot read it.
  Network(std::string onnx, std::string where);
  ~Network();

  /// The output for a 1 x 1 x rows x cols image, flattened and scaled to unit length; zeros stay
  /// zeros. Throws Error(data) when the network does not take such an image, or gives numbers that
  /// are not finite.
  std::vector<float> run(std::span<const float> image, int rows, int cols) const;

 private:
  struct Copy;
  std::unique_ptr<Copy> borrow() const;

  std::string onnx_, where_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Copy>> idle_;
};

}  // namespace learned_bev
