#include <pybind11/stl.h>

#include <array>
#include <mutex>
#include <string>

#include "app/cli/detect_output.h"
#include "app/python/native/arrays.h"
#include "app/python/native/json.h"
#include "app/python/native/module.h"
#include "core/vision/marker_file.h"
#include "core/vision/picture.h"
#include "core/vision/picture_markers.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// An image of a caller: a file, an array, or none.
struct ImageInput {
  std::string file;
  cv::Mat pixels;  ///< shows the array

  ImageInput(const py::object& given, const char* name) {
    if (py::isinstance<py::str>(given))
      file = given.cast<std::string>();
    else if (!given.is_none())
      pixels = imageIn(given.cast<py::array>(), name);
  }
  void read() {
    if (!file.empty()) pixels = vision::readPicture(file);
  }
};

/// Finder of a marker, for one thread at a time.
class Finder {
 public:
  explicit Finder(const std::string& marker)
      : options_(marker.empty() ? vision::MarkerOptions{} : vision::readMarkerFile(marker)),
        markers_(options_) {}

  py::tuple find(const py::object& left, const py::object& right, bool sequence) {
    ImageInput a(left, "left"), b(right, "right");
    std::array<vision::MarkerDetection, 2> found;
    {
      const py::gil_scoped_release unlocked;
      const std::lock_guard alone(mutex_);
      a.read();
      b.read();
      found = sequence ? markers_.inSequence({a.pixels, b.pixels}) : markers_.inFrames({a.pixels, b.pixels});
    }
    return py::make_tuple(toPython(cli::documentOf(found[0])), toPython(cli::documentOf(found[1])));
  }

  py::dict options() const {
    py::dict result;
    vision::MarkerOptions::visit(options_, [&](const auto& value, const base::FieldInfo& info) {
      result[py::str(std::string(info.key))] = value;
    });
    return result;
  }

 private:
  vision::MarkerOptions options_;
  vision::PictureMarkers markers_;
  std::mutex mutex_;
};

}  // namespace

void addDetect(py::module_& module) {
  py::class_<Finder>(module, "Finder")
      .def(py::init<const std::string&>())
      .def("find", &Finder::find)
      .def("options", &Finder::options);
  module.def("read_image", [](const std::string& path) {
    cv::Mat image;
    {
      const py::gil_scoped_release unlocked;
      image = vision::readPicture(path);
    }
    return imageArray(std::move(image));
  });
}

}  // namespace capstan::python
