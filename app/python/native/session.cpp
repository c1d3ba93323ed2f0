#include <pybind11/stl.h>

#include <mutex>
#include <string>
#include <vector>

#include "app/python/native/arrays.h"
#include "app/python/native/module.h"
#include "core/base/error.h"
#include "core/recording/schema.h"
#include "core/recording/session_file.h"
#include "core/recording/session_images.h"
#include "core/recording/session_reader.h"

namespace capstan::python {
namespace {

namespace py = pybind11;
using recording::Database;
using recording::Statement;

/// Numbers of `columns` (indices) of a table in order of arrival, rows one after the other; NULL is NaN. Rows
/// are verified by their check sums; those of images are when their image is read (Images).
std::vector<double> numbersOf(const std::string& path, recording::SampleTable which,
                              const std::vector<int>& columns) {
  Database database = recording::openSession(path);
  try {
    std::vector<double> numbers;
    const recording::Table& table = recording::table(which);
    constexpr const char* kOrder = "ORDER BY seq";
    Statement rows = which == recording::kFrameTable
                         ? Statement(database, recording::selectStatement(table, false) + " " + kOrder)
                         : recording::rowsOf(database, table, kOrder);
    while (rows.step())
      for (const int column : columns) numbers.push_back(rows.real(column));
    return numbers;
  } catch (const recording::SqliteError& error) {
    throw recording::damagedSession(path, error);
  }
}

recording::SampleTable tableNamed(const std::string& name) {
  for (int which = 0; which < recording::kSampleTables; ++which)
    if (recording::table(static_cast<recording::SampleTable>(which)).name == name)
      return static_cast<recording::SampleTable>(which);
  throw base::InputError({{}, 0, "table", name, "is no table of a session", {}});
}

/// A table as {column: array of shape (n,)}; real numbers and integers alike as float64.
py::dict columnsOf(const std::string& path, const std::string& name) {
  const recording::SampleTable which = tableNamed(name);
  std::vector<std::string> names;
  std::vector<int> indices;
  const auto all = recording::table(which).columns;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].type == recording::ColumnType::kReal || all[i].name == "gate" ||
        all[i].name == "camera_updated") {
      names.emplace_back(all[i].name);
      indices.push_back(static_cast<int>(i));
    }
  std::vector<double> numbers;
  {
    const py::gil_scoped_release unlocked;
    numbers = numbersOf(path, which, indices);
  }
  const py::object rows = python::rowsOf(std::move(numbers), static_cast<int>(names.size()));
  py::dict columns;
  for (std::size_t i = 0; i < names.size(); ++i)
    columns[py::str(names[i])] = rows[py::make_tuple(py::slice(py::none(), py::none(), py::none()), i)];
  return columns;
}

py::dict summaryOf(const std::string& path) {
  recording::SessionSummary summary;
  std::vector<recording::SessionEvent> events;
  {
    const py::gil_scoped_release unlocked;
    summary = recording::readSessionSummary(path);
    events = recording::readSessionEvents(path);
  }
  const recording::SessionHeader& header = summary.header;
  py::dict result;
  result["title"] = header.title;
  result["created"] = header.created;
  result["software"] = header.software;
  result["robot"] = header.robot;
  result["camera_left"] = header.camera_left;
  result["camera_right"] = header.camera_right;
  result["truth"] = header.truth;
  result["base_from_camera"] = header.base_from_camera
                                   ? py::object(matrixArray(header.base_from_camera->matrix()))
                                   : py::object(py::none());
  result["reference"] = header.reference && !header.own_kinematics;
  result["own_kinematics"] = header.own_kinematics;
  result["first_t"] = summary.first_t;
  result["last_t"] = summary.last_t;
  result["width"] = summary.width;
  result["height"] = summary.height;
  py::list list;
  for (const recording::SessionEvent& event : events)
    list.append(py::make_tuple(event.t, event.kind, event.text));
  result["events"] = list;
  return result;
}

/// Reads pairs of images by their exact time.
class Images {
 public:
  explicit Images(const std::string& path) : images_(path) {}

  py::tuple at(double t) {
    tracking::StereoFrame frame;
    {
      const py::gil_scoped_release unlocked;
      const std::lock_guard alone(mutex_);
      if (!images_.at(t, 0.0, frame)) frame = {};
    }
    return py::make_tuple(imageArray(std::move(frame.left)), imageArray(std::move(frame.right)));
  }

 private:
  recording::SessionImages images_;
  std::mutex mutex_;
};

}  // namespace

void addSession(py::module_& module) {
  module.def("session_summary", &summaryOf);
  module.def("session_table", &columnsOf);
  py::class_<Images>(module, "Images").def(py::init<const std::string&>()).def("at", &Images::at);
}

}  // namespace capstan::python
