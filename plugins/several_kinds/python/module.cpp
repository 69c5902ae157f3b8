// SPDX-License-Identifier: BSD-3-Clause
// Module `_cambium`: payloads and the context. Arrays are views of the host's memory.
#include <pybind11/embed.h>
#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "cambium/digest.hpp"
#include "cambium/files.hpp"

namespace cambium::python {
namespace {

using SharedCloud = std::shared_ptr<const Cloud>;
using SharedTrees = std::shared_ptr<const std::vector<Tree>>;

// pybind11 holds no pointers to const.
struct CloudView {
  SharedCloud cloud;
};
struct TreesView {
  SharedTrees trees;
};

/// Indices from an array of indices, or from a mask with one bool an element.
std::vector<std::size_t> indices(const py::array& which, std::size_t size) {
  std::vector<std::size_t> out;
  if (which.dtype().kind() == 'b') {
    const auto mask = shaped<bool>(which, {py::ssize_t(size)}, "the mask");
    for (std::size_t i = 0; i < size; ++i)
      if (mask.data()[i]) out.push_back(i);
    return out;
  }
  const auto numbers = shaped<std::int64_t>(which, {-1}, "the indices");
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    if (numbers.data()[i] < 0 || std::size_t(numbers.data()[i]) >= size)
      throw py::index_error("index " + std::to_string(numbers.data()[i]) + " of " +
                            std::to_string(size) + " elements");
    out.push_back(std::size_t(numbers.data()[i]));
  }
  return out;
}

CloudView make_cloud(const py::object& points, const py::object& normals,
                     const py::object& intensity, const py::object& label) {
  Cloud cloud;
  cloud.xyz = to_floats(points, 3, "points");
  if (!normals.is_none()) cloud.normals = to_floats(normals, 3, "normals");
  if (!intensity.is_none()) cloud.intensity = to_floats(intensity, 0, "intensity");
  if (!label.is_none()) {
    const auto codes = shaped<std::int64_t>(label, {-1}, "label");
    for (py::ssize_t i = 0; i < codes.size(); ++i) {
      const std::int64_t code = codes.data()[i];
      if (code < 0 || code > 255)
        throw py::value_error("a label is 0 to 255, found " + std::to_string(code));
      cloud.label.push_back(std::uint8_t(code));
    }
  }
  const bool fits = (cloud.normals.empty() || cloud.normals.size() == cloud.xyz.size()) &&
                    (cloud.intensity.empty() || cloud.intensity.size() == cloud.size()) &&
                    (cloud.label.empty() || cloud.label.size() == cloud.size());
  if (!fits)
    throw py::value_error("a cloud has as many normals, intensities and labels as points, or none");
  return {std::make_shared<const Cloud>(std::move(cloud))};
}

py::object optional_view(const std::vector<float>& values, py::ssize_t columns,
                         const SharedCloud& cloud) {
  return values.empty() ? py::object(py::none()) : py::object(lent(values, columns, cloud));
}

void bind_cloud(py::module_& m) {
  py::class_<CloudView>(m, "Cloud", "Points in the base frame of their node [m]")
      .def(py::init(&make_cloud), py::arg("points"), py::arg("normals") = py::none(),
           py::arg("intensity") = py::none(), py::arg("label") = py::none())
      .def("__len__", [](const CloudView& c) { return c.cloud->size(); })
      .def_property_readonly("points",
                             [](const CloudView& c) { return lent(c.cloud->xyz, 3, c.cloud); })
      .def_property_readonly(
          "normals", [](const CloudView& c) { return optional_view(c.cloud->normals, 3, c.cloud); })
      .def_property_readonly(
          "intensity",
          [](const CloudView& c) { return optional_view(c.cloud->intensity, 0, c.cloud); })
      .def_property_readonly("label",
                             [](const CloudView& c) -> py::object {
                               if (c.cloud->label.empty()) return py::none();
                               const auto size = py::ssize_t(c.cloud->label.size());
                               return lent(py::dtype::of<std::uint8_t>(), {size}, {1},
                                           c.cloud->label.data(), c.cloud);
                             })
      .def("select",
           [](const CloudView& c, const py::array& which) {
             return CloudView{
                 std::make_shared<const Cloud>(select(*c.cloud, indices(which, c.cloud->size())))};
           })
      .def("transformed", [](const CloudView& c, const py::object& T_target_source) {
        return CloudView{std::make_shared<const Cloud>(
            transformed(to_se3(T_target_source, "T_target_source"), *c.cloud))};
      });
}

/// A column of the table of trees: every tree is sizeof(Tree) behind the one before.
template <class T>
py::array column(const SharedTrees& trees, const T Tree::*member) {
  const auto size = py::ssize_t(trees->size()), stride = py::ssize_t(sizeof(Tree));
  const Tree none;
  const Tree& first = trees->empty() ? none : trees->front();
  const void* data = trees->empty() ? nullptr : static_cast<const void*>(&(first.*member));
  if constexpr (std::is_same_v<T, Vec3>)
    return lent(py::dtype::of<double>(), {size, 3}, {stride, sizeof(double)}, data, trees);
  else
    return lent(py::dtype::of<T>(), {size}, {stride}, data, trees);
}

TreesView make_trees(const py::object& base, const py::object& axis, const py::object& dbh,
                     const py::object& score, const py::object& reconstructed) {
  const auto bases = shaped<double>(base, {-1, 3}, "base");
  const py::ssize_t n = bases.shape(0);
  const auto axes = shaped<double>(axis, {n, 3}, "axis"), dbhs = shaped<double>(dbh, {n}, "dbh"),
             scores = shaped<double>(score, {n}, "score");
  const auto modelled = shaped<bool>(reconstructed, {n}, "reconstructed");
  std::vector<Tree> trees(static_cast<std::size_t>(n));
  for (py::ssize_t i = 0; i < n; ++i)
    trees[std::size_t(i)] = {Vec3(bases.data() + 3 * i), Vec3(axes.data() + 3 * i), dbhs.data()[i],
                             scores.data()[i], modelled.data()[i]};
  return {std::make_shared<const std::vector<Tree>>(std::move(trees))};
}

void bind_trees(py::module_& m) {
  py::class_<TreesView>(m, "Trees", "Detected trees in the base frame of their node")
      .def(py::init(&make_trees), py::arg("base"), py::arg("axis"), py::arg("dbh"),
           py::arg("score"), py::arg("reconstructed"))
      .def("__len__", [](const TreesView& t) { return t.trees->size(); })
      .def_property_readonly("base",
                             [](const TreesView& t) { return column(t.trees, &Tree::base); })
      .def_property_readonly("axis",
                             [](const TreesView& t) { return column(t.trees, &Tree::axis); })
      .def_property_readonly("dbh", [](const TreesView& t) { return column(t.trees, &Tree::dbh); })
      .def_property_readonly("score",
                             [](const TreesView& t) { return column(t.trees, &Tree::score); })
      .def_property_readonly(
          "reconstructed", [](const TreesView& t) { return column(t.trees, &Tree::reconstructed); })
      .def("select", [](const TreesView& t, const py::array& which) {
        std::vector<Tree> kept;
        for (const std::size_t i : indices(which, t.trees->size())) kept.push_back((*t.trees)[i]);
        return TreesView{std::make_shared<const std::vector<Tree>>(std::move(kept))};
      });
}

Payload make_payload(const py::object& cloud, const py::object& trees) {
  Payload out;
  if (!cloud.is_none()) out.cloud = cloud.cast<CloudView>().cloud;
  if (!trees.is_none()) out.trees = trees.cast<TreesView>().trees;
  return out;
}

// Without the interpreter's lock: the host may wait for other threads.
using Unlocked = py::call_guard<py::gil_scoped_release>;

void bind_context(py::module_& m) {
  using Text = const std::string&;
  const auto log = [](LogLevel level) {
    return [level](const LentContext& c, Text message) { c.get().log(level, message); };
  };
  py::class_<LentContext>(m, "Context")
      .def("debug", log(LogLevel::debug), Unlocked())
      .def("info", log(LogLevel::info), Unlocked())
      .def("warn", log(LogLevel::warning), Unlocked())
      .def("check_cancelled", [](const LentContext& c) { c.get().check_cancelled(); })
      .def(
          "expect", [](const LentContext& c, std::size_t parts) { c.get().expect(parts); },
          Unlocked())
      .def(
          "advance", [](const LentContext& c) { c.get().advance(); }, Unlocked())
      .def_property_readonly("threads", [](const LentContext& c) { return c.get().threads(); })
      .def_property_readonly("seed", [](const LentContext& c) { return c.get().seed(); })
      .def_property_readonly("scratch",
                             [](const LentContext& c) { return c.get().scratch().string(); })
      .def("parallel_for", [](const LentContext& c, std::size_t count, const py::function& body) {
        const Context& context = c.get();
        const py::gil_scoped_release unlocked;
        context.parallel_for(count, [&](std::size_t i) {
          const Gil gil;
          const Speaking speaking(context);
          body(i);
        });
      });
}

}  // namespace

void bind_payloads(py::module_& m) {
  bind_context(m);
  bind_cloud(m);
  bind_trees(m);
  py::class_<Payload>(m, "Payload", "What a node saw; a part that it has not is None")
      .def(py::init(&make_payload), py::arg("cloud") = py::none(), py::arg("trees") = py::none())
      .def_property_readonly(
          "cloud",
          [](const Payload& p) { return p.cloud ? py::cast(CloudView{p.cloud}) : py::none(); })
      .def_property_readonly("trees", [](const Payload& p) {
        return p.trees ? py::cast(TreesView{p.trees}) : py::none();
      });
  m.def("say", &say);
  m.def("digest_file", [](const py::object& path) {
    return digest_file(py::str(path).cast<std::string>()).hex();
  });
  m.def("write_file", [](const py::object& path, const py::object& content) {
    const auto text = content.cast<std::string>();  // of bytes, or of a text as UTF-8
    write_file(py::str(path).cast<std::string>(), text);
  });
}

}  // namespace cambium::python

PYBIND11_EMBEDDED_MODULE(_cambium, m) {
  cambium::python::bind_payloads(m);
  cambium::python::bind_atlas(m);
}
