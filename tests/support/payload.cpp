// SPDX-License-Identifier: BSD-3-Clause
#include "support/support.hpp"

namespace cambium::testing {
namespace {

class InMemory final : public PayloadSource {
 public:
  explicit InMemory(Payload payload) : payload_(std::move(payload)) {}
  Payload load() const override { return payload_; }
  std::string where() const override { return "memory"; }

  Digest digest() const override {
    Hasher hasher;
    if (payload_.cloud) {
      for (const auto* values :
           {&payload_.cloud->xyz, &payload_.cloud->normals, &payload_.cloud->intensity})
        hasher.add(std::string_view(reinterpret_cast<const char*>(values->data()),
                                    values->size() * sizeof(float)));
      hasher.add(std::string_view(reinterpret_cast<const char*>(payload_.cloud->label.data()),
                                  payload_.cloud->label.size()));
    }
    if (payload_.trees)
      for (const Tree& tree : *payload_.trees) {
        for (int k = 0; k < 3; ++k) hasher.add(tree.base[k]).add(tree.axis[k]);
        hasher.add(tree.dbh).add(tree.score).add(std::uint64_t(tree.reconstructed));
      }
    if (payload_.images)
      for (const Image& image : *payload_.images) hasher.add(image.file.string());
    return hasher.digest();
  }

 private:
  Payload payload_;
};

}  // namespace

std::shared_ptr<const PayloadSource> in_memory(Payload payload) {
  return std::make_shared<InMemory>(std::move(payload));
}

std::shared_ptr<const PayloadSource> in_memory(Cloud cloud) {
  return in_memory(Payload{std::make_shared<const Cloud>(std::move(cloud)), nullptr});
}

}  // namespace cambium::testing
