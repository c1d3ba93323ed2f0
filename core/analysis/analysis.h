#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/error_run.h"
#include "core/base/progress.h"
#include "core/base/table.h"

/// Statistics of the errors of one run, or of two runs in comparison: selection, measures, and confidence
/// intervals of their differences. For people: angles are in degrees, lengths in millimetres.
namespace capstan::analysis {

struct AnalysisOptions {
  std::optional<int> joint;  ///< joint 0…2; nothing: all joints
  std::vector<experiments::Estimator> estimators = {experiments::Estimator::kKinematic,
                                                    experiments::Estimator::kUkf};
  bool absolute = false;  ///< true: |error| in place of error
  TimeShare share = TimeShare::kAll;
  std::size_t resamples = 1000;  ///< number of bootstrap resamples
  std::uint64_t seed = 1;        ///< seed of the bootstrap

  std::vector<int> joints() const;
  bool operator==(const AnalysisOptions&) const = default;
};

/// Finite errors of one estimator and joint, with their times.
struct SelectedErrors {
  std::vector<double> t;      ///< [s]
  std::vector<double> value;  ///< [deg or mm]
};
SelectedErrors selectedErrors(const ErrorRun& run, experiments::Estimator estimator, int joint,
                              const AnalysisOptions& options);

enum class Measure { kRms, kMedian, kInterquartileRange, kMean };
inline constexpr std::array kMeasures = {Measure::kRms, Measure::kMedian, Measure::kInterquartileRange,
                                         Measure::kMean};

/// Measures of a set of errors [deg or mm]; NaN without errors. RMS and mean are over all samples of a run,
/// median and IQR over the samples in its memory; `counts` has the number of each.
struct ErrorSummary {
  std::size_t n = 0;  ///< number of samples of the RMS
  std::array<double, kMeasures.size()> value = {experiments::kNone, experiments::kNone, experiments::kNone,
                                                experiments::kNone};
  std::array<std::size_t, kMeasures.size()> counts = {};

  double of(Measure measure) const { return value[static_cast<std::size_t>(measure)]; }
  std::size_t count(Measure measure) const { return counts[static_cast<std::size_t>(measure)]; }
};
ErrorSummary summaryOf(const std::vector<double>& values);
/// Summary of an estimator and joint of `run` over the time selected in `options`.
ErrorSummary summaryOf(const ErrorRun& run, experiments::Estimator estimator, int joint,
                       const AnalysisOptions& options);

/// Difference second − first with the percentile interval of a circular block bootstrap; NaN where it is not
/// known yet. clear(): the interval excludes zero.
struct Difference {
  double value = experiments::kNone, low = experiments::kNone, high = experiments::kNone;

  bool clear() const { return low > 0.0 || high < 0.0; }
};

/// Analysis of one joint and estimator.
struct AnalysisRow {
  int joint = 0;
  experiments::Estimator estimator = experiments::Estimator::kUkf;
  ErrorSummary a = {}, b = {};  ///< summaries of runs A and B; without B: b has no samples
  std::array<Difference, kMeasures.size()> difference = {};
  bool paired = false;     ///< true: both sides are at the same instants of one motion
  std::size_t common = 0;  ///< number of common instants of paired sides
  /// Two-sided P of equal means: paired or Welch's t-test on the means of nearly independent blocks. NaN for
  /// fewer than kLeastBlocks blocks, or no spread.
  double p = experiments::kNone, log10_p = experiments::kNone;
  std::size_t block_length = 0, blocks = 0;  ///< samples per block; number of blocks of the smaller side

  static constexpr std::size_t kLeastBlocks = 10;
  const Difference& of(Measure measure) const { return difference[static_cast<std::size_t>(measure)]; }
};

/// Reference of the differences.
enum class Against {
  kNothing,
  kRun,       ///< differences are B − A
  kKinematic  ///< differences of a single run are UKF − kinematic, at the same instants; not where the
              ///< reference is the robot's own kinematics
};

struct Analysis {
  AnalysisOptions options;
  std::string title_a, title_b;    ///< titles of the runs; title_b empty: one run
  std::string robots_a, robots_b;  ///< robots of kinematics and filter; see experiments::robotWords()
  bool same_motion = false;        ///< true: two runs of one motion, whose samples pair
  Against against = Against::kNothing;
  std::vector<AnalysisRow> rows;  ///< by joint, then estimator
  bool intervals = false;         ///< true: addIntervals() has finished
};

/// Computes everything except intervals and P; quick. `b` null: one run. Throws base::InputError when no
/// errors of a run are selected.
Analysis analyse(const ErrorRun& a, const ErrorRun* b, const AnalysisOptions& options);

/// Most samples of a side that are resampled.
inline constexpr std::size_t kMostResampled = 20000;
/// Computes intervals and P of every difference. Both sides are taken at the wider spacing of the two, wider
/// still beyond kMostResampled samples. The block length follows from the correlation of the errors and of
/// their squares (stats::optimalBlockLength); the longer one of both sides counts. No block contains a gap in
/// time. Same runs and options, same bytes. Returns false when cancelled; then `analysis` is unchanged.
bool addIntervals(Analysis& analysis, const ErrorRun& a, const ErrorRun* b, base::Progress& progress);

/// Table with one row per joint, estimator and measure: A, B, difference, 95 % interval; P beside means.
base::Table tableOf(const Analysis& analysis);

/// Text on each run: "A: trial.capstan, kinematics and UKF of mine.yaml, n = 19610".
std::vector<std::string> runWords(const Analysis& analysis);

/// Text on thinning: "distributions of 1961 of 19610 samples"; empty where the memory holds all samples.
std::string thinningWords(const Analysis& analysis);

/// Text on pairing: "intervals and P: of the 8164 instants that both runs have"; empty where no run has more.
std::string pairingWords(const Analysis& analysis);

/// Number of decimals that show three digits of the smallest RMS of `analysis` [deg or mm]: 3 to 6.
int decimalsOf(const Analysis& analysis);

/// Text of a probability: "1e-05", "0.034", "1e-402"; "–" where it is not known.
std::string probabilityText(double p, double log10_p);

}  // namespace capstan::analysis

template <>
struct capstan::base::NamesOf<capstan::analysis::Measure> {
  using M = capstan::analysis::Measure;
  static constexpr std::array value = {std::pair{M::kRms, "RMS"}, std::pair{M::kMedian, "median"},
                                       std::pair{M::kInterquartileRange, "IQR"}, std::pair{M::kMean, "mean"}};
};
