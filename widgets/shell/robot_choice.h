#pragma once

#include <QString>
#include <optional>

#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::widgets {

/// Why a robot is in use, in words.
struct RobotWords {
  QString word;     ///< "identified", "diagnosed"
  QString origin;   ///< what found it: "the dual UKF over 30 s of …"
  QString summary;  ///< what changed
};

/// The robot that somebody put to use in place of the one that the source brings: by identification or
/// diagnosis. It belongs to an arm and stays in use, through a session that begins again and through other
/// sources of the same arm, until somebody chooses another. One arm is one robot file and, where it is
/// simulated, one truth file.
class RobotChoice {
 public:
  /// For the arm of `source`, whose own robot takes the choice back.
  void choose(const tracking::SourceInfo& source, const robot::Description& robot, const RobotWords& words);
  /// The chosen robot where it belongs to the arm of `source`, else null: the source's own.
  const robot::Description* robotFor(const tracking::SourceInfo& source) const;

  /// "RAVEN-II left, identified": what is in use with `source`.
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
