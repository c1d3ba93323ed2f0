#pragma once

#include <QString>
#include <optional>

#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::widgets {

/// Texts that explain why a robot is in use.
struct RobotWords {
  QString word;     ///< "identified", "diagnosed"
  QString origin;   ///< method that found it: "the dual UKF over 30 s of …"
  QString summary;  ///< what changed
};

/// The robot that a user chose in place of the source's own, by identification or diagnosis. The choice
/// belongs to an arm: it stays in use when the session restarts and with other sources of the same arm, until
/// another robot is chosen. An arm is identified by its robot file and, if simulated, its truth file.
class RobotChoice {
 public:
  /// Chooses `robot` for the arm of `source`. Choosing the source's own robot clears the choice.
  void choose(const tracking::SourceInfo& source, const robot::Description& robot, const RobotWords& words);
  /// The chosen robot if it belongs to the arm of `source`, else null: the source's own is used.
  const robot::Description* robotFor(const tracking::SourceInfo& source) const;

  /// Whether the source's own robot is the chosen one, as in a recording that was made with it.
  bool isOwnOf(const tracking::SourceInfo& source) const;

  /// Name of the robot in use with `source`: "RAVEN-II left, identified".
  QString words(const tracking::SourceInfo& source) const;
  QString origin() const { return chosen_ ? chosen_->words.origin : QString(); }
  QString summary() const { return chosen_ ? chosen_->words.summary : QString(); }
  bool any() const { return chosen_.has_value(); }

 private:
  struct Chosen {
    std::string arm;
    robot::Description robot;
    RobotWords words;
  };
  std::optional<Chosen> chosen_;
};

}  // namespace capstan::widgets
