#include "core/diagnosis/selection/selection.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/diagnosis/fit/input_noise.h"

namespace capstan::diagnosis {
namespace {

constexpr int kDraws = 400;
constexpr int kFirstIterations = 3;  // of a refit before the poorest are left behind
constexpr int kFirstIterationsRigid = 6;
constexpr int kLastIterations = 12;        // of those that go on
constexpr std::size_t kGoOn = 3;           // refits that do, at most
constexpr double kSensorConfidence = 0.9;  // of the sensor's mean square, whose estimate is some per cent off
constexpr double kHopeless = 0.02;         // reduction after a short refit

/// Falls of the objective [nats] at which a fit stands still: of rigid drives, whose initial states creep,
/// while weights still change; and at the end.
constexpr double kRough = 0.1, kFine = 0.05;
constexpr int kPasses = 3;  // of a fit with the weights of what the one before left
double toleranceOf(const FitData& data, int pass) { return data.rigid() && pass < kPasses ? kRough : kFine; }

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

/// Where a selection stands: how many rounds it will take is not known, and each is given half of what is
/// left.
class Stand {
 public:
  /// From where the progress is to `all`.
  Stand(base::Progress* progress, double all)
      : progress_(progress),
        all_(all),
        begin_(progress ? progress->fraction() : 0.0),
        end_(begin_ + kFirst * (all - begin_)) {}
  void nextRound() { begin_ = end_, end_ += 0.5 * (all_ - end_); }
  void report(double share, std::string_view doing) const {
    if (progress_) progress_->report(begin_ + share * (end_ - begin_), doing);
  }

 private:
  static constexpr double kFirst = 0.2;
  base::Progress* progress_;
  double all_, begin_, end_;
};

/// The nominal structure's fit from `u`, weights by what it leaves.
Fit fitBase(const FitData& data, const FitModel& model, const Eigen::VectorXd& u, Weighting& weighting,
            const base::Progress* progress) {
  const InitialStates initial = noneBeyond(data);
  weighting.weights =
      weightsFor(data, linearise(data, model, u, initial, {Eigen::VectorXd::Ones(data.size())}).e);
  Fit found = fit(data, model, u, initial, weighting, {20, toleranceOf(data, 0), nullptr}, progress);
  for (int pass = 1; pass <= kPasses && !cancelled(progress); ++pass) {
    weighting.weights = weightsFor(data, found.e);
    found = fit(data, model, found.u, found.initial, weighting,
                {kLastIterations, toleranceOf(data, pass), nullptr}, progress);
  }
  return found;
}

class Rounds {
 public:
  Rounds(const FitData& data, const std::vector<Evidence>& recordings, const SelectionOptions& options,
         base::Progress* progress)
      : data_(data),
        recordings_(recordings),
        options_(options),
        progress_(progress),
        stand_(progress, options.progress_end),
        comparison_(data, kDraws, options.seed) {}

  Selection run(const FitModel& base) {
    Selection s = begun(base, Eigen::VectorXd::Zero(base.size()));
    addOthers(s, 1);
    return s;
  }

  Selection runFrom(const Selection& before) {
    Selection s = begun(before.base.model, before.base.u);
    s.candidates = before.candidates;
    s.competitors = before.competitors;
    for (const CandidateModel& c : before.taken) takeAgain(s, before, c);
    addOthers(s, before.candidates.empty() ? 1 : before.candidates.back().round + 1);
    return s;
  }

 private:
  Selection begun(const FitModel& base, const Eigen::VectorXd& u) const {
    Selection s{.base = {.model = base}, .best = {.model = base}};
    stand_.report(0.0, "Refitting the nominal structure");
    s.base = s.best = fitBase(data_, base, u, s.weighting, progress_);
    s.base_squares = s.best_squares = squaresOf(data_, heldOut(data_, s.best, s.weighting));
    s.input_noise = inputNoise(data_, s.base, s.weighting);
    return s;
  }

  void addOthers(Selection& s, int round) {
    const auto most = static_cast<std::size_t>(options_.most_causes);
    while (s.taken.size() < most && !cancelled(progress_) && addOne(s, round)) ++round;
    stand_.report(1.0, "Checking what was named");
    dropSuperfluous(s);
  }

  /// A short refit of one score test.
  CandidateModel contend(const Selection& s, const ScoreTest& score_test) const {
    const FitModel model = s.best.model.with(*score_test.hypothesis, score_test.joint, score_test.start);
    CandidateModel c{.added = {score_test.hypothesis, score_test.joint},
                     .fit = fit(data_, model, model.startFrom(s.best.model, s.best.u), s.best.initial,
                                s.weighting, coarsePass(s), progress_)};
    judge(s, c);
    return c;
  }

  /// Rigid drives add up errors of force, and what the round's fit left bends its derivatives.
  FitOptions coarsePass(const Selection& s) const {
    if (data_.rigid()) return {kFirstIterationsRigid, kRough, nullptr};
    return {kFirstIterations, 0.1, &s.best};
  }

  void judge(const Selection& s, CandidateModel& c) const {
    if (c.fit.e.allFinite()) c.squares = squaresOf(data_, heldOut(data_, c.fit, s.weighting));
    if (c.squares.sum.size() == 0 || !c.squares.sum.allFinite()) {  // a simulation that ran away
      c.gain.assign(kDraws + 1, -1e9);
      c.squares = s.best_squares;
      return;
    }
    c.gain = comparison_.gain(s.best_squares, c.squares);
    c.reduction = largestReduction(explicable(s, s.best_squares), c.squares);
  }

  /// Channels in which there is more than what the noise of inputs brings in, which looks like slow effects
  /// and is none.
  BlockSquares explicable(const Selection& s, const BlockSquares& squares) const {
    BlockSquares left = squares;
    for (Eigen::Index c = 0; c < left.sum.rows(); ++c) {
      const double sensor = data_.channels()[static_cast<std::size_t>(c)].noise, input = s.input_noise[c];
      const double least = kSensorConfidence * sensor * sensor + kSwings * input * input;
      if (left.sum.row(c).sum() < least * left.count.row(c).sum()) left.sum.row(c).setZero();
    }
    return left;
  }

  /// Refits those with the highest scores: all briefly, the best of these fully.
  std::vector<CandidateModel> candidateModelsOf(const Selection& s,
                                                const std::vector<ScoreTest>& score_tests) const {
    std::vector<CandidateModel> candidate_models;
    const std::size_t count = std::min(score_tests.size(), static_cast<std::size_t>(options_.refits));
    for (std::size_t k = 0; k < count && !cancelled(progress_); ++k) {
      stand_.report(0.2 + 0.4 * static_cast<double>(k) / static_cast<double>(count),
                    fmt::format("Refitting with {}", score_tests[k].hypothesis->words.title));
      candidate_models.push_back(contend(s, score_tests[k]));
    }
    const auto better = [](const CandidateModel& a, const CandidateModel& b) {
      return a.gain.front() > b.gain.front();
    };
    const EffectCandidate promised =
        candidate_models.empty() ? EffectCandidate{} : candidate_models.front().added;
    std::stable_sort(candidate_models.begin(), candidate_models.end(), better);
    for (std::size_t k = 0; k < candidate_models.size() && !cancelled(progress_); ++k) {
      CandidateModel& c = candidate_models[k];
      const bool first_in_tests =
          c.added.hypothesis == promised.hypothesis && c.added.joint == promised.joint;
      if (!first_in_tests && (k >= kGoOn || c.reduction.share < kHopeless)) continue;
      if (score_tests.front().share < kHopeless && c.reduction.share < kHopeless) continue;
      stand_.report(0.6 + 0.3 * static_cast<double>(k) / static_cast<double>(candidate_models.size()),
                    fmt::format("Refitting with {}", c.added.hypothesis->words.title));
      c.fit = fit(data_, c.fit.model, c.fit.u, c.fit.initial, s.weighting, {kLastIterations, 0.1, nullptr},
                  progress_);
      judge(s, c);
    }
    std::stable_sort(candidate_models.begin(), candidate_models.end(), better);
    shareOut(candidate_models);
    return candidate_models;
  }

  /// In how many draws each is the best.
  static void shareOut(std::vector<CandidateModel>& candidate_models) {
    for (int d = 1; d <= kDraws; ++d) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < candidate_models.size(); ++k)
        if (candidate_models[k].gain[static_cast<std::size_t>(d)] >
            candidate_models[best].gain[static_cast<std::size_t>(d)])
          best = k;
      if (!candidate_models.empty()) candidate_models[best].share += 1.0 / kDraws;
    }
  }

  bool isMaterial(const Selection& s, const CandidateModel& c) const {
    return c.reduction.share > kMaterial && c.gain.front() > kLeastScore &&
           lowerOf(c.gain, kHighConfidence) > 0.0 && beyondBackground(c) && clearOfNone(s, c);
  }

  /// The effect's numbers together are kClear of their own σ away from zero, where zero is none of it.
  /// Numbers of the robot that the round's model had at a bound have gone as far as they can: they do not
  /// blur it.
  bool clearOfNone(const Selection& s, const CandidateModel& c) const {
    const std::size_t last = c.fit.model.effects().size() - 1;  // where `with` puts it
    const std::vector<int>& index = c.fit.model.effects()[last].index;
    const std::vector<double>& neutral = c.added.hypothesis->neutral;
    const auto& numbers = c.added.hypothesis->facts->parameters;
    std::vector<Eigen::Index> own;
    for (std::size_t k = 0; k < neutral.size(); ++k) {
      if (neutral[k] != 0.0 || index[k] < 0 || numbers[k].name == "time") continue;
      const auto at = static_cast<std::size_t>(index[k]);
      if (at < c.fit.bound.size() && c.fit.bound[at]) return true;  // and would go further
      own.push_back(index[k]);
    }
    if (own.empty()) return true;
    Eigen::VectorXd size(static_cast<Eigen::Index>(own.size()));
    for (std::size_t k = 0; k < own.size(); ++k) {
      const FitParameter& p = c.fit.model.parameters()[static_cast<std::size_t>(own[k])];
      size[static_cast<Eigen::Index>(k)] = p.value(c.fit.u[own[k]]) / p.scale;
    }
    Fit held = c.fit;
    held.bound.resize(static_cast<std::size_t>(held.model.size()), false);
    for (std::size_t k = 0; k < static_cast<std::size_t>(held.model.baseSize()); ++k)
      held.bound[k] = held.bound[k] || (k < s.best.bound.size() && s.best.bound[k]);
    const Eigen::MatrixXd covariance = covarianceOf(data_, held, s.weighting)(own, own);
    return size.dot(covariance.completeOrthogonalDecomposition().solve(size)) > kClear * kClear;
  }

  /// Background effects are reported only where they are clearly above their usual size.
  static bool beyondBackground(const CandidateModel& c) {
    if (c.added.joint == 0) return true;
    const double background = c.added.hypothesis->background(scalesOf(c.fit.model.scales(), c.added.joint));
    const std::size_t last = c.fit.model.effects().size() - 1;  // where `with` puts it
    return c.added.hypothesis->size(c.fit.model.effectValues(last, c.fit.u)) >
           kMoreThanBackground * background;
  }

  static bool sameResidual(const CandidateModel& other, const CandidateModel& best) {
    const double left = 1.0 - other.reduction.share;
    return other.reduction.channel == best.reduction.channel && best.reduction.share > kTakesMost &&
           other.reduction.share > kTakesMost && left < kSameResidual * (1.0 - best.reduction.share);
  }

  bool addOne(Selection& s, int round) {
    const std::vector<EffectCandidate> candidates = candidatesOf(recordings_, s.best.model, options_.only);
    stand_.nextRound();
    stand_.report(0.0, "Testing hypotheses");
    const std::vector<ScoreTest> score_tests = screen(data_, s.best, s.weighting, candidates);
    std::vector<CandidateModel> candidate_models = candidateModelsOf(s, score_tests);
    note(s, score_tests, candidate_models, round);
    if (candidate_models.empty() || cancelled(progress_)) return false;
    std::erase_if(candidate_models, [&](const CandidateModel& c) { return !isMaterial(s, c); });
    if (candidate_models.empty()) return false;
    CompetingExplanations competitors{candidate_models.front().added, {}, {candidate_models.front().share}};
    for (std::size_t k = 1; k < candidate_models.size(); ++k)
      if (candidate_models[k].share > kCompetitor ||
          sameResidual(candidate_models[k], candidate_models.front()) ||
          candidate_models[k].gain.front() > kAsGood * candidate_models.front().gain.front()) {
        competitors.others.push_back(candidate_models[k].added);
        competitors.shares.push_back(candidate_models[k].share);
      }
    s.competitors.push_back(std::move(competitors));
    stand_.report(0.9, "Settling the extended model");
    take(s, std::move(candidate_models.front()));
    return true;
  }

  /// A fit to its end, with weights by what it leaves.
  struct Settled {
    Fit fit;
    Weighting weighting;
    BlockSquares squares;
  };
  Settled settled(Fit from) const {
    Settled s{std::move(from), {}, {}};
    for (int pass = 1; pass <= kPasses; ++pass) {
      s.weighting.weights = weightsFor(data_, s.fit.e);
      if (cancelled(progress_)) break;
      s.fit = fit(data_, s.fit.model, s.fit.u, s.fit.initial, s.weighting,
                  {kLastIterations, toleranceOf(data_, pass), nullptr}, progress_);
    }
    s.squares = squaresOf(data_, heldOut(data_, s.fit, s.weighting));
    return s;
  }

  /// The candidate model settled, from where it stands and from the nominal numbers: the base had bent them
  /// to stand for the effect, at times too far to find back.
  void take(Selection& s, CandidateModel c) {
    Settled best = settled(c.fit);
    Eigen::VectorXd fresh = c.fit.u;
    fresh.head(c.fit.model.baseSize()).setZero();
    Settled other = settled(linearise(data_, c.fit.model, fresh, c.fit.initial, best.weighting));
    const bool finite = other.squares.sum.allFinite();
    if (finite &&
        (!best.squares.sum.allFinite() || comparison_.gain(best.squares, other.squares).front() > 0.0))
      best = std::move(other);
    adopt(s, std::move(c), std::move(best));
  }

  /// What another selection took, from the numbers of its best.
  void takeAgain(Selection& s, const Selection& before, CandidateModel c) const {
    const EffectStart& start = c.fit.model.effects().back().start;  // where `with` puts it
    const FitModel model = s.best.model.with(*c.added.hypothesis, c.added.joint, start);
    const Eigen::VectorXd u = model.carry(before.best.model, before.best.u);
    c.fit = linearise(data_, model, u, s.best.initial, s.weighting);
    Settled best = settled(c.fit);
    adopt(s, std::move(c), std::move(best));
  }

  static void adopt(Selection& s, CandidateModel c, Settled best) {
    s.best = std::move(best.fit);
    s.weighting = std::move(best.weighting);
    s.best_squares = std::move(best.squares);
    c.squares = s.best_squares;
    s.taken.push_back(std::move(c));
  }

  /// An effect taken early may have stood for later ones, and a later one only have helped a fit on its way:
  /// without them nothing is lost.
  void dropSuperfluous(Selection& s) {
    for (std::size_t k = 0; s.taken.size() > 1 && k < s.taken.size() && !cancelled(progress_);) {
      const EffectCandidate suspect = s.taken[k].added;
      const FitModel model = s.best.model.without(*suspect.hypothesis, suspect.joint);
      const Fit less = fit(data_, model, model.carry(s.best.model, s.best.u), s.best.initial, s.weighting,
                           {kLastIterations, 0.1, nullptr}, progress_);
      const BlockSquares squares = squaresOf(data_, heldOut(data_, less, s.weighting));
      const std::vector<double> gain = comparison_.gain(squares, s.best_squares);
      const Reduction reduction = largestReduction(explicable(s, squares), s.best_squares);
      const bool ran_away = !squares.sum.allFinite();
      if (ran_away || (reduction.share > kMaterial && gain.front() > kLeastScore &&
                       lowerOf(gain, kHighConfidence) > 0.0)) {
        ++k;
        continue;
      }
      s.best = less;
      s.best_squares = squares;
      s.taken.erase(s.taken.begin() + static_cast<std::ptrdiff_t>(k));
      s.competitors.erase(s.competitors.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }

  static void note(Selection& s, const std::vector<ScoreTest>& score_tests,
                   const std::vector<CandidateModel>& candidate_models, int round) {
    for (const ScoreTest& score_test : score_tests) {
      Candidate candidate{std::string(score_test.hypothesis->name()),
                          score_test.joint,
                          round,
                          score_test.share,
                          false,
                          std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::quiet_NaN(),
                          0.0};
      for (const CandidateModel& c : candidate_models) {
        if (c.added.hypothesis != score_test.hypothesis || c.added.joint != score_test.joint) continue;
        candidate.refitted = true;
        candidate.reduction = c.reduction.share;
        candidate.score = c.gain.front();
        candidate.probability = c.share;
      }
      s.candidates.push_back(std::move(candidate));
    }
  }

  const FitData& data_;
  const std::vector<Evidence>& recordings_;
  const SelectionOptions& options_;
  base::Progress* progress_;
  Stand stand_;
  Comparison comparison_;
};

}  // namespace

Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& base,
                 const SelectionOptions& options, base::Progress* progress) {
  return Rounds(data, recordings, options, progress).run(base);
}

Selection selectFurther(const FitData& data, const std::vector<Evidence>& recordings, const Selection& before,
                        const SelectionOptions& options, base::Progress* progress) {
  return Rounds(data, recordings, options, progress).runFrom(before);
}

}  // namespace capstan::diagnosis
