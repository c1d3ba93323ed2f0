#pragma once

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/experiments/results.h"

/// Series of points as columns of numbers, for JSON and CSV alike: each series declares its columns once.
namespace capstan::experiments {

/// Column of one number of a Point: a scalar, one axis of a vector, or a flag.
template <class Point>
struct SeriesColumn {
  std::string name;
  double Point::*scalar = nullptr;
  Eigen::Vector3d Point::*vector = nullptr;
  int axis = 0;
  bool Point::*flag = nullptr;

  double get(const Point& point) const {
    if (scalar) return point.*scalar;
    return vector ? (point.*vector)(axis) : static_cast<double>(point.*flag);
  }
  void set(Point& point, double value) const {
    if (scalar)
      point.*scalar = value;
    else if (vector)
      (point.*vector)(axis) = value;
    else
      point.*flag = value != 0.0;
  }
};

template <class Point>
class SeriesColumns {
 public:
  SeriesColumns& scalar(const std::string& name, double Point::*member) {
    columns_.push_back({.name = name, .scalar = member});
    return *this;
  }
  SeriesColumns& joints(const std::string& name, Eigen::Vector3d Point::*member) {
    for (int axis = 0; axis < 3; ++axis)
      columns_.push_back({.name = name + "_" + std::to_string(axis + 1), .vector = member, .axis = axis});
    return *this;
  }
  SeriesColumns& flag(const std::string& name, bool Point::*member) {
    columns_.push_back({.name = name, .flag = member});
    return *this;
  }
  const std::vector<SeriesColumn<Point>>& all() const { return columns_; }

 private:
  std::vector<SeriesColumn<Point>> columns_;
};

inline SeriesColumns<TrajectoryPoint> columnsOf(const TrajectoryPoint*) {
  using P = TrajectoryPoint;
  return SeriesColumns<P>()
      .scalar("t", &P::t)
      .joints("q_true", &P::q_true)
      .joints("q_kin", &P::q_kin)
      .joints("q_cam", &P::q_cam)
      .joints("q_ukf", &P::q_ukf)
      .joints("sigma", &P::sigma)
      .flag("occluded", &P::occluded);
}

inline SeriesColumns<ErrorPoint> columnsOf(const ErrorPoint*) {
  using P = ErrorPoint;
  return SeriesColumns<P>()
      .scalar("t", &P::t)
      .joints("kinematic", &P::kinematic)
      .joints("identified", &P::identified)
      .joints("ukf", &P::ukf)
      .flag("occluded", &P::occluded);
}

inline SeriesColumns<CameraPoint> columnsOf(const CameraPoint*) {
  using P = CameraPoint;
  return SeriesColumns<P>().scalar("t", &P::t).joints("q", &P::q).joints("error", &P::error);
}

/// CSV of `points`: a header line of names, then one line per point; an empty cell where a number is not
/// finite.
template <class Point>
std::string csvOfSeries(const std::vector<Point>& points) {
  const auto columns = columnsOf(static_cast<const Point*>(nullptr));
  std::string text;
  for (const auto& column : columns.all()) text += (text.empty() ? "" : ",") + column.name;
  text += '\n';
  for (const Point& point : points) {
    bool first = true;
    for (const auto& column : columns.all()) {
      if (!first) text += ',';
      first = false;
      const double value = column.get(point);
      if (std::isfinite(value)) text += fmt::format("{}", value);
    }
    text += '\n';
  }
  return text;
}

/// JSON of `points`: {"t": […], "q_true_1": […], …}; NaN becomes null.
template <class Point>
nlohmann::json jsonOfSeries(const std::vector<Point>& points) {
  nlohmann::json document = nlohmann::json::object();
  const auto columns = columnsOf(static_cast<const Point*>(nullptr));
  for (const auto& column : columns.all()) {
    nlohmann::json values = nlohmann::json::array();
    for (const Point& point : points) values.push_back(column.get(point));
    document[column.name] = std::move(values);
  }
  return document;
}

/// Points of a JSON document. Throws nlohmann::json::exception when a column is missing, too short or not
/// numeric.
template <class Point>
std::vector<Point> seriesOfJson(const nlohmann::json& document) {
  const auto columns = columnsOf(static_cast<const Point*>(nullptr));
  std::vector<Point> points(document.at(columns.all().front().name).size());
  for (const auto& column : columns.all()) {
    const nlohmann::json& values = document.at(column.name);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const nlohmann::json& value = values.at(i);
      column.set(points[i], value.is_null() ? kNone : value.get<double>());
    }
  }
  return points;
}

}  // namespace capstan::experiments
