#pragma once

#include <QObject>

#include "widgets/figures/joint_figure.h"

namespace capstan::widgets {

/// Two figures of one motion: time range and cursor of either follow those of the other. `offset`: time in
/// `second` minus time in `first` at the same place of the motion [s].
class LinkedFigures : public QObject {
  Q_OBJECT

 public:
  LinkedFigures(JointFigure& first, JointFigure& second, double offset, QObject* parent = nullptr);

 private:
  void follow(JointFigure& from, JointFigure& to, double offset);

  bool moving_ = false;
};

}  // namespace capstan::widgets
