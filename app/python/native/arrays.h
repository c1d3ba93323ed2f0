#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <utility>
#include <vector>

namespace capstan::python {

using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Array that owns `owner` and shows its `data`, of the given shape: nothing is copied.
template <class Element, class Owner>
pybind11::array_t<Element> arrayOf(Owner owner, const Element* data, std::vector<pybind11::ssize_t> shape) {
  auto* kept = new Owner(std::move(owner));
  const pybind11::capsule capsule(kept, [](void* old) { delete static_cast<Owner*>(old); });
  return pybind11::array_t<Element>(std::move(shape), data, capsule);
}

/// Array of shape (n,) that owns the vector.
template <class Element>
pybind11::array_t<Element> arrayOf(std::vector<Element> values) {
  const Element* data = values.data();
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  return arrayOf<Element, std::vector<Element>>(std::move(values), data, {size});
}

/// Array of shape (n, columns) that owns the vector, whose rows follow each other.
template <class Element>
pybind11::array_t<Element> rowsOf(std::vector<Element> values, int columns) {
  const Element* data = values.data();
  const auto rows = static_cast<pybind11::ssize_t>(values.size()) / columns;
  return arrayOf<Element, std::vector<Element>>(std::move(values), data, {rows, columns});
}

inline void append(std::vector<double>& rows, const Eigen::Vector3d& row) {
  rows.insert(rows.end(), row.data(), row.data() + 3);
}

/// Copy of a matrix as an array of shape (rows, columns).
Doubles matrixArray(const Eigen::MatrixXd& matrix);

/// 8-bit BGR image as an array of shape (height, width, 3) that shares its pixels; None for an empty image.
pybind11::object imageArray(cv::Mat image);

/// Image that shows the pixels of an array of shape (height, width, 3), type uint8, BGR. The array must
/// outlive it. Other shapes and types throw base::InputError named `name`; rows that are not contiguous are
/// copied.
cv::Mat imageIn(const pybind11::array& pixels, const char* name);

}  // namespace capstan::python
