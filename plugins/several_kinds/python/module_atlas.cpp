// SPDX-License-Identifier: BSD-3-Clause
// Module `_cambium`: missions, loops, islands, truth.
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

#include "arguments.hpp"
#include "arrays.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"
#include "cambium/stems.hpp"
#include "cambium/truth.hpp"

namespace cambium::python {
namespace {

py::array_t<std::int64_t> ids(const Mission& mission) {
  py::array_t<std::int64_t> out(py::ssize_t(mission.nodes.size()));
  for (std::size_t i = 0; i < mission.nodes.size(); ++i)
    out.mutable_data()[i] = mission.nodes[i].id;
  return out;
}

// A node without a stamp has -1, -1.
py::array_t<std::int64_t> stamps(const Mission& mission) {
  py::array_t<std::int64_t> out(std::vector<py::ssize_t>{py::ssize_t(mission.nodes.size()), 2});
  for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
    const auto& stamp = mission.nodes[i].stamp;
    out.mutable_data()[2 * i] = stamp ? stamp->sec : -1;
    out.mutable_data()[2 * i + 1] = stamp ? stamp->nsec : -1;
  }
  return out;
}

std::vector<SE3> own_poses(const Mission& mission) {
  std::vector<SE3> out;
  for (const Node& node : mission.nodes) out.push_back(node.T_mission_node);
  return out;
}

Payload load(const Atlas& atlas, std::uint32_t mission, py::ssize_t node) {
  const std::size_t size = atlas.missions[mission].mission->nodes.size();
  if (node < 0 || std::size_t(node) >= size)
    throw py::index_error("node " + std::to_string(node) + " of a mission with " +
                          std::to_string(size) + " nodes");
  const py::gil_scoped_release unlocked;  // a filter behind it may be another script
  return atlas.payload({mission, std::uint32_t(node)});
}

void bind_mission(py::module_& m) {
  using Lent = const LentMission&;
  py::class_<LentMission>(m, "MissionView", "A mission of an atlas")
      .def("__len__", [](Lent l) { return l.get().size(); })
      .def_property_readonly("name", [](Lent l) { return l.get().mission().name; })
      .def_property_readonly("folder", [](Lent l) { return l.get().mission().folder.string(); })
      .def_property_readonly("platform_id", [](Lent l) { return l.get().mission().platform_id; })
      .def_property_readonly("island", [](Lent l) { return l.get().island(); })
      .def_property_readonly("ids", [](Lent l) { return ids(l.get().mission()); })
      .def_property_readonly("stamps", [](Lent l) { return stamps(l.get().mission()); })
      .def_property_readonly(
          "T_map_node",
          [](Lent l) { return to_array(*l.atlas.get().missions[l.index].T_map_node); })
      .def_property_readonly("T_mission_node",
                             [](Lent l) { return to_array(own_poses(l.get().mission())); })
      .def("payload", [](Lent l, py::ssize_t node) { return load(l.get().atlas, l.index, node); });
}

void bind_loop(py::module_& m) {
  const auto node = [](const NodeRef& n) { return std::make_pair(n.mission, n.node); };
  py::class_<Loop>(m, "Loop", "A pair of nodes, from its proposal to its verdict")
      .def_property_readonly("tail", [node](const Loop& l) { return node(l.tail); })
      .def_property_readonly("head", [node](const Loop& l) { return node(l.head); })
      .def_property_readonly("state", [](const Loop& l) { return to_string(l.state); })
      .def_property_readonly("T_tail_head", [](const Loop& l) { return to_array(l.T_tail_head); })
      .def_property_readonly("information", [](const Loop& l) { return to_array(l.information); })
      .def_property_readonly("scores",
                             [](const Loop& l) {
                               py::dict out;
                               for (const auto& [name, value] : l.scores) out[name.c_str()] = value;
                               return out;
                             })
      .def_readonly("proposed_by", &Loop::proposed_by)
      .def_readonly("registered_by", &Loop::registered_by)
      .def_readonly("decided_by", &Loop::decided_by)
      .def_readonly("reason", &Loop::reason)
      .def_readonly("weight", &Loop::weight);
}

/// (latitude, longitude, altitude, T_map_enu, sigma_position) or None.
py::object georeference_of(const Island& island) {
  if (!island.georeference) return py::none();
  const GeoReference& g = *island.georeference;
  return py::make_tuple(g.latitude, g.longitude, g.altitude, to_array(g.T_map_enu),
                        g.sigma_position);
}

py::list true_poses(const LentAtlas& atlas, const py::object& reference, double max_difference) {
  const std::string folder = reference.is_none() ? "" : py::str(reference).cast<std::string>();
  const Truth truth = read_truth(atlas.get(), folder, max_difference);
  SE3 none;
  none.t.setConstant(std::numeric_limits<double>::quiet_NaN());
  py::list out;
  for (const auto& mission : truth.T_world_node) {
    std::vector<SE3> poses;
    for (const auto& T : mission) poses.push_back(T.value_or(none));
    out.append(to_array(poses));
  }
  return out;
}

/// (n, 3) of latitude, longitude [deg], altitude [m] of points in the map frame.
py::array_t<double> geodetic(const py::tuple& georeference, const py::object& points) {
  const GeoReference g{georeference[0].cast<double>(), georeference[1].cast<double>(),
                       georeference[2].cast<double>(), to_se3(georeference[3], "T_map_enu")};
  auto places = shaped<double>(points, {-1, 3}, "points");
  py::array_t<double> out(std::vector<py::ssize_t>{places.shape(0), 3});
  for (py::ssize_t i = 0; i < places.shape(0); ++i) {
    const Geodetic at = map_to_geodetic(g, Vec3(places.data() + 3 * i));
    const double row[] = {at.latitude, at.longitude, at.altitude};
    std::copy(row, row + 3, out.mutable_data() + 3 * i);
  }
  return out;
}

/// (base (n, 3), axis (n, 3), dbh (n)) of the trees that these missions of one island saw.
py::tuple stems(const LentAtlas& atlas, const std::vector<std::uint32_t>& missions, double radius,
                int min_sightings, const LentContext& context) {
  std::vector<Stem> found;
  {
    const Atlas& all = atlas.get();
    const Context& c = context.get();
    const py::gil_scoped_release unlocked;  // payloads may come from another script
    StemOptions options;
    options.radius = radius;
    options.min_sightings = min_sightings;
    found = stems_of(all, missions, options, c);
  }
  const auto n = py::ssize_t(found.size());
  py::array_t<double> base(std::vector<py::ssize_t>{n, 3}), axis(std::vector<py::ssize_t>{n, 3}),
      dbh(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const Stem& stem = found[std::size_t(i)];
    std::copy_n(stem.base.data(), 3, base.mutable_data() + 3 * i);
    std::copy_n(stem.axis.data(), 3, axis.mutable_data() + 3 * i);
    dbh.mutable_data()[i] = stem.dbh;
  }
  return py::make_tuple(base, axis, dbh);
}

}  // namespace

void bind_atlas(py::module_& m) {
  bind_mission(m);
  bind_loop(m);
  py::class_<LentAtlas>(m, "Atlas", "All missions, and what ties them together")
      .def_property_readonly("missions",
                             [](const LentAtlas& a) {
                               py::list out;
                               for (std::uint32_t i = 0; i < a.get().missions.size(); ++i)
                                 out.append(LentMission{a, i});
                               return out;
                             })
      .def_property_readonly("loops", [](const LentAtlas& a) { return a.get().loops; })
      .def_property_readonly("georeferences", [](const LentAtlas& a) {
        py::list out;  // one an island
        for (const Island& island : a.get().islands) out.append(georeference_of(island));
        return out;
      });
  m.def("read_truth", &true_poses, py::arg("atlas"), py::arg("reference"),
        py::arg("max_time_difference") = 0.01,
        "[mission] of (nodes, 4, 4) T_world_node; NaN where the truth has no pose");
  m.def("map_to_geodetic", &geodetic, py::arg("georeference"), py::arg("points"),
        "(n, 3) of latitude, longitude [deg], altitude above the ellipsoid [m]");
  m.def("stems_of", &stems, py::arg("atlas"), py::arg("missions"), py::arg("radius"),
        py::arg("min_sightings"), py::arg("context"),
        "(base (n, 3), axis (n, 3), dbh (n)) of the trees of missions that share a map frame");
  m.def("travelled", [](const LentMission& mission) {
    const std::vector<double> path = travelled(mission.get().mission());
    return py::array_t<double>(py::ssize_t(path.size()), path.data());
  });
}

}  // namespace cambium::python
