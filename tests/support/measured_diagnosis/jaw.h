#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/selection/selection.h"
#include "core/robot/description.h"
#include "tests/support/measured_diagnosis/steps.h"

namespace capstan::measured {

/// RMS errors of the jaw angle [deg].
struct JawErrors {
  double even = 0.0;           ///< over the recordings under even load levels, with one encoder zero for all
  double odd = 0.0;            ///< over those under odd levels, with that zero
  double odd_zero_each = 0.0;  ///< likewise, with a zero fitted for each of them
};

struct JawStep {
  std::string name;
  std::vector<std::string> competitors;  ///< as in Step
  robot::Description robot;
  JawErrors errors;
};

/// One jaw of a da Vinci Si instrument (O'Neill, Stephens, Kowalewski 2018): effects are selected, and
/// numbers fitted, on recordings under even load levels. The jaw's encoder has one zero for all recordings,
/// which is not known: a zero for each would take with it the stretch under loads that are constant in each.
class Jaw {
 public:
  /// The recordings NAME_<frequency>Hz_load<level>.csv of `folder` at these frequencies ("0.1", "0.3").
  Jaw(const std::filesystem::path& folder, const std::vector<std::string>& frequencies, int threads);

  diagnosis::Selection select(const diagnosis::SearchOptions& options) const;
  /// From a rigid gear on, each effect of the selection, by what it is worth.
  std::vector<JawStep> steps(const diagnosis::Selection& selection) const;
  /// Effects that were selected on another jaw, their numbers fitted to this one: from those of the other
  /// jaw, and one effect after another; the better fit counts.
  JawStep transferred(const diagnosis::Selection& other) const;
  /// Least squares on even levels: columns 1, spindle angle, load, direction of motion, load × direction, and
  /// for `terms` 7 speed and spindle torque. `terms` is 2, 3, 5 or 7, the constant counted.
  JawErrors regression(int terms) const;

 private:
  JawErrors errorsOf(const diagnosis::Fit& whole) const;
  JawStep stepOf(const Step& step) const;

  robot::Description nominal_;
  int threads_;
  std::vector<diagnosis::Evidence> even_, odd_;
  std::unique_ptr<diagnosis::FitData> fitted_, even_known_, odd_known_, odd_each_;
  diagnosis::FitModel base_;
};

/// Folders of `data` with recordings of a jaw, sorted.
std::vector<std::filesystem::path> jawFolders(const std::filesystem::path& data);

}  // namespace capstan::measured
