// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"

#include <limits>

namespace cambium::python {
namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
template <int N>
using Rows = Eigen::Matrix<double, N, N, Eigen::RowMajor | Eigen::DontAlign>;

std::string text(const std::vector<py::ssize_t>& shape) {
  std::string out = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    out += (i > 0 ? ", " : "") + (shape[i] < 0 ? std::string("n") : std::to_string(shape[i]));
  return out + ")";
}

// A pose that is not finite is for the host to refuse; a singular value decomposition would hide
// it.
SE3 pose(const double* numbers) {
  const Rows<4> T = Eigen::Map<const Rows<4>>(numbers);
  if (T.allFinite()) return SE3::from_matrix(T);
  SE3 out;
  out.t.setConstant(std::numeric_limits<double>::quiet_NaN());
  return out;
}

}  // namespace

py::array lent(const py::dtype& type, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides, const void* data,
               std::shared_ptr<const void> owner) {
  const py::capsule base(new std::shared_ptr<const void>(std::move(owner)),
                         [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  py::array out(type, std::move(shape), std::move(strides), data, base);
  out.attr("flags").attr("writeable") = false;
  return out;
}

py::array lent(const std::vector<float>& values, py::ssize_t columns,
               std::shared_ptr<const void> owner) {
  const py::ssize_t one = sizeof(float), count = py::ssize_t(values.size());
  const auto type = py::dtype::of<float>();
  if (columns == 0) return lent(type, {count}, {one}, values.data(), std::move(owner));
  return lent(type, {count / columns, columns}, {one * columns, one}, values.data(),
              std::move(owner));
}

py::array_t<double> to_array(const SE3& T) {
  py::array_t<double> out({4, 4});
  Eigen::Map<Rows<4>>(out.mutable_data()) = T.matrix();
  return out;
}

py::array_t<double> to_array(const std::vector<SE3>& T) {
  py::array_t<double> out(std::vector<py::ssize_t>{py::ssize_t(T.size()), 4, 4});
  for (std::size_t i = 0; i < T.size(); ++i)
    Eigen::Map<Rows<4>>(out.mutable_data() + 16 * i) = T[i].matrix();
  return out;
}

py::array_t<double> to_array(const Mat6& matrix) {
  py::array_t<double> out({6, 6});
  Eigen::Map<Rows<6>>(out.mutable_data()) = matrix;
  return out;
}

template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> shaped(
    py::handle object, const std::vector<py::ssize_t>& shape, const std::string& what) {
  using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;
  const Array array = Array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw std::runtime_error(what + ": expected an array of shape " + text(shape) + ", found " +
                             py::str(py::type::handle_of(object)).cast<std::string>());
  }
  const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
  bool fits = found.size() == shape.size();
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = shape[i] < 0 || shape[i] == found[i];
  if (!fits)
    throw std::runtime_error(what + ": expected an array of shape " + text(shape) +
                             ", found one of " + text(found));
  return array;
}
template py::array_t<float, 17> shaped(py::handle, const std::vector<py::ssize_t>&,
                                       const std::string&);
template py::array_t<double, 17> shaped(py::handle, const std::vector<py::ssize_t>&,
                                        const std::string&);
template py::array_t<bool, 17> shaped(py::handle, const std::vector<py::ssize_t>&,
                                      const std::string&);
template py::array_t<std::int64_t, 17> shaped(py::handle, const std::vector<py::ssize_t>&,
                                              const std::string&);
static_assert((py::array::c_style | py::array::forcecast) == 17);

SE3 to_se3(py::handle array, const std::string& what) {
  return pose(shaped<double>(array, {4, 4}, what).data());
}

std::vector<SE3> to_poses(py::handle array, const std::string& what) {
  const Doubles numbers = shaped<double>(array, {-1, 4, 4}, what);
  std::vector<SE3> out;
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i) out.push_back(pose(numbers.data() + 16 * i));
  return out;
}

Mat6 to_mat6(py::handle array, const std::string& what) {
  return Eigen::Map<const Rows<6>>(shaped<double>(array, {6, 6}, what).data());
}

Mat3 to_mat3(py::handle array, const std::string& what) {
  return Eigen::Map<const Rows<3>>(shaped<double>(array, {3, 3}, what).data());
}

std::vector<float> to_floats(py::handle array, py::ssize_t columns, const std::string& what) {
  const auto shape =
      columns == 0 ? std::vector<py::ssize_t>{-1} : std::vector<py::ssize_t>{-1, columns};
  const auto numbers = shaped<float>(array, shape, what);
  return {numbers.data(), numbers.data() + numbers.size()};
}

}  // namespace cambium::python
