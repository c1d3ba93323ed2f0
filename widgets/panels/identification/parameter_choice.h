#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "core/identification/parameters.h"
#include "widgets/figures/theme.h"

class QCheckBox;
class QLabel;

namespace capstan::widgets {

/// What is to be identified: pulley radius, stiffness, damping and friction by joint.
class ParameterChoice : public QWidget {
  Q_OBJECT

 public:
  explicit ParameterChoice(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// As identification::ParameterSet takes them, r_l1,k_e2…; empty: nothing is ticked.
  std::string names() const;
  /// Ticks those of `names`, as ParameterSet takes them, and no others.
  void setNames(const std::string& names);
  QCheckBox& box(identification::Quantity quantity, int joint) const;

 signals:
  void changed();

 private:
  std::vector<QCheckBox*> boxes_;  ///< quantity by quantity
  std::vector<QLabel*> heads_;
};

}  // namespace capstan::widgets
