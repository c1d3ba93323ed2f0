// The parts of the engine on recordings of planted robots: fits, cross-validation, verdicts.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "core/base/error.h"
#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/fit/held_out.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/selection.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

double ratio(double value, double nominal) { return std::log(value / nominal); }

TEST(FitModel, carriesNumbersFromModelToModel) {
  const Planted planted(1);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  const Hypothesis& backlash = *hypothesisNamed("backlash");
  const JointScales& scales = scalesOf(base.scales(), 2);
  const FitModel more = base.with(backlash, 2, backlash.starts(scales, 2).front());
  EXPECT_TRUE(more.has(backlash, 2));
  EXPECT_FALSE(more.has(backlash, 1));
  EXPECT_EQ(more.size(), base.size() + 2);  // half-width and damping
  Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(base.size(), -0.3, 0.4);
  EXPECT_LT((more.carry(base, u).head(base.size()) - u).norm(), 1e-12);
  EXPECT_LT((more.without(backlash, 2).carry(base, u) - u).norm(), 1e-12);
  u.setConstant(1e3);
  for (int k = 0; k < base.size(); ++k) {
    const FitParameter& p = base.parameters()[static_cast<std::size_t>(k)];
    EXPECT_LE(p.value(base.clipped(u)[k]), p.high + 1e-12 * std::abs(p.high)) << p.name;
  }
}

TEST(FitModel, backgroundEffectsGiveWayToTheSameEffectAsACause) {
  const Planted planted(1);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  const Hypothesis& asymmetric = *hypothesisNamed("asymmetric_friction");
  const auto count = [&](const FitModel& model) {
    return std::count_if(model.effects().begin(), model.effects().end(), [&](const EffectTerm& term) {
      return term.hypothesis == &asymmetric && term.joint == 1;
    });
  };
  const FitModel more = base.with(asymmetric, 1, asymmetric.starts(scalesOf(base.scales(), 1), 1).front());
  EXPECT_EQ(count(base), 1);
  EXPECT_EQ(count(more), 1);
  EXPECT_TRUE(more.has(asymmetric, 1));
  EXPECT_FALSE(more.without(asymmetric, 1).has(asymmetric, 1));
  EXPECT_EQ(count(more.without(asymmetric, 1)), 1);
}

TEST(FitModel, logPriorFallsWithTheDistanceFromTheNominalRobot) {
  const Planted planted(1);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  Eigen::VectorXd u = Eigen::VectorXd::Zero(base.size());
  EXPECT_EQ(base.logPrior(u), 0.0);
  u[0] = 2.0;  // two standard deviations of the first constant
  EXPECT_NEAR(base.logPrior(u), -2.0, 1e-12);

  // Wherever the fit of an effect starts, its size counts, not its distance from the start.
  const Hypothesis& radius = *hypothesisNamed("pulley_radius");
  const double scale = 0.02;
  const FitModel near = base.with(radius, 2, {{0.0}, {scale}}), far = base.with(radius, 2, {{0.1}, {scale}});
  EXPECT_EQ(near.logPrior(Eigen::VectorXd::Zero(near.size())), 0.0);
  const double expected = -0.5 * std::pow(0.1 / (3.0 * scale), 2);
  EXPECT_NEAR(far.logPrior(Eigen::VectorXd::Zero(far.size())), expected, 1e-9);
}

TEST(FitModel, anEventIsAsProbableLateAsEarly) {
  const Planted planted(1);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  const Hypothesis& slip = *hypothesisNamed("encoder_slip");
  const auto priorOf = [&](double size, double time) {
    const FitModel model = base.with(slip, 1, {{size, time}, {0.1, 0.05}});
    return model.logPrior(Eigen::VectorXd::Zero(model.size()));
  };
  EXPECT_EQ(priorOf(0.1, 1.0), priorOf(0.1, 7.0));
  EXPECT_LT(priorOf(0.2, 1.0), priorOf(0.1, 1.0));
}

TEST(ChainSimulation, tellsWhatTheWholeMotionDoes) {
  const Planted planted(2);
  const ChainSimulation simulation(planted.evidence.front(), planted.robot, 2.0);
  const robot::ChainModel model(planted.robot);
  const std::vector<Robot> robots(3, Robot{&model, nullptr});
  Eigen::MatrixXd measured(simulation.compared().measured.size(), 3);
  simulation.simulate(robots, measured);
  EXPECT_EQ((measured.col(0) - measured.col(2)).norm(), 0.0);
  const SimulatedMotion motion = simulation.motion(model);
  const auto channels = residualOf(planted.evidence.front(), motion, planted.robot);
  const Compared& compared = simulation.compared();
  for (std::size_t i = 0; i < compared.channel.size(); i += 37) {
    const ComparedChannel& own = compared.channels[static_cast<std::size_t>(compared.channel[i])];
    const auto same = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) {
      return c.joint == own.joint && c.axis == own.axis;
    });
    ASSERT_NE(same, channels.end());
    const auto at = std::lower_bound(same->t.begin(), same->t.end(), compared.t[i] - 1e-9) - same->t.begin();
    // Between outputs 5 ms apart the tip is a cubic, in the whole motion a line from row to row.
    EXPECT_NEAR(measured(static_cast<Eigen::Index>(i), 0), same->simulated[static_cast<std::size_t>(at)],
                own.joint > 0 ? 1e-9 : 2e-6)
        << own.name;
  }
}

TEST(Fit, findsTheAgedRobotsNumbers) {
  const Planted planted(3, {}, 0, 20.0);
  const FitData data(planted.evidence, planted.robot, 2.0, EncoderZeros::kOnePerRecording, 2);
  const Selection s =
      select(data, planted.evidence, FitModel(planted.robot, jointScales(planted.evidence, planted.robot)),
             nullptr, {.most_causes = 0, .refits = 0, .only = {}, .seed = 1}, nullptr);
  const robot::Description found = s.base.model.refitted(s.base.u);
  // Stretch tells ratios: friction by stiffness; gravity's by stiffness where a cable carries it.
  double off = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto compliance = [&](const robot::Description& robot) {
      return robot.joints[j].friction.coulomb / robot.drives[j].cable_stiffness;
    };
    EXPECT_NEAR(ratio(compliance(found), compliance(planted.truth.robot)), 0.0, 0.03) << j;
    off = std::max(off, std::abs(ratio(compliance(planted.truth.robot), compliance(planted.robot))));
  }
  EXPECT_GT(off, 0.1);  // there was something to find
  for (Eigen::Index c = 0; c < s.base_squares.sum.rows(); ++c) {
    const double rms = std::sqrt(s.base_squares.sum.row(c).sum() / s.base_squares.count.row(c).sum());
    EXPECT_LT(rms, 1.25 * data.channels()[static_cast<std::size_t>(c)].noise)
        << data.channels()[static_cast<std::size_t>(c)].name;
  }
}

/// A zero that is free takes the mean of what it is free for.
TEST(Fit, freesEncoderZerosAsItIsAsked) {
  constexpr double kApart = 0.02;  // rad, between the recordings' zeros
  Planted planted(2);
  ASSERT_TRUE(planted.evidence.front().hasEncoders());
  planted.evidence.push_back(planted.evidence.front());
  for (double& q : planted.evidence.back().q[1]) q += kApart;
  const auto means = [&](EncoderZeros zeros) {  // of the elbow's error in either recording
    const FitData data(planted.evidence, planted.robot, 0.0, zeros, 2);
    const FitModel model(planted.robot, jointScales(planted.evidence, planted.robot));
    const Weighting weighting{Eigen::VectorXd::Ones(data.size())};
    const Eigen::VectorXd e =
        linearise(data, model, Eigen::VectorXd::Zero(model.size()), noneBeyond(data), weighting).e;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(), count = sum;
    for (std::size_t i = 0; i < data.channel().size(); ++i) {
      if (data.channels()[static_cast<std::size_t>(data.channel()[i])].joint != 2) continue;
      const int recording = static_cast<Eigen::Index>(i) >= data.first(1) ? 1 : 0;
      sum[recording] += e[static_cast<Eigen::Index>(i)];
      count[recording] += 1.0;
    }
    return Eigen::Vector2d(sum.cwiseQuotient(count));
  };
  const Eigen::Vector2d known = means(EncoderZeros::kKnown);
  EXPECT_NEAR(known[1] - known[0], kApart, 2e-4) << "but for starts, which encoders tell";
  EXPECT_GT(std::abs(known.mean()), 1e-3) << "a drifted robot's error has a mean to take";
  EXPECT_NEAR(means(EncoderZeros::kOneForAll)[0], -0.5 * kApart, 1e-4);
  EXPECT_NEAR(means(EncoderZeros::kOneForAll)[1], 0.5 * kApart, 1e-4);
  EXPECT_LT(means(EncoderZeros::kOnePerRecording).norm(), 1e-9);
}

TEST(LeftOut, isWorseThanTheFitAndNearIt) {
  const Planted planted(4);
  const FitData data(planted.evidence, planted.robot, 2.0, EncoderZeros::kOnePerRecording, 2);
  const FitModel model(planted.robot, jointScales(planted.evidence, planted.robot));
  Weighting weighting;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.size());
  weighting.weights = weightsFor(data, data.measured() - data.simulate({model.chain(none)}).col(0));
  const Fit found = fit(data, model, none, noneBeyond(data), weighting, {20, 0.05, nullptr});
  const Eigen::VectorXd left = heldOut(data, found, weighting);
  const double inside = weighting.weights.cwiseProduct(found.e).squaredNorm();
  const double outside = weighting.weights.cwiseProduct(left).squaredNorm();
  EXPECT_GT(outside, inside);
  EXPECT_LT(outside, 1.5 * inside);
}

TEST(Diagnose, isTheSameWhateverTheThreads) {
  const Planted planted(5, test::Effect::kLoadFriction, 2);
  DiagnosisOptions options;
  options.filter = false;
  options.only = {"load_friction", "pulley_radius", "viscous_friction"};
  options.threads = 1;
  options.material = {1e-7, 1e-7};  // what is found, however small
  const Report one = diagnose(planted.evidence, planted.robot, options);
  options.threads = 2;
  const Report two = diagnose(planted.evidence, planted.robot, options);
  ASSERT_FALSE(one.causes.empty());
  ASSERT_EQ(one.causes.size(), two.causes.size());
  EXPECT_EQ(one.causes.front().effect, "load_friction");
  EXPECT_EQ(one.causes.front().parameters.front().value, two.causes.front().parameters.front().value);
  EXPECT_EQ(robot::formatDescription(one.extended), robot::formatDescription(two.extended));
  EXPECT_EQ(
      robot::formatDescription(robot::parseDescription(robot::formatDescription(one.extended), "extended")),
      robot::formatDescription(one.extended));
  EXPECT_FALSE(one.channels.empty());
}

TEST(Diagnose, tellsNumbersInTheUnitOfTheJoint) {
  const auto unitOf = [](int joint) {
    const Planted planted(7, test::Effect::kHomingOffset, joint, 8.0);
    DiagnosisOptions options;
    options.filter = false;
    options.only = {"homing_offset"};
    options.material = {1e-7, 1e-7};
    const Report report = diagnose(planted.evidence, planted.robot, options);
    return report.causes.empty() ? "no cause" : report.causes.front().parameters.front().unit;
  };
  EXPECT_EQ(unitOf(2), "rad");
  EXPECT_EQ(unitOf(3), "m");
}

TEST(Diagnose, refusesWhatItCannotUse) {
  const Planted planted(6, {}, 0, 8.0);
  EXPECT_THROW(diagnose({}, planted.robot), base::InputError);
  DiagnosisOptions options;
  options.only = {"gremlins"};
  EXPECT_THROW(diagnose(planted.evidence, planted.robot, options), base::InputError);
  robot::Description shorter = planted.robot;
  shorter.joints.pop_back(), shorter.drives.pop_back(), shorter.coupling.pop_back();
  for (auto& row : shorter.coupling) row.pop_back();
  EXPECT_THROW(diagnose(planted.evidence, shorter), base::InputError);
}

TEST(Diagnose, cancelledItSaysSo) {
  const Planted planted(6, {}, 0, 8.0);
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(diagnose(planted.evidence, planted.robot, {}, &progress).cancelled);
}

TEST(Diagnose, isCancelledWhileItSettles) {
  const Planted planted(102, test::Effect::kPulleyRadius, 2, 8.0);
  base::Progress progress;
  std::atomic<bool> over = false, settling = false;
  std::thread watch([&] {
    while (!over && !settling)
      if (progress.doing().starts_with("Settling")) settling = true;
    progress.cancel();
  });
  const Report report = diagnose(planted.evidence, planted.robot, {}, &progress);
  over = true;
  watch.join();
  EXPECT_TRUE(settling);
  EXPECT_TRUE(report.cancelled);
}

}  // namespace
}  // namespace capstan::diagnosis
