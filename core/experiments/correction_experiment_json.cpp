#include "core/experiments/correction_experiment.h"

namespace capstan::experiments {
namespace {

using nlohmann::json;

json errorsJson(const learning::CorrectionErrors& errors) {
  const auto six = [](const learning::Vector6d& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return {{"states", errors.states},
          {"axes", {{"mean", six(errors.mean)}, {"deviation", six(errors.deviation)}}},
          {"distance", {{"mean", errors.distance}, {"median", errors.median_distance}}},
          {"angle", {{"mean", errors.angle}, {"median", errors.median_angle}}}};
}

json jsonOf(const learning::CorrectionStudyReport& report) {
  json document;
  for (std::size_t m = 0; m < learning::kCorrectionMethods; ++m) {
    const std::string key(base::keyOf(static_cast<learning::CorrectionMethod>(m)));
    document["clean"][key] = errorsJson(report.clean[m]);
    document["all"][key] = errorsJson(report.dirty[m]);
  }
  return document;
}

json jsonOf(const learning::LearningCurve& curve) {
  json points = json::array();
  for (const learning::LearningCurvePoint& point : curve.points)
    points.push_back(
        {{"share", point.share}, {"states", point.states}, {"errors", errorsJson(point.errors)}});
  return {
      {"points", std::move(points)}, {"offset", errorsJson(curve.offset)}, {"none", errorsJson(curve.none)}};
}

json summaryJson(const DebridementSummary& summary) {
  return {{"fragments", summary.fragments},
          {"grasped", summary.grasped},
          {"cleared", summary.cleared},
          {"refused", summary.refused},
          {"time",
           {{"mean", summary.time},
            {"low95", summary.time_interval.low},
            {"high95", summary.time_interval.high}}},
          {"moving", summary.moving},
          {"camera_checks", summary.observations},
          {"grasp_error", summary.off},
          {"success", {{"low95", summary.success.low}, {"high95", summary.success.high}}}};
}

json jsonOf(const DebridementStudyReport& report) {
  json document;
  document["training"] = {{"motions", report.motions},   {"poses", report.rows},
                          {"rejected", report.screened}, {"states", report.states},
                          {"kept", report.kept},         {"clock_offset", report.clock_offset}};
  for (std::size_t m = 0; m < report.arrival.size(); ++m) {
    const ArrivalErrors& mode = report.arrival[m];
    if (mode.arrived == 0) continue;
    document["arrival"][std::string(base::keyOf(static_cast<learning::CorrectionMode>(m)))] = {
        {"arrivals", mode.arrived},
        {"mean", std::vector<double>(mode.mean.begin(), mode.mean.end())},
        {"repeatability", std::vector<double>(mode.repeatability.begin(), mode.repeatability.end())},
        {"distance", {{"mean", mode.distance}, {"deviation", mode.distance_deviation}}},
        {"angle", {{"mean", mode.angle}, {"deviation", mode.angle_deviation}}},
        {"confidence", mode.confidence}};
  }
  for (std::size_t m = 0; m < kDebridementMethods; ++m) {
    const std::string key(base::keyOf(static_cast<DebridementMethod>(m)));
    if (!report.runs[m].empty()) document["methods"][key] = summaryJson(summaryOf(report.runs[m]));
    if (!report.beyond[m].empty()) document["beyond"][key] = summaryJson(summaryOf(report.beyond[m]));
  }
  if (const Speedup speedup = report.speedup(); speedup.value > 0.0)
    document["speedup"] = {
        {"value", speedup.value}, {"low95", speedup.interval.low}, {"high95", speedup.interval.high}};
  return document;
}

}  // namespace

json jsonOf(const CorrectionExperimentResults& results) {
  json document = std::visit([](const auto& found) { return jsonOf(found); }, results.found);
  document["experiment"] = base::nameOf(results.experiment);
  document["setting"] = results.setting;
  return document;
}

}  // namespace capstan::experiments
