// SPDX-License-Identifier: BSD-3-Clause
// The binary form of results in the cache: every type lists its fields once, for both directions.
#pragma once
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cambium/error.hpp"
#include "cambium/kinds.hpp"

namespace cambium {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::byte>;

class Encoder {
 public:
  std::string bytes;

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  void raw(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }
  template <Plain T>
  void put(const T& v) {
    raw(&v, sizeof v);
  }
  void put(const std::string& v) { put(std::uint64_t(v.size())), raw(v.data(), v.size()); }
  template <class T>
  void put(const std::vector<T>& v) {
    put(std::uint64_t(v.size()));
    if constexpr (Plain<T> && !std::is_same_v<T, bool>)
      raw(v.data(), v.size() * sizeof(T));
    else
      for (const T& e : v) put(e);
  }
  template <class T>
  void put(const std::optional<T>& v) {
    put(v.has_value());
    if (v) put(*v);
  }
  template <class A, class B>
  void put(const std::pair<A, B>& v) {
    put(v.first), put(v.second);
  }
  template <class S, int R, int C, int O>
  void put(const Eigen::Matrix<S, R, C, O>& v) {
    raw(v.data(), std::size_t(v.size()) * sizeof(S));
  }
  void put(const Quat& v) { raw(v.coeffs().data(), 4 * sizeof(double)); }
  template <class T>
  requires std::is_class_v<T>
  void put(const T& v) { fields(*this, const_cast<T&>(v)); }  // fields() only reads when encoding
};

class Decoder {
 public:
  explicit Decoder(const std::string& bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }

 private:
  void raw(void* data, std::size_t size) {
    if (size > bytes_.size() - at_)
      throw Error(ErrorCode::data, "cache",
                  "an entry ends early; was it written by another build?");
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }
  std::size_t length() {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > bytes_.size()) throw Error(ErrorCode::data, "cache", "an entry has a wrong length");
    return n;
  }
  template <Plain T>
  void get(T& v) {
    raw(&v, sizeof v);
  }
  void get(std::string& v) { v.resize(length()), raw(v.data(), v.size()); }
  template <class T>
  void get(std::vector<T>& v) {
    v.resize(length());
    if constexpr (Plain<T> && !std::is_same_v<T, bool>)
      raw(v.data(), v.size() * sizeof(T));
    else
      for (T& e : v) get(e);
  }
  template <class T>
  void get(std::optional<T>& v) {
    bool has = false;
    get(has);
    if (has) get(v.emplace());
  }
  template <class A, class B>
  void get(std::pair<A, B>& v) {
    get(v.first), get(v.second);
  }
  template <class S, int R, int C, int O>
  void get(Eigen::Matrix<S, R, C, O>& v) {
    raw(v.data(), std::size_t(v.size()) * sizeof(S));
  }
  void get(Quat& v) { raw(v.coeffs().data(), 4 * sizeof(double)); }
  template <class T>
  requires std::is_class_v<T>
  void get(T& v) { fields(*this, v); }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class A>
void fields(A& a, Digest& x) {
  a(x.high, x.low);
}
template <class A>
void fields(A& a, SE3& x) {
  a(x.q, x.t);
}
template <class A>
void fields(A& a, Fingerprints& x) {
  a(x.rows, x.cols, x.table, x.extra);
}
template <class A>
void fields(A& a, Candidate& x) {
  a(x.query, x.reference, x.score, x.T_reference_query);
}
template <class A>
void fields(A& a, Alignment& x) {
  a(x.converged, x.T_target_source, x.information, x.scores, x.reason);
}
template <class A>
void fields(A& a, Verdict& x) {
  a(x.accepted, x.reason);
}
template <class A>
void fields(A& a, Solution& x) {
  a(x.T_map_node, x.weight, x.iterations, x.converged, x.message, x.scores, x.marginals);
}
template <class A>
void fields(A& a, GeoReference& x) {
  a(x.latitude, x.longitude, x.altitude, x.T_map_enu, x.sigma_yaw, x.sigma_position);
}
template <class A>
void fields(A& a, NodeRef& x) {
  a(x.mission, x.node);
}
template <class A>
void fields(A& a, NodePosition& x) {
  a(x.node, x.t_map, x.information);
}
template <class A>
void fields(A& a, GnssAlignment& x) {
  a(x.georeference, x.reason, x.scores, x.positions);
}
template <class A>
void fields(A& a, Metric& x) {
  a(x.name, x.value, x.unit, x.better);
}
template <class A>
void fields(A& a, Loop& x) {
  a(x.tail, x.head, x.state, x.has_guess, x.T_tail_head, x.information, x.scores, x.proposed_by,
    x.registered_by, x.decided_by, x.reason, x.weight, x.residual);
}

template <class T>
std::string encode(const T& value) {
  Encoder encoder;
  encoder(value);
  return std::move(encoder.bytes);
}

template <class T>
T decode(const std::string& bytes) {
  T value{};
  Decoder decoder(bytes);
  decoder(value);
  return value;
}

}  // namespace cambium
