#include "core/identification/drive_identification.h"

#include <fmt/format.h>

#include <chrono>

#include "core/identification/drive_fit.h"
#include "core/identification/identifiability.h"

namespace capstan::identification {
namespace {

/// Advice on how to record data in which a parameter is observable.
const char* helpFor(DriveQuantity quantity) {
  using Q = DriveQuantity;
  switch (quantity) {
    case Q::kLinkRadius:
      return "Move over a larger part of the joint's range.";
    case Q::kStiffness:
      return "Record several loads, and the motor torque.";
    case Q::kExponent:
      return "Record higher loads: the cable is nearly linear at these.";
    case Q::kCoulomb:
      return "Reverse the motion more often, under load.";
    case Q::kMotorCoulomb:
    case Q::kMotorViscous:
      return "Record the motor torque at several speeds.";
    default:
      return "Move faster, and at several speeds.";
  }
}

DriveEstimate estimateOf(const DriveParameters& parameters, const DriveFit::Held& held, const DriveLogs& logs,
                         int i, const Eigen::MatrixXd& covariance, int at) {
  const DriveParameter& parameter = parameters[i];
  DriveEstimate estimate{parameter, logs(i), std::sqrt(covariance(at, at)), true, {}};
  estimate.seen = estimate.sigma < kSeenShare * parameter.prior_sigma;
  if (!estimate.seen) {
    estimate.advice =
        parameter.words() + " is not observable in these recordings. " + helpFor(parameter.quantity);
    return estimate;
  }
  if (std::abs(estimate.log) > 0.999 * parameter.bound) {
    estimate.advice = parameter.words() + " reached its bound. The model does not explain these recordings.";
    return estimate;
  }
  constexpr double kTied = 0.95;
  std::vector<int> free;
  for (int k = 0; k < kDriveQuantities; ++k)
    if (!held[static_cast<std::size_t>(k)]) free.push_back(k);
  Visibility visibility;
  findPartner(covariance, at, static_cast<int>(free.size()), visibility);
  if (visibility.partner >= 0 && std::abs(visibility.correlation) > kTied)
    estimate.advice =
        fmt::format("{} is hard to distinguish from {} (correlation {:.2f}). {}", parameter.words(),
                    parameters[free[static_cast<std::size_t>(visibility.partner)]].words(),
                    visibility.correlation, helpFor(parameter.quantity));
  return estimate;
}

/// Computes the estimates of the free parameters. Returns true when all of them are seen.
bool estimate(const DriveParameters& parameters, const DriveFit& fit, const DriveFit::Held& held,
              const Eigen::MatrixXd& covariance, std::array<DriveEstimate, kDriveQuantities>& estimates) {
  bool all = true;
  for (int i = 0, at = 0; i < kDriveQuantities; ++i) {
    const auto place = static_cast<std::size_t>(i);
    if (held[place]) continue;
    estimates[place] = estimateOf(parameters, held, fit.logs, i, covariance, at++);
    all = all && estimates[place].seen;
  }
  return all;
}

/// Fixes unseen parameters at their nominal value; their σ and advice stay as they are.
void holdUnseen(DriveFit& fit, DriveFit::Held& held, std::array<DriveEstimate, kDriveQuantities>& estimates) {
  for (int i = 0; i < kDriveQuantities; ++i) {
    const auto place = static_cast<std::size_t>(i);
    if (held[place] || estimates[place].seen) continue;
    held[place] = true;
    estimates[place].log = fit.logs(i) = 0.0;
  }
}

void compareWithLoad(const std::vector<DriveRecording>& recordings, DriveReport& report) {
  constexpr std::size_t kFewest = 3;
  if (report.offsets.size() < kFewest) return;
  const auto n = static_cast<Eigen::Index>(report.offsets.size());
  Eigen::ArrayXd load(n), offset(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& measured = recordings[static_cast<std::size_t>(i)].tau_ext;
    load(i) = Eigen::ArrayXd::Map(measured.data(), static_cast<Eigen::Index>(measured.size())).mean();
    offset(i) = report.offsets[static_cast<std::size_t>(i)].value;
  }
  load -= load.mean();
  offset -= offset.mean();
  const double both = (load * offset).sum(), loads = load.square().sum(), offsets = offset.square().sum();
  if (loads <= 0.0 || offsets <= 0.0) return;
  report.offset_by_load = both / loads;
  report.offset_load_correlation = both / std::sqrt(loads * offsets);
}

void describe(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
              const DriveFit& fit, const Eigen::MatrixXd& covariance, Eigen::Index seen,
              DriveReport& report) {
  report.covariance = covariance.topLeftCorner(seen, seen);
  const Eigen::VectorXd inverse = report.covariance.diagonal().cwiseSqrt().cwiseInverse();
  report.correlation = inverse.asDiagonal() * report.covariance * inverse.asDiagonal();
  double mean = 0.0;
  for (std::size_t i = 0; i < fit.offsets.size(); ++i) {
    const Eigen::Index at = seen + static_cast<Eigen::Index>(i);
    report.offsets.push_back({fit.offsets.size() == 1 ? "all recordings" : recordings[i].title,
                              fit.offsets[i], std::sqrt(covariance(at, at))});
    mean += fit.offsets[i] / static_cast<double>(fit.offsets.size());
  }
  compareWithLoad(recordings, report);
  report.robot = parameters.robot(fit.logs, mean);
  report.torque_sign = fit.torqueSign();
  report.angle_noise = fit.angleNoise();
  report.torque_noise = fit.torqueNoise();
  report.outliers = fit.outliers();
  report.observations = fit.observations();
  report.iterations = fit.iterations();
}

}  // namespace

DriveReport identifyDrive(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
                          const DriveOptions& options, base::Progress* progress) {
  const auto begin = std::chrono::steady_clock::now();
  DriveReport report;
  DriveFit fit(recordings, parameters, options);
  if (fit.observations() == 0) {
    report.end = BatchEnd::kNoData;
    return report;
  }
  DriveFit::Held held;
  for (int i = 0; i < kDriveQuantities; ++i) held[static_cast<std::size_t>(i)] = !parameters[i].asked;
  std::array<DriveEstimate, kDriveQuantities> estimates;
  Eigen::MatrixXd covariance;
  for (bool all = false; !all;) {
    report.end = fit.solve(held, progress);
    if (report.end == BatchEnd::kCancelled) return report;
    covariance = fit.covariance(held);
    all = estimate(parameters, fit, held, covariance, estimates);
    if (!all) holdUnseen(fit, held, estimates);
  }
  Eigen::Index seen = 0;
  for (int i = 0; i < kDriveQuantities; ++i) {
    const auto place = static_cast<std::size_t>(i);
    if (parameters[i].asked) report.estimates.push_back(estimates[place]);
    seen += held[place] ? 0 : 1;
  }
  describe(recordings, parameters, fit, covariance, seen, report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

}  // namespace capstan::identification
