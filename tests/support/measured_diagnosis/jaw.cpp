#include "tests/support/measured_diagnosis/jaw.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "tests/support/measured_diagnosis/whole_fit.h"

namespace capstan::measured {
namespace {

using diagnosis::EncoderZeros;
using Recordings = std::vector<diagnosis::Evidence>;

/// Levels of one parity at the frequencies, in the order of the file names.
Recordings recordingsAt(int parity, const std::filesystem::path& folder,
                        const std::vector<std::string>& frequencies, const robot::Description& robot) {
  static const std::regex pattern(R"(.*_([0-9.]+)Hz_load([0-9]+)\.csv)");
  diagnosis::EvidenceOptions options;
  options.skip_start = 1.0;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  Recordings all;
  for (const std::filesystem::path& file : files) {
    std::smatch match;
    const std::string name = file.filename().string();
    if (!std::regex_match(name, match, pattern) || std::stoi(match[2]) % 2 != parity) continue;
    if (std::ranges::count(frequencies, match[1].str()) > 0)
      all.push_back(diagnosis::readEvidence(file, robot, options));
  }
  return all;
}

/// Residual of recordings with the fit's model.
Eigen::VectorXd residual(const diagnosis::FitData& data, const diagnosis::Fit& fit) {
  const diagnosis::Weighting weighting{Eigen::VectorXd::Ones(data.size())};
  return diagnosis::linearise(data, fit.model, fit.u, diagnosis::noneBeyond(data), weighting).e;
}

double rmsInDegrees(const Eigen::VectorXd& e) {
  return std::sqrt(e.squaredNorm() / static_cast<double>(e.size())) * 180.0 / std::numbers::pi;
}

/// Rows that count: regressors and jaw angle of one recording.
struct Regressors {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
};

Regressors regressorsOf(const diagnosis::Evidence& e, int terms) {
  constexpr double kRest = 0.02;  // rad/s
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < e.rows(); ++k)
    if (e.counts(k) && std::isfinite(e.q[0][k])) rows.push_back(k);
  Regressors all{Eigen::MatrixXd(static_cast<Eigen::Index>(rows.size()), terms),
                 Eigen::VectorXd(static_cast<Eigen::Index>(rows.size()))};
  for (Eigen::Index i = 0; i < all.y.size(); ++i) {
    const std::size_t k = rows[static_cast<std::size_t>(i)];
    const double speed = e.dq_m[0][k], load = e.tau_ext[0][k];
    const double direction = std::abs(speed) < kRest ? 0.0 : std::copysign(1.0, speed);
    const double columns[] = {1.0, e.q_m[0][k], load, direction, load * direction, speed, e.tau_m[0][k]};
    for (int c = 0; c < terms; ++c) all.x(i, c) = columns[c];
    all.y[i] = e.q[0][k];
  }
  return all;
}

Regressors stacked(const Recordings& recordings, int terms) {
  Regressors all{Eigen::MatrixXd(0, terms), {}};
  for (const diagnosis::Evidence& e : recordings) {
    const Regressors more = regressorsOf(e, terms);
    const Eigen::Index before = all.y.size();
    all.x.conservativeResize(before + more.y.size(), terms);
    all.y.conservativeResize(before + more.y.size());
    all.x.bottomRows(more.y.size()) = more.x;
    all.y.tail(more.y.size()) = more.y;
  }
  return all;
}

}  // namespace

Jaw::Jaw(const std::filesystem::path& folder, const std::vector<std::string>& frequencies, int threads)
    : nominal_(robotFile("jaw.yaml")),
      threads_(threads),
      even_(recordingsAt(0, folder, frequencies, nominal_)),
      odd_(recordingsAt(1, folder, frequencies, nominal_)),
      base_(nominal_, diagnosis::jointScales(even_, nominal_)) {
  const auto dataOf = [&](const Recordings& recordings, EncoderZeros zeros) {
    return std::make_unique<diagnosis::FitData>(recordings, nominal_, 0.0, zeros, threads);
  };
  fitted_ = dataOf(even_, EncoderZeros::kOneForAll);
  even_known_ = dataOf(even_, EncoderZeros::kKnown);
  odd_known_ = dataOf(odd_, EncoderZeros::kKnown);
  odd_each_ = dataOf(odd_, EncoderZeros::kOnePerRecording);
}

diagnosis::Selection Jaw::select(const diagnosis::SearchOptions& options) const {
  return diagnosis::select(*fitted_, even_, base_, nullptr, options, nullptr);
}

JawErrors Jaw::errorsOf(const diagnosis::Fit& whole) const {
  const Eigen::VectorXd even = residual(*even_known_, whole);
  return {rmsInDegrees((even.array() - even.mean()).matrix()),
          rmsInDegrees((residual(*odd_known_, whole).array() - even.mean()).matrix()),
          rmsInDegrees(residual(*odd_each_, whole))};
}

JawStep Jaw::stepOf(const Step& step) const {
  const diagnosis::Fit whole = wholeFit(even_, nominal_, step.fit, EncoderZeros::kOneForAll, threads_);
  return {step.name, step.competitors, whole.model.extended(whole.u), errorsOf(whole)};
}

std::vector<JawStep> Jaw::steps(const diagnosis::Selection& selection) const {
  std::vector<JawStep> steps;
  for (const Step& step : stepsOf(*fitted_, selection)) steps.push_back(stepOf(step));
  return steps;
}

JawStep Jaw::transferred(const diagnosis::Selection& other) const {
  const diagnosis::SetFitter fitter(*fitted_);
  const diagnosis::SetFit nominal = fitter.nominal(base_, Eigen::VectorXd::Zero(base_.size()));
  diagnosis::EffectSet effects;
  diagnosis::SetFit one_by_one = nominal;
  for (const diagnosis::SelectedEffect& one : other.effects) {
    effects = plus(std::move(effects), one.effect);
    const auto tests = screen(*fitted_, one_by_one.fit, one_by_one.weighting, {one.effect});
    one_by_one = fitter.settled(std::move(fitter.extended(one_by_one, tests).front()));
  }
  diagnosis::SetFit at_once = fitter.settled(fitter.extended(nominal, effects, other.best));
  const bool first = one_by_one.fit.e.squaredNorm() < at_once.fit.e.squaredNorm();
  return stepOf({"effects of the other jaw, refitted", {}, (first ? one_by_one : at_once).fit});
}

JawErrors Jaw::regression(int terms) const {
  const Regressors even = stacked(even_, terms), odd = stacked(odd_, terms);
  const Eigen::VectorXd w = even.x.colPivHouseholderQr().solve(even.y);
  double squares = 0.0, count = 0.0;
  for (const diagnosis::Evidence& e : odd_) {
    const Regressors one = regressorsOf(e, terms);
    const Eigen::VectorXd left = one.y - one.x * w;
    squares += (left.array() - left.mean()).matrix().squaredNorm();
    count += static_cast<double>(left.size());
  }
  return {rmsInDegrees(even.y - even.x * w), rmsInDegrees(odd.y - odd.x * w),
          std::sqrt(squares / count) * 180.0 / std::numbers::pi};
}

std::vector<std::filesystem::path> jawFolders(const std::filesystem::path& data) {
  std::vector<std::filesystem::path> folders;
  if (!std::filesystem::is_directory(data)) return folders;
  for (const auto& entry : std::filesystem::directory_iterator(data))
    if (entry.is_directory() && entry.path().filename().string().starts_with("davinci-jaw"))
      folders.push_back(entry.path());
  std::ranges::sort(folders);
  return folders;
}

}  // namespace capstan::measured
