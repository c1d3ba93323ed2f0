#include "core/experiments/results_json.h"

#include <type_traits>

#include "core/base/names.h"
#include "core/experiments/series.h"

namespace capstan::experiments {
namespace {

using nlohmann::json;

// ---- one value

template <class T>
json write(const T& value);
template <class T>
void read(const json& document, T& value);

template <class Self, class Visitor>
void fields(Self& inputs, Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, TrialInputs> {
  field("nominal", inputs.nominal);
  field("robot", inputs.robot);
  field("truth", inputs.truth);
  field("trajectory", inputs.trajectory);
  field("tracking", inputs.tracking);
  field("recording", inputs.recording);
}

template <class Self, class Visitor>
void fields(Self& occlusion,
            Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, OcclusionSpec> {
  field("percentage", occlusion.percentage);
  field("interval", occlusion.interval);
}

template <class Self, class Visitor>
void fields(Self& estimate,
            Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, ParameterEstimate> {
  field("value", estimate.value);
  field("sigma", estimate.sigma);
  field("low95", estimate.low);
  field("high95", estimate.high);
  field("seen", estimate.seen);
  field("advice", estimate.advice);
}

template <class Self, class Visitor>
void fields(Self& parameter,
            Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, IdentifiedParameter> {
  field("name", parameter.name);
  field("words", parameter.words);
  field("unit", parameter.unit);
  field("scale", parameter.scale);
  field("nominal", parameter.nominal);
  field("truth", parameter.truth);
  field("dual_ukf", parameter.dual_ukf);
  field("batch", parameter.batch);
  field("settled_at", parameter.settled_at);
  field("convergence", parameter.convergence);
}

template <class Self, class Visitor>
void fields(Self& motion, Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, TrialMotion> {
  field("name", motion.name);
  field("begin", motion.begin);
  field("end", motion.end);
  field("occluded_share", motion.occluded_share);
}

template <class Self, class Visitor>
void fields(Self& trial, Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, TrialResult> {
  field("name", trial.name);
  field("simulated", trial.simulated);
  field("seed", trial.seed);
  field("occlusion", trial.occlusion);
  field("images", trial.images);
  field("own_kinematics", trial.own_kinematics);
  field("reference", trial.reference);
  field("begin", trial.begin);
  field("end", trial.end);
  field("motor_samples", trial.motor_samples);
  field("camera_samples", trial.camera_samples);
  field("gates", trial.gates);
  field("occluded_share", trial.occluded_share);
  field("rms", trial.rms);
  field("counts", trial.counts);
  field("rms_augmented", trial.rms_augmented);
  field("nis", trial.nis);
  field("nees", trial.nees);
  field("rescues", trial.rescues);
  field("late_dropped", trial.late_dropped);
  field("inputs", trial.inputs);
}

template <class Self, class Visitor>
void fields(Self& result,
            Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, IdentificationResult> {
  field("recordings", result.recordings);
  field("motions", result.motions);
  field("method", result.method);
  field("parameters", result.parameters);
  field("dual_correlation", result.dual_correlation);
  field("batch_correlation", result.batch_correlation);
  field("dual_end", result.dual_end);
  field("batch_end", result.batch_end);
  field("dual_observations", result.dual_observations);
  field("batch_observations", result.batch_observations);
  field("batch_iterations", result.batch_iterations);
  field("dual_nis", result.dual_nis);
  field("batch_residual", result.batch_residual);
  field("camera", result.camera);
  field("camera_sigma", result.camera_sigma);
  field("duration", result.duration);
  field("seed", result.seed);
  field("inputs", result.inputs);
  field("robot", result.robot);
}

template <class Self, class Visitor>
void fields(Self& results, Visitor&& field) requires std::is_same_v<std::remove_const_t<Self>, Results> {
  field("name", results.name);
  field("title", results.title);
  field("work", results.work);
  field("software", results.software);
  field("simulated", results.simulated);
  field("specification", results.specification);
}

template <class T>
concept HasFields = requires(T& value) {
  fields(value, [](const char*, auto&) {});
};
template <class T>
concept IsMatrix = std::is_base_of_v<Eigen::MatrixBase<T>, T>;

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

json writeMatrix(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

double readNumber(const json& document) { return document.is_null() ? kNone : document.get<double>(); }

template <class T>
json write(const T& value) {
  if constexpr (HasFields<const T>) {
    json document = json::object();
    fields(value, [&](const char* key, const auto& member) { document[key] = write(member); });
    return document;
  } else if constexpr (base::Named<T>) {
    return std::string(base::nameOf(value));
  } else if constexpr (IsOptional<T>::value) {
    return value ? write(*value) : json();
  } else if constexpr (IsMatrix<T>) {
    if constexpr (T::ColsAtCompileTime == 1) {
      json values = json::array();
      for (Eigen::Index i = 0; i < value.size(); ++i) values.push_back(value(i));
      return values;
    } else {
      return writeMatrix(value);
    }
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else {
    json values = json::array();
    for (const auto& one : value) values.push_back(write(one));
    return values;
  }
}

template <class T>
void read(const json& document, T& value) {
  if constexpr (HasFields<T>) {
    fields(value, [&](const char* key, auto& member) { read(document.at(key), member); });
  } else if constexpr (base::Named<T>) {
    const auto named = base::fromName<T>(document.get<std::string>());
    if (!named) throw json::other_error::create(501, "unknown name " + document.dump(), &document);
    value = *named;
  } else if constexpr (IsOptional<T>::value) {
    if (document.is_null())
      value.reset();
    else
      read(document, value.emplace());
  } else if constexpr (IsMatrix<T>) {
    if constexpr (T::ColsAtCompileTime == 1) {
      for (Eigen::Index i = 0; i < value.size(); ++i)
        value(i) = readNumber(document.at(static_cast<std::size_t>(i)));
    } else {
      const auto rows = static_cast<Eigen::Index>(document.size());
      value.resize(rows, rows == 0 ? 0 : static_cast<Eigen::Index>(document.at(0).size()));
      for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < value.cols(); ++j)
          value(i, j) = readNumber(document.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)));
    }
  } else if constexpr (std::is_same_v<T, double>) {
    value = readNumber(document);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    value = document.get<T>();
  } else {
    if constexpr (requires { value.resize(1); }) value.resize(document.size());
    for (std::size_t i = 0; i < value.size(); ++i) read(document.at(i), value[i]);
  }
}

}  // namespace

json numbersOf(const TrialResult& trial) { return write(trial); }
json numbersOf(const IdentificationResult& identification) { return write(identification); }
void takeNumbers(const json& document, TrialResult& trial) { read(document, trial); }
void takeNumbers(const json& document, IdentificationResult& identification) {
  read(document, identification);
}
json headOf(const Results& results) { return write(results); }
void takeHead(const json& document, Results& results) { read(document, results); }

namespace {

json seriesOfMotion(const TrialMotion& motion) {
  return {{"trajectory", jsonOfSeries(motion.trajectory)}, {"camera", jsonOfSeries(motion.camera)}};
}

void takeMotion(const json& document, TrialMotion& motion) {
  motion.trajectory = seriesOfJson<TrajectoryPoint>(document.at("trajectory"));
  motion.camera = seriesOfJson<CameraPoint>(document.at("camera"));
}

}  // namespace

json seriesOf(const TrialResult& trial) {
  json series = seriesOfMotion(trial);
  series["errors"] = jsonOfSeries(trial.errors);
  return series;
}

void takeSeries(const json& document, TrialResult& trial) {
  takeMotion(document, trial);
  trial.errors = seriesOfJson<ErrorPoint>(document.at("errors"));
}

json seriesOf(const IdentificationResult& identification) {
  json t = json::array(), value = json::array(), sigma = json::array();
  for (const ParameterTracePoint& point : identification.trace) {
    t.push_back(point.t);
    value.push_back(write(point.value));
    sigma.push_back(write(point.sigma));
  }
  json motions = json::array();
  for (const TrialMotion& motion : identification.motions) motions.push_back(seriesOfMotion(motion));
  return {{"trace", {{"t", t}, {"value", value}, {"sigma", sigma}}}, {"motions", motions}};
}

void takeSeries(const json& document, IdentificationResult& identification) {
  const json& trace = document.at("trace");
  identification.trace.resize(trace.at("t").size());
  for (std::size_t i = 0; i < identification.trace.size(); ++i) {
    ParameterTracePoint& point = identification.trace[i];
    read(trace.at("t").at(i), point.t);
    read(trace.at("value").at(i), point.value);
    read(trace.at("sigma").at(i), point.sigma);
  }
  for (std::size_t i = 0; i < identification.motions.size(); ++i)
    takeMotion(document.at("motions").at(i), identification.motions[i]);
}

}  // namespace capstan::experiments
