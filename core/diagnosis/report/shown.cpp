#include "core/diagnosis/report/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace capstan::diagnosis {
namespace {

/// Names of parameters without a unit that are not shares: counts, and numbers that choose a form of a law.
constexpr std::array<std::string_view, 2> kCounts = {"other", "present"};
constexpr std::array<std::string_view, 3> kForms = {"at_motor", "of_length", "damping"};

/// What the shares among the parameters are shares of.
struct ShareName {
  std::string_view effect, parameter, name;
};
constexpr std::array kShareNames = {
    ShareName{"pulley_radius", "share", "increase of the link radius"},
    ShareName{"position_stiffness", "share", "change from mid-range to the upper limit"},
    ShareName{"cable_creep", "share", "creep as a share of the elastic stretch"},
    ShareName{"stribeck_friction", "excess", "friction at rest above Coulomb friction"},
    ShareName{"asymmetric_friction", "share", "excess of Coulomb friction forwards, deficit backwards"},
    ShareName{"asymmetric_viscosity", "share", "excess of viscous friction forwards, deficit backwards"},
    ShareName{"load_friction", "share", "friction as a share of the driving torque"},
    ShareName{"position_friction", "sine", "sine as a share of Coulomb friction"},
    ShareName{"position_friction", "cosine", "cosine as a share of Coulomb friction"},
    ShareName{"actuator_gain", "share", "torque above its command"},
    ShareName{"camera_scale", "share", "excess of lengths in the camera measurements"}};

bool isCount(const FoundParameter& parameter) {
  return parameter.unit.empty() && std::ranges::find(kCounts, parameter.name) != kCounts.end();
}

bool isForm(const FoundParameter& parameter) {
  return parameter.unit.empty() && std::ranges::find(kForms, parameter.name) != kForms.end();
}

bool isShare(const FoundParameter& parameter) {
  return parameter.unit.empty() && !isCount(parameter) && !isForm(parameter);
}

}  // namespace

std::string shownValue(const FoundParameter& parameter) {
  if (isShare(parameter)) return shownNumber(parameter.value, parameter.sigma, {100.0, "%"});
  if (isCount(parameter)) return fmt::format("{:.0f}", parameter.value);
  std::string shown = shownNumber(parameter.value, parameter.sigma, parameter.unit);
  if (const double scale = parameter.joint_per_length; scale != 0.0)
    shown += " of cable (" + shownNumber(scale * parameter.value, scale * parameter.sigma, "rad") +
             " at the joint)";
  return shown;
}

std::string shownName(std::string_view parameter) {
  std::string name(parameter);
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string shownName(std::string_view effect, std::string_view parameter) {
  for (const ShareName& one : kShareNames)
    if (one.effect == effect && one.parameter == parameter) return std::string(one.name);
  return shownName(parameter);
}

std::string shownParameter(std::string_view effect, const FoundParameter& parameter) {
  return shownName(effect, parameter.name) + " " + shownValue(parameter) +
         (parameter.at_bound ? " (at its bound)" : "");
}

std::string shownJoint(std::string_view effect, int joint) {
  if (joint > 0) return fmt::format("joint {}", joint);
  return effect.starts_with("camera") || effect.starts_with("marker") ? "cameras" : "whole arm";
}

std::string shareWords(double share) {
  struct Words {
    double from;
    std::string_view words;
  };
  constexpr std::array kWords = {Words{0.95, "nearly all of it"},  Words{0.8, "most of it"},
                                 Words{0.6, "two thirds of it"},   Words{0.42, "about half of it"},
                                 Words{0.29, "a third of it"},     Words{0.23, "a quarter of it"},
                                 Words{0.16, "a fifth of it"},     Words{0.08, "a tenth of it"},
                                 Words{0.03, "a twentieth of it"}, Words{0.01, "hardly any of it"}};
  const auto found = std::ranges::find_if(kWords, [share](const Words& w) { return share >= w.from; });
  return std::string(found == kWords.end() ? "no significant part of it" : found->words);
}

std::string shareWords(const Signature& signature) {
  return shareWords(signature.share > 2.0 * signature.share_sigma ? signature.share : 0.0);
}

base::TableColumn textColumn(std::string name) {
  return {std::move(name), {}, 0, base::NumberStyle::kFixed, false};
}

}  // namespace capstan::diagnosis
