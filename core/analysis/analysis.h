#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/error_run.h"
#include "core/base/progress.h"
#include "core/base/table.h"

/// Errors of one run, or of two beside each other: the selection, its statistics, and the confidence interval
/// of a difference is. Angles in degrees, lengths in millimetres: this is what people read.
namespace capstan::analysis {

struct AnalysisOptions {
  std::optional<int> joint;  ///< 0…2; nothing: all
  std::vector<experiments::Estimator> estimators = {experiments::Estimator::kKinematic,
                                                    experiments::Estimator::kUkf};
  bool absolute = false;  ///< |error| in place of error
  TimeShare share = TimeShare::kAll;
  std::size_t resamples = 1000;  ///< of the bootstrap
  std::uint64_t seed = 1;        ///< of the bootstrap

  std::vector<int> joints() const;
  bool operator==(const AnalysisOptions&) const = default;
};

/// Finite errors of one estimator and joint at their times.
struct SelectedErrors {
  std::vector<double> t;      ///< [s]
  std::vector<double> value;  ///< [deg or mm]
};
SelectedErrors selectedErrors(const ErrorRun& run, experiments::Estimator estimator, int joint,
                              const AnalysisOptions& options);

enum class Measure { kRms, kMedian, kInterquartileRange, kMean };
inline constexpr std::array kMeasures = {Measure::kRms, Measure::kMedian, Measure::kInterquartileRange,
                                         Measure::kMean};

/// What a sample comes to [deg or mm]; NaN without one. RMS and mean are over every sample of a run, median
/// and IQR over those that its memory kept; each measure has its count.
struct ErrorSummary {
  std::size_t n = 0;  ///< behind the RMS
  std::array<double, kMeasures.size()> value = {experiments::kNone, experiments::kNone, experiments::kNone,
                                                experiments::kNone};
  std::array<std::size_t, kMeasures.size()> counts = {};

  double of(Measure measure) const { return value[static_cast<std::size_t>(measure)]; }
  std::size_t count(Measure measure) const { return counts[static_cast<std::size_t>(measure)]; }
};
ErrorSummary summaryOf(const std::vector<double>& values);
/// Of an estimator and joint of `run`, over the time that `options` ask for.
ErrorSummary summaryOf(const ErrorRun& run, experiments::Estimator estimator, int joint,
                       const AnalysisOptions& options);

/// second − first, with the percentile interval of a circular block bootstrap; NaN where it is not known
/// (yet). The interval says that the difference is not zero.
struct Difference {
  double value = experiments::kNone, low = experiments::kNone, high = experiments::kNone;

  bool clear() const { return low > 0.0 || high < 0.0; }
};

/// One joint and estimator.
struct AnalysisRow {
  int joint = 0;
  experiments::Estimator estimator = experiments::Estimator::kUkf;
  ErrorSummary a = {}, b = {};  ///< of runs A and B; without B: b has no samples
  std::array<Difference, kMeasures.size()> difference = {};
  bool paired = false;     ///< both sides at the same instants of one motion
  std::size_t common = 0;  ///< of paired sides: the instants that both have
  /// Two-sided P of equal means, of the means of blocks that are about independent: paired or Welch's
  /// t-test. NaN for fewer than kLeastBlocks of them, or no spread.
  double p = experiments::kNone, log10_p = experiments::kNone;
  std::size_t block_length = 0, blocks = 0;  ///< samples at the common spacing; blocks of the smaller side

  static constexpr std::size_t kLeastBlocks = 10;
  const Difference& of(Measure measure) const { return difference[static_cast<std::size_t>(measure)]; }
};

enum class Against {
  kNothing,
  kRun,       ///< differences are B − A
  kKinematic  ///< of a single run: UKF − kinematic, at the same instants
};

struct Analysis {
  AnalysisOptions options;
  std::string title_a, title_b;    ///< title_b empty: one run
  std::string robots_a, robots_b;  ///< whose kinematics and filter: experiments::robotWords()
  bool same_motion = false;        ///< of two runs: their samples pair
  Against against = Against::kNothing;
  std::vector<AnalysisRow> rows;  ///< by joint, then estimator
  bool intervals = false;         ///< addIntervals() has finished
};

/// All but intervals and P; quick. `b` null: one run. Throws base::InputError where nothing is left of a run.
Analysis analyse(const ErrorRun& a, const ErrorRun* b, const AnalysisOptions& options);

/// Intervals and P of every difference. Blocks are as long as the correlation of the errors and of their
/// squares asks for (stats::optimalBlockLength), the longer of both sides, which are taken at the wider
/// spacing of the two (wider still beyond kMostResampled samples); none reaches across a gap in time. Seeded:
/// same runs and options, same bytes. False: cancelled, `analysis` unchanged.
inline constexpr std::size_t kMostResampled = 20000;
bool addIntervals(Analysis& analysis, const ErrorRun& a, const ErrorRun* b, base::Progress& progress);

/// A row a joint, estimator and measure: A, B, difference, 95 % interval; P beside means.
base::Table tableOf(const Analysis& analysis);

/// "A: trial.capstan, kinematics and UKF of mine.yaml, n = 19610", for each run.
std::vector<std::string> runWords(const Analysis& analysis);

/// "distributions of 1961 of 19610 samples", where a run had more than its memory kept; else empty.
std::string thinningWords(const Analysis& analysis);

/// "intervals and P: of the 8164 instants that both runs have", where one run has more than the other; else
/// empty.
std::string pairingWords(const Analysis& analysis);

/// Decimals that show three digits of the smallest RMS of `analysis` [deg or mm]: 3 to 6.
int decimalsOf(const Analysis& analysis);

/// "1e-05", "0.034", "1e-402"; "–" where it is not known.
std::string probabilityText(double p, double log10_p);

}  // namespace capstan::analysis

template <>
struct capstan::base::NamesOf<capstan::analysis::Measure> {
  using M = capstan::analysis::Measure;
  static constexpr std::array value = {std::pair{M::kRms, "RMS"}, std::pair{M::kMedian, "median"},
                                       std::pair{M::kInterquartileRange, "IQR"}, std::pair{M::kMean, "mean"}};
};
