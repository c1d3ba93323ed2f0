#include "core/diagnosis/fit/fit_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/check.h"

namespace capstan::diagnosis {
namespace {

constexpr double kCentreSigma = 0.15;     // prior σ of a centre of mass, over its distance from the joint
constexpr double kMostCentre = 0.3;       // largest change of a centre of mass, over the same distance
constexpr double kEffectPrior = 3.0;      // prior σ of an effect's number, over EffectStart::scale
constexpr double kBackgroundPrior = 0.5;  // prior σ of a background effect, over Hypothesis::background
constexpr double kFarShape = 8.0;  // largest factor of a speed, time or length over those of the starts

}  // namespace

double FitParameter::value(double u) const {
  const double x = logarithmic ? start * std::exp(scale * u) : start + scale * u;
  return std::clamp(x, low, high);
}

double FitParameter::u(double x) const {
  x = std::clamp(x, low, high);
  return logarithmic ? std::log(x / start) / scale : (x - start) / scale;
}

double FitParameter::valueSigma(double u, double sigma) const {
  return std::abs(scale) * sigma * (logarithmic ? std::abs(value(u)) : 1.0);
}

const JointScales& scalesOf(const std::vector<JointScales>& scales, int joint) {
  return joint == 0 ? scales.back() : scales[static_cast<std::size_t>(joint - 1)];
}

FitModel::FitModel(const robot::Description& nominal, const std::vector<JointScales>& scales)
    : nominal_(nominal), rigid_(nominal.drive == robot::DriveType::kRigid), scales_(scales) {
  addBase();
  for (const Hypothesis& hypothesis : hypotheses())
    for (int joint = 1; joint <= nominal.size(); ++joint) {
      const robot::EffectFacts& facts = *hypothesis.facts;
      if (facts.whole || !(rigid_ ? facts.rigid : facts.cable)) continue;
      if (hypothesis.background(scalesOf(scales_, joint)) > 0.0) addTerm(backgroundTerm(hypothesis, joint));
    }
}

void FitModel::addFactor(Number number, const char* name, const char* unit, int joint, double nominal,
                         const Spread& spread) {
  if (!(nominal > 0.0)) return;
  base_.emplace_back(number, joint);
  parameters_.push_back({name, unit, joint + 1, nominal, spread.sigma, true, nominal / spread.most,
                         nominal * spread.most, 1.0});
}

void FitModel::addBase() {
  for (int i = 0; i < nominal_.size(); ++i) {
    const robot::Joint& joint = nominal_.joints[static_cast<std::size_t>(i)];
    const robot::Drive& drive = nominal_.drives[static_cast<std::size_t>(i)];
    if (!rigid_) {
      addFactor(Number::kStiffness, "cable_stiffness", "N", i, drive.cable_stiffness, kConstants);
      addFactor(Number::kDamping, "cable_damping", "N*s/m", i, drive.cable_damping, kConstants);
    }
    const bool turns = joint.type == robot::JointType::kRevolute;
    addFactor(Number::kCoulomb, "coulomb", turns ? "N*m" : "N", i, joint.friction.coulomb, kConstants);
    addFactor(Number::kViscous, "viscous", turns ? "N*m*s/rad" : "N*s/m", i, joint.friction.viscous,
              kConstants);
    addFactor(Number::kMass, "mass", "kg", i, joint.link.mass, kMasses);
    const double arm = joint.link.centre_of_mass.norm();
    constexpr const char* kNames[] = {"centre_of_mass x", "centre_of_mass y", "centre_of_mass z"};
    for (int axis = 0; axis < 3 && arm > 0.0; ++axis) {
      const double nominal = joint.link.centre_of_mass[axis];
      base_.emplace_back(static_cast<Number>(static_cast<int>(Number::kCentreX) + axis), i);
      parameters_.push_back({kNames[axis], "m", i + 1, nominal, kCentreSigma * arm, false,
                             nominal - kMostCentre * arm, nominal + kMostCentre * arm, 1.0});
    }
  }
}

EffectTerm FitModel::backgroundTerm(const Hypothesis& hypothesis, int joint) const {
  const JointScales& scales = scalesOf(scales_, joint);
  const std::vector<double>& neutral = hypothesis.neutral;
  const std::vector<EffectStart> starts = hypothesis.starts(scales, joint);
  EffectTerm term{&hypothesis, joint, starts[starts.size() / 2], true, {}};
  for (std::size_t k = 0; k < neutral.size(); ++k) {
    if (neutral[k] != 0.0) continue;  // a shape parameter: free, as in the effect
    term.start.value[k] = 0.0;
    term.start.scale[k] = hypothesis.background(scales);
  }
  return term;
}

/// Least and largest value of number k in all starts of the effect, and in that of the term.
std::pair<double, double> FitModel::shapesOf(const EffectTerm& term, std::size_t k) const {
  double least = term.start.value[k], most = least;
  for (const EffectStart& start : term.hypothesis->starts(scalesOf(scales_, term.joint), term.joint)) {
    least = std::min(least, start.value[k]);
    most = std::max(most, start.value[k]);
  }
  return {least, most};
}

void FitModel::addTerm(EffectTerm term) {
  const auto& numbers = term.hypothesis->facts->parameters;
  CAPSTAN_CHECK(term.start.value.size() == numbers.size() && term.start.scale.size() == numbers.size());
  term.index.assign(numbers.size(), -1);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double start = term.start.value[k], scale = term.start.scale[k];
    if (scale == 0.0) continue;
    FitParameter p{fmt::format("{}.{}", term.hypothesis->name(), numbers[k].name),
                   std::string(numbers[k].unit),
                   term.joint,
                   start,
                   scale,
                   false,
                   numbers[k].low,
                   numbers[k].high,
                   kEffectPrior};
    if (k < term.hypothesis->least.size()) p.low = std::max(p.low, term.hypothesis->least[k]);
    if (isEventTime(numbers[k])) {
      std::tie(p.low, p.high) = eventTimes(scalesOf(scales_, term.joint));
      p.prior = (p.high - p.low) / scale;
    } else if (term.background && start == 0.0) {
      p.low = std::max(p.low, -scale);
      p.high = std::min(p.high, scale);
      p.prior = kBackgroundPrior;
    } else if (start > 0.0 && numbers[k].low > 0.0) {  // a speed, duration or length, which is never zero
      p.logarithmic = true;
      p.scale = scale / start;
      const auto [least, most] = term.background ? std::pair(start, start) : shapesOf(term, k);
      p.low = std::max(p.low, least / kFarShape);
      p.high = std::min(p.high, most * kFarShape);
    }
    term.index[k] = size();
    parameters_.push_back(std::move(p));
  }
  term.begun = term.hypothesis->begun ? addBegun(term) : -1;
  effects_.push_back(std::move(term));
}

int FitModel::addBegun(const EffectTerm& term) {
  const BegunShare& begun = *term.hypothesis->begun;
  parameters_.push_back({fmt::format("{}.begun", term.hypothesis->name()), "", term.joint, begun.start,
                         begun.scale, false, begun.low, begun.high, 1.0});
  return size() - 1;
}

FitModel FitModel::rebuilt(std::vector<EffectTerm> terms) const {
  FitModel model = *this;
  model.parameters_.resize(base_.size());
  model.effects_.clear();
  for (EffectTerm& term : terms) model.addTerm(std::move(term));
  return model;
}

bool FitModel::has(const Hypothesis& hypothesis, int joint) const {
  return std::any_of(effects_.begin(), effects_.end(), [&](const EffectTerm& term) {
    return term.hypothesis == &hypothesis && term.joint == joint && !term.background;
  });
}

FitModel FitModel::with(const Hypothesis& hypothesis, int joint, const EffectStart& start) const {
  std::vector<EffectTerm> terms = effects_;
  std::erase_if(terms, [&](const EffectTerm& term) {
    return term.background && term.hypothesis == &hypothesis && term.joint == joint;
  });
  terms.push_back({&hypothesis, joint, start, false, {}});
  return rebuilt(std::move(terms));
}

FitModel FitModel::without(const Hypothesis& hypothesis, int joint) const {
  std::vector<EffectTerm> terms = effects_;
  std::erase_if(terms, [&](const EffectTerm& term) {
    return !term.background && term.hypothesis == &hypothesis && term.joint == joint;
  });
  if (joint > 0 && hypothesis.background(scalesOf(scales_, joint)) > 0.0)
    terms.push_back(backgroundTerm(hypothesis, joint));
  return rebuilt(std::move(terms));
}

robot::Description FitModel::refitted(const Eigen::VectorXd& u) const {
  robot::Description robot = nominal_;
  for (std::size_t k = 0; k < base_.size(); ++k) {
    const auto at = static_cast<std::size_t>(base_[k].second);
    robot::Joint& joint = robot.joints[at];
    const double value = parameters_[k].value(u[static_cast<Eigen::Index>(k)]);
    switch (base_[k].first) {
      case Number::kStiffness:
        robot.drives[at].cable_stiffness = value;
        break;
      case Number::kDamping:
        robot.drives[at].cable_damping = value;
        break;
      case Number::kCoulomb:
        joint.friction.coulomb = value;
        break;
      case Number::kViscous:
        joint.friction.viscous = value;
        break;
      case Number::kMass:
        joint.link.inertia *= value / joint.link.mass;
        joint.link.mass = value;
        break;
      case Number::kCentreX:
      case Number::kCentreY:
      case Number::kCentreZ:
        joint.link.centre_of_mass[static_cast<int>(base_[k].first) - static_cast<int>(Number::kCentreX)] =
            value;
        break;
    }
  }
  return robot;
}

std::vector<double> FitModel::effectValues(std::size_t k, const Eigen::VectorXd& u) const {
  const EffectTerm& term = effects_[k];
  std::vector<double> values = term.start.value;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const int at = term.index[i]; at >= 0)
      values[i] = parameters_[static_cast<std::size_t>(at)].value(u[at]);
  return values;
}

robot::Description FitModel::extended(const Eigen::VectorXd& u) const {
  robot::Description robot = refitted(u);
  for (std::size_t k = 0; k < effects_.size(); ++k) robot.effects.push_back(effect(k, u));
  return robot;
}

robot::Effect FitModel::effect(std::size_t k, const Eigen::VectorXd& u) const {
  const std::vector<double> values = effectValues(k, u);
  robot::Effect effect{std::string(effects_[k].hypothesis->name()), effects_[k].joint, {}};
  const auto& numbers = effects_[k].hypothesis->facts->parameters;
  for (std::size_t i = 0; i < values.size(); ++i)
    effect.values.push_back({std::string(numbers[i].name), values[i]});
  return effect;
}

robot::ChainModel FitModel::chain(const Eigen::VectorXd& u) const {
  robot::ChainModel model(extended(u));
  for (const EffectTerm& term : effects_)
    if (term.begun >= 0)
      model.numbers.joints[term.joint - 1].*term.hypothesis->begun->number =
          parameters_[static_cast<std::size_t>(term.begun)].value(u[term.begun]);
  return model;
}

Eigen::VectorXd FitModel::carry(const FitModel& other, const Eigen::VectorXd& u_other) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(size());
  for (int k = 0; k < size(); ++k) {
    const FitParameter& p = parameters_[static_cast<std::size_t>(k)];
    for (int j = 0; j < other.size(); ++j) {
      const FitParameter& o = other.parameters_[static_cast<std::size_t>(j)];
      if (o.name == p.name && o.joint == p.joint) u[k] = p.u(o.value(u_other[j]));
    }
  }
  return u;
}

Eigen::VectorXd FitModel::startFrom(const FitModel& other, const Eigen::VectorXd& u_other) const {
  Eigen::VectorXd u = carry(other, u_other);
  for (const EffectTerm& term : effects_) {
    if (term.background || other.has(*term.hypothesis, term.joint)) continue;
    for (const int at : term.index)
      if (at >= 0) u[at] = 0.0;
    if (term.begun >= 0) u[term.begun] = 0.0;
  }
  return u;
}

double FitModel::logPrior(const Eigen::VectorXd& u) const {
  double squares = 0.0;
  const auto add = [&](double x) { squares += x * x; };
  for (int k = 0; k < baseSize(); ++k) add(u[k] / parameters_[static_cast<std::size_t>(k)].prior);
  for (const EffectTerm& term : effects_)
    for (std::size_t i = 0; i < term.index.size(); ++i) {
      if (term.index[i] < 0 || term.hypothesis->neutral[i] != 0.0) continue;
      if (isEventTime(term.hypothesis->facts->parameters[i])) continue;
      const FitParameter& p = parameters_[static_cast<std::size_t>(term.index[i])];
      add(p.value(u[term.index[i]]) /
          ((term.background ? kBackgroundPrior : kEffectPrior) * term.start.scale[i]));
    }
  return -0.5 * squares;
}

Eigen::VectorXd FitModel::clipped(const Eigen::VectorXd& u) const {
  Eigen::VectorXd kept = u;
  for (int k = 0; k < size(); ++k) {
    const FitParameter& p = parameters_[static_cast<std::size_t>(k)];
    const double a = p.u(p.low), b = p.u(p.high);
    kept[k] = std::clamp(u[k], std::min(a, b), std::max(a, b));
  }
  return kept;
}

}  // namespace capstan::diagnosis
