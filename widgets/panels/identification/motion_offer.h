#pragma once

#include <QWidget>
#include <optional>

#include "core/identification/better_motion.h"

class QLabel;
class QPushButton;

namespace capstan::widgets {

/// Offers a motion that determines weak parameters: first to find it, then to drive it.
class MotionOffer : public QWidget {
  Q_OBJECT

 public:
  explicit MotionOffer(QWidget* parent = nullptr);
  /// Sets whether the robot can be driven from here.
  void setDrivable(bool drivable);
  /// Sets whether parameters are weak, so that the offer is shown; otherwise forgets the proposal.
  void setWeak(bool weak);
  /// A motion is being looked for.
  void setSearching(bool searching);
  void setProposal(std::optional<identification::MotionProposal> proposal);
  bool searching() const { return searching_; }
  QString words() const;
  QPushButton& button() { return *button_; }

 signals:
  void proposeRequested();
  void driveRequested(const capstan::identification::SinusoidMotion& motion, const QString& words);

 private:
  void press();
  void refresh();

  bool drivable_ = false, searching_ = false;
  std::optional<identification::MotionProposal> proposal_;
  QLabel* words_;
  QPushButton* button_;
};

}  // namespace capstan::widgets
