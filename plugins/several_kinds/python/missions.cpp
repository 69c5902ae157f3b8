// SPDX-License-Identifier: BSD-3-Clause
// The mission that a script's reader returns.
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "cambium/dialect.hpp"
#include "results.hpp"

namespace cambium::python {
namespace {

class ScriptSource final : public PayloadSource {
 public:
  ScriptSource(const py::handle& source, std::string script)
      : load_(keep(py::object(source.attr("load")))),
        digest_(digest_bytes(source.attr("digest").cast<std::string>())),
        where_(source.attr("where").cast<std::string>()),
        script_(std::move(script)) {}

  Payload load() const override {
    const Gil gil;
    try {
      return to_payload((*load_)(), where_ + ": load() returned");
    } catch (py::error_already_set& e) {
      rethrow(e, script_);
    }
  }
  Digest digest() const override { return digest_; }
  std::string where() const override { return where_; }

 private:
  Kept load_;
  Digest digest_;
  std::string where_, script_;
};

class InMemory final : public PayloadSource {
 public:
  InMemory(Payload payload, std::string where) : payload_(std::move(payload)), where_(where) {
    Hasher hasher;
    const auto add = [&](const std::vector<float>& values) {
      hasher.add({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
    };
    if (payload_.cloud) {
      add(payload_.cloud->xyz), add(payload_.cloud->normals), add(payload_.cloud->intensity);
      const auto& label = payload_.cloud->label;
      hasher.add({reinterpret_cast<const char*>(label.data()), label.size()});
    }
    if (payload_.trees)
      for (const Tree& t : *payload_.trees) {
        for (int i = 0; i < 3; ++i) hasher.add(t.base[i]).add(t.axis[i]);
        hasher.add(t.dbh).add(t.score).add(std::uint64_t(t.reconstructed));
      }
    digest_ = hasher.digest();
  }
  Payload load() const override { return payload_; }
  Digest digest() const override { return digest_; }
  std::string where() const override { return where_; }

 private:
  Payload payload_;
  std::string where_;
  Digest digest_;
};

std::shared_ptr<const PayloadSource> to_source(const py::handle& payload,
                                               const std::string& script) {
  if (payload.is_none()) return nullptr;
  if (py::isinstance<Payload>(payload))
    return std::make_shared<const InMemory>(payload.cast<Payload>(), script);
  if (py::isinstance(payload, host().attr("Source")))
    return std::make_shared<const ScriptSource>(payload, script);
  throw std::runtime_error("read() returned a payload that is neither a Source nor a Payload");
}

std::vector<std::int64_t> whole_numbers(const py::object& values, py::ssize_t nodes,
                                        const std::vector<py::ssize_t>& shape, const char* what) {
  if (values.is_none()) {
    std::vector<std::int64_t> count(static_cast<std::size_t>(nodes));
    for (std::size_t i = 0; i < count.size(); ++i) count[i] = std::int64_t(i);
    return count;
  }
  const auto numbers = shaped<std::int64_t>(values, shape, what);
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<Node> to_nodes(const py::object& returned, const std::string& script) {
  const auto poses = to_poses(returned.attr("T_mission_node"), "Mission.T_mission_node");
  const auto count = py::ssize_t(poses.size());
  const auto ids = whole_numbers(returned.attr("ids"), count, {count}, "Mission.ids");
  const py::object stamps = returned.attr("stamps");
  const auto times = whole_numbers(stamps, count, {count, 2}, "Mission.stamps");
  const py::list payloads(returned.attr("payloads"));
  if (!payloads.empty() && payloads.size() != poses.size())
    throw std::runtime_error("read() returned " + std::to_string(payloads.size()) +
                             " payloads for " + std::to_string(poses.size()) + " nodes");
  std::vector<Node> nodes(poses.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].id = ids[i];
    nodes[i].T_mission_node = poses[i];
    if (!stamps.is_none()) nodes[i].stamp = Stamp{times[2 * i], std::int32_t(times[2 * i + 1])};
    if (!payloads.empty()) nodes[i].payload = to_source(payloads[i], script);
  }
  return nodes;
}

// Without edges of its own, a mission is as stiff as 5 cm and 0.01 rad a step.
std::vector<Edge> odometry(const std::vector<Node>& nodes) {
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    Edge e;
    e.tail = nodes[i - 1].id;
    e.head = nodes[i].id;
    e.T_tail_head = nodes[i - 1].T_mission_node.inverse() * nodes[i].T_mission_node;
    e.information.diagonal() << 400, 400, 400, 1e4, 1e4, 1e4;
    e.tag = "EDGE_SE3:QUAT";
    edges.push_back(std::move(e));
  }
  return edges;
}

std::vector<Edge> to_edges(const py::object& edges, const std::vector<Node>& nodes) {
  if (edges.is_none()) return odometry(nodes);
  std::vector<Edge> out;
  for (const py::handle& edge : py::list(edges)) {
    Edge e;
    e.tail = edge.attr("tail").cast<NodeId>();
    e.head = edge.attr("head").cast<NodeId>();
    e.kind = e.head == e.tail + 1 ? EdgeKind::odometry : EdgeKind::loop;
    e.T_tail_head = to_se3(edge.attr("T_tail_head"), "Edge.T_tail_head");
    e.information = to_mat6(edge.attr("information"), "Edge.information");
    e.tag = "EDGE_SE3:QUAT";
    out.push_back(std::move(e));
  }
  return out;
}

GnssFix to_fix(const py::handle& fix) {
  return {{fix.attr("sec").cast<std::int64_t>(), fix.attr("nsec").cast<std::int32_t>()},
          fix.attr("latitude").cast<double>(),
          fix.attr("longitude").cast<double>(),
          fix.attr("altitude").cast<double>(),
          to_mat3(fix.attr("covariance"), "Fix.covariance")};
}

}  // namespace

Mission to_mission(const py::object& returned, const std::filesystem::path& path,
                   const std::string& script) {
  if (!py::isinstance(returned, host().attr("Mission")))
    throw std::runtime_error("read() returned a " +
                             py::str(py::type::handle_of(returned)).cast<std::string>() +
                             "; expected a Mission");
  Mission out;
  out.name = py::str(returned.attr("name")).cast<std::string>();
  out.folder = std::filesystem::is_directory(path) ? path : path.parent_path();
  out.graph_file = path;
  out.platform_id = returned.attr("platform_id").cast<int>();
  out.nodes = to_nodes(returned, script);
  out.edges = to_edges(returned.attr("edges"), out.nodes);
  for (const py::handle& fix : py::list(returned.attr("fixes"))) out.fixes.push_back(to_fix(fix));
  out.warnings = returned.attr("warnings").cast<std::vector<std::string>>();
  out.digest = mission_digest(out);
  return out;
}

}  // namespace cambium::python
