// SPDX-License-Identifier: BSD-3-Clause
// Numbers between the host and NumPy. Everything here is called under the lock.
#pragma once
#include <pybind11/numpy.h>

#include "cambium/payload.hpp"
#include "interpreter.hpp"

namespace cambium::python {

/// A read-only array of memory that `owner` keeps alive; nothing is copied.
py::array lent(const py::dtype& type, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides, const void* data,
               std::shared_ptr<const void> owner);
/// (n, columns) of contiguous floats; columns 0: (n).
py::array lent(const std::vector<float>& values, py::ssize_t columns,
               std::shared_ptr<const void> owner);

py::array_t<double> to_array(const SE3& T);               ///< 4 x 4
py::array_t<double> to_array(const std::vector<SE3>& T);  ///< (n, 4, 4)
py::array_t<double> to_array(const Mat6& matrix);         ///< 6 x 6

/// Throw std::runtime_error that names `what`, the shape that was found and the one expected.
SE3 to_se3(py::handle array, const std::string& what);
std::vector<SE3> to_poses(py::handle array, const std::string& what);
Mat6 to_mat6(py::handle array, const std::string& what);
Mat3 to_mat3(py::handle array, const std::string& what);
/// A copy of (n, columns), or of (n) when columns is 0.
std::vector<float> to_floats(py::handle array, py::ssize_t columns, const std::string& what);

/// The array as C-contiguous numbers of type T with these extents; -1: any.
template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> shaped(
    py::handle array, const std::vector<py::ssize_t>& shape, const std::string& what);

}  // namespace cambium::python
