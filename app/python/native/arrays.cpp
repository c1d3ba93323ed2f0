#include "app/python/native/arrays.h"

#include <string>

#include "core/base/error.h"

namespace capstan::python {

namespace py = pybind11;

Doubles matrixArray(const Eigen::MatrixXd& matrix) {
  Doubles array({matrix.rows(), matrix.cols()});
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) array.mutable_at(i, j) = matrix(i, j);
  return array;
}

py::object imageArray(cv::Mat image) {
  if (image.empty()) return py::none();
  if (!image.isContinuous()) image = image.clone();
  const std::uint8_t* data = image.data;
  const std::vector<py::ssize_t> shape = {image.rows, image.cols, image.channels()};
  return arrayOf<std::uint8_t, cv::Mat>(std::move(image), data, shape);
}

cv::Mat imageIn(const py::array& pixels, const char* name) {
  const bool bytes = pixels.dtype().kind() == 'u' && pixels.itemsize() == 1;
  if (!bytes || pixels.ndim() != 3 || pixels.shape(2) != 3 || pixels.size() == 0)
    throw base::InputError({{},
                            0,
                            name,
                            py::str("{} {}").format(pixels.attr("shape"), pixels.dtype()),
                            "is no 8-bit colour image",
                            "Give an array of shape (height, width, 3) and type uint8, in the order BGR"});
  const int rows = static_cast<int>(pixels.shape(0)), columns = static_cast<int>(pixels.shape(1));
  const auto* data = static_cast<const std::uint8_t*>(pixels.data());
  const bool shared = pixels.strides(2) == 1 && pixels.strides(1) == 3 && pixels.strides(0) >= 3L * columns;
  if (shared)
    return cv::Mat(rows, columns, CV_8UC3, const_cast<std::uint8_t*>(data),
                   static_cast<std::size_t>(pixels.strides(0)));
  cv::Mat image(rows, columns, CV_8UC3);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (int k = 0; k < 3; ++k)
        image.at<cv::Vec3b>(i, j)[k] = *static_cast<const std::uint8_t*>(pixels.data(i, j, k));
  return image;
}

}  // namespace capstan::python
