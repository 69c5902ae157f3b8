// SPDX-License-Identifier: BSD-3-Clause
// Components whose work is done by a class of a Python file. docs/python-plugins.md.
#include "arrays.hpp"
#include "cambium/plugin.hpp"
#include "recordings.hpp"
#include "results.hpp"
#include "script.hpp"

namespace {

using namespace cambium;
using namespace cambium::python;

/// What all kinds have in common.
template <class Base>
class Scripted : public Base {
 public:
  /// `shipped`: as Script has it.
  explicit Scripted(const std::string& shipped = {}) : script_(Base::kind, shipped) {}
  void params(ParamVisitor& v) override { script_.params(v); }
  std::string check_params() const override { return script_.check_params(); }

 protected:
  Script script_;
};

class PythonReader : public Scripted<MissionReader> {
 public:
  using Scripted::Scripted;
  bool accepts(const std::filesystem::path& path) const override {
    if (script_.path().empty()) return false;
    const Gil gil;
    return script_.guarded(
        [&] { return bool(py::bool_(script_.object().attr("accepts")(path.string()))); });
  }
  Mission read(const std::filesystem::path& path, const Context& context) const override {
    return script_.call(context, [&](const py::object& self, const auto&, const py::object& c) {
      return to_mission(self.attr("read")(path.string(), c), path, script_.path());
    });
  }
};

class PythonFilter final : public Scripted<PayloadFilter> {
 public:
  bool uses_neighbours() const override { return script_.flag("uses_neighbours"); }
  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    return script_.call(context,
                        [&](const py::object& self, const auto& loan, const py::object& c) {
                          const LentMission lent{{loan, &mission.atlas}, mission.index};
                          return to_payload(self.attr("apply")(lent, node, c), "apply() returned");
                        });
  }
};

class PythonRecognizer final : public Scripted<PlaceRecognizer> {
 public:
  bool uses_poses() const override { return script_.flag("uses_poses"); }
  bool yaw_invariant() const override { return script_.flag("yaw_invariant"); }
  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    return script_.call(context,
                        [&](const py::object& self, const auto& loan, const py::object& c) {
                          const LentMission lent{{loan, &mission.atlas}, mission.index};
                          return to_fingerprints(self.attr("describe")(lent, c), mission.size());
                        });
  }
  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    return script_.call(context, [&](const py::object& self, const auto&, const py::object& c) {
      return to_candidates(
          self.attr("match")(to_python(query), to_python(reference), to_python(pairing), c));
    });
  }
};

class PythonRegistration final : public Scripted<Registration> {
 public:
  Prepared prepare(const Payload& payload, const Context& context) const override {
    return script_.call(context, [&](const py::object& self, const auto&, const py::object& c) {
      const py::object data = self.attr("prepare")(to_python(payload), c);
      const auto bytes = host().attr("_bytes")(data).cast<std::size_t>();
      return Prepared{payload, keep(data), bytes};
    });
  }
  Alignment align(const Prepared& target, const Prepared& source, const SE3& T_target_source_guess,
                  const Context& context) const override {
    return script_.call(context, [&](const py::object& self, const auto&, const py::object& c) {
      return to_alignment(self.attr("align")(to_python(target), to_python(source),
                                             to_array(T_target_source_guess), c));
    });
  }
};

class PythonExporter : public Scripted<MapExporter> {
 public:
  using Scripted::Scripted;
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    return script_.call(
        context, [&](const py::object& self, const auto& loan, const py::object& c) {
          return to_paths(self.attr("write")(LentAtlas{loan, &atlas}, folder.string(), c));
        });
  }
};

class PythonEvaluator final : public Scripted<Evaluator> {
 public:
  bool needs_truth() const override { return script_.flag("needs_truth"); }
  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const std::string stem = std::filesystem::path(script_.path()).stem().string();
    return script_.call(
        context, [&](const py::object& self, const auto& loan, const py::object& c) {
          const py::object truth =
              reference.empty() ? py::object(py::none()) : py::object(py::str(reference.string()));
          return to_metrics(self.attr("evaluate")(LentAtlas{loan, &atlas}, truth, c),
                            "python." + stem + ".");
        });
  }
};

/// The names are looked at here: Python would start for every mission of any format otherwise.
class RecordingReader final : public PythonReader {
 public:
  RecordingReader() : PythonReader("recording.py:Recording") {}
  bool accepts(const std::filesystem::path& path) const override { return is_recording(path); }
};

class Ros1BagExporter final : public PythonExporter {
 public:
  Ros1BagExporter() : PythonExporter("ros_bags.py:Ros1Bag") {}
};

class Ros2BagExporter final : public PythonExporter {
 public:
  Ros2BagExporter() : PythonExporter("ros_bags.py:Ros2Bag") {}
};

}  // namespace

CAMBIUM_PLUGIN("python", "0.1.0") {
  registry.add<PythonReader>("python", "A Python class that reads missions");
  registry.add<PythonFilter>("python", "A Python class that filters payloads");
  registry.add<PythonRecognizer>("python", "A Python class that recognises places");
  registry.add<PythonRegistration>("python", "A Python class that registers payloads");
  registry.add<PythonExporter>("python", "A Python class that writes maps");
  registry.add<PythonEvaluator>("python", "A Python class that measures maps");
  registry.add<Ros1BagExporter>("ros1_bag", "ROS 1 bag: clouds, paths, loops, stems; and for RViz");
  registry.add<Ros2BagExporter>("ros2_bag", "rosbag2: clouds, paths, loops, stems; and for RViz");
  registry.add<RecordingReader>("recording", "ROS 1 bags, rosbag2 (.db3) and MCAP");
}
