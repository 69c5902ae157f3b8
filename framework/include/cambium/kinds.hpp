// SPDX-License-Identifier: BSD-3-Clause
// The kinds of component that a plugin can provide. One instance serves all threads, so every
// method is const; "did not converge" is a value, not an exception.
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"
#include "cambium/error.hpp"
#include "cambium/params.hpp"
#include "cambium/pose_graph.hpp"

namespace cambium {

enum class Kind {
  mission_reader, payload_filter, place_recognizer, registration, loop_verifier,
  solver, gnss_aligner, map_exporter, evaluator
};
const char* to_string(Kind kind);

class Component {
 public:
  virtual ~Component();
  virtual void params(ParamVisitor&) {}
  /// Called once after binding. Return what is wrong between parameters ("inner must be below
  /// outer"), or an empty string.
  virtual std::string check_params() const { return {}; }
};

class MissionReader : public Component {
 public:
  static constexpr Kind kind = Kind::mission_reader;
  /// Whether the path looks like what this reader reads; asked when a pipeline names no reader.
  virtual bool accepts(const std::filesystem::path& path) const = 0;
  /// Throws Error(data); what a user should know but can live with goes to Mission::warnings.
  virtual Mission read(const std::filesystem::path& path, const Context& context) const = 0;
};

class PayloadFilter : public Component {
 public:
  static constexpr Kind kind = Kind::payload_filter;
  /// True: apply() looks at other nodes than its own, or at poses. The cache must know.
  virtual bool uses_neighbours() const { return false; }
  /// The new payload of `node`; start from `mission.payload(node)`.
  virtual Payload apply(const MissionView& mission, std::size_t node,
                        const Context& context) const = 0;
};

/// What a recogniser remembers of a mission. Opaque to the engine, which stores and hashes it.
struct Fingerprints {
  std::size_t rows = 0, cols = 0;
  std::vector<float> table;      ///< rows x cols, row by row; what most recognisers need
  std::vector<std::byte> extra;  ///< anything else
  std::span<const float> row(std::size_t i) const { return {table.data() + i * cols, cols}; }
};

/// Which pairs of nodes may be proposed. Within a mission, neighbours along the path may not.
struct Pairing {
  bool within_mission = false;
  double min_path = 0;                    ///< [m] along the path, only within a mission
  std::vector<double> query_path;         ///< distance travelled at each node [m]
  std::vector<double> reference_path;
  bool allowed(std::size_t query, std::size_t reference) const {
    return !within_mission || query_path[query] - reference_path[reference] >= min_path;
  }
};

struct Candidate {
  std::size_t query = 0, reference = 0;    ///< node indices
  double score = 0;                        ///< higher is better; only compared within a plugin
  std::optional<SE3> T_reference_query;    ///< a first guess, if the recogniser has one
};

class PlaceRecognizer : public Component {
 public:
  static constexpr Kind kind = Kind::place_recognizer;
  /// True: describe() reads T_map_node, so a changed pose means a new description.
  virtual bool uses_poses() const { return false; }
  /// True: match() proposes the same pairs when a query is turned about its vertical axis.
  virtual bool yaw_invariant() const { return false; }
  virtual Fingerprints describe(const MissionView& mission, const Context& context) const = 0;
  /// Within a mission `query` and `reference` are the same object; respect `pairing.allowed`.
  virtual std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                                       const Pairing& pairing, const Context& context) const = 0;
};

/// A payload with what a registration computed from it once, for use in many pairs.
struct Prepared {
  Payload payload;
  std::shared_ptr<const void> data;  ///< the registration's own, e.g. a search tree
  std::size_t bytes = 0;             ///< of data, for the memory budget
};

struct Alignment {
  bool converged = false;
  SE3 T_target_source;
  Mat6 information = Mat6::Identity();  ///< of (translation [m]; rotation [rad])
  std::vector<Score> scores;            ///< "overlap" 0..1 and "rmse" [m] where they make sense
  std::string reason;                   ///< why it did not converge
};

class Registration : public Component {
 public:
  static constexpr Kind kind = Kind::registration;
  virtual Prepared prepare(const Payload& payload, const Context&) const { return {payload, {}, 0}; }
  virtual Alignment align(const Prepared& target, const Prepared& source,
                          const SE3& T_target_source_guess, const Context& context) const = 0;
};

struct Verdict {
  bool accepted = false;
  std::string reason;
};

class LoopVerifier : public Component {
 public:
  static constexpr Kind kind = Kind::loop_verifier;
  /// One verdict for each index in `loops` (into atlas.loops), in that order. The verdicts do not
  /// depend on the order of the loops.
  virtual std::vector<Verdict> verify(const Atlas& atlas, std::span<const std::size_t> loops,
                                      const Context& context) const = 0;
};

class Solver : public Component {
 public:
  static constexpr Kind kind = Kind::solver;
  /// Never raises the cost above that of the initial estimate; throws Error(numeric) naming the
  /// factor when the graph cannot be solved.
  virtual Solution solve(const PoseGraph& graph, const Context& context) const = 0;
};

/// A georeference, or the reason why there is none.
struct GnssAlignment {
  std::optional<GeoReference> georeference;
  std::string reason;
  std::vector<Score> scores;
  /// With a georeference: position factors for the optimisations that follow, at most one a node.
  std::vector<NodePosition> positions = {};
};

class GnssAligner : public Component {
 public:
  static constexpr Kind kind = Kind::gnss_aligner;
  virtual GnssAlignment align(const Atlas& atlas, const Island& island,
                              const Context& context) const = 0;
};

class MapExporter : public Component {
 public:
  static constexpr Kind kind = Kind::map_exporter;
  /// Writes below `folder` (it exists) and returns the files written.
  virtual std::vector<std::filesystem::path> write(const Atlas& atlas,
                                                   const std::filesystem::path& folder,
                                                   const Context& context) const = 0;
  /// The file below the folder that a browser opens first ("index.html") when the export is a page;
  /// empty: it is none. `cambium view` looks for exporters that make one.
  virtual std::string start_page() const { return {}; }
};

enum class Better { lower, higher, neither };

struct Metric {
  std::string name;  ///< dotted: "ate.rmse", "ate.mission_b.rmse"
  double value = 0;
  std::string unit;
  Better better = Better::neither;
};

class Evaluator : public Component {
 public:
  static constexpr Kind kind = Kind::evaluator;
  /// False: it can say something without ground truth. The others are skipped, with a warning, when
  /// neither the pipeline nor any mission has a truth.
  virtual bool needs_truth() const { return true; }
  /// `reference` is a folder with the truth; empty: every mission brings its own in its folder.
  virtual std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                                       const Context& context) const = 0;
};

}  // namespace cambium
