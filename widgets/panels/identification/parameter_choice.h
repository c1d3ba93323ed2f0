#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "core/identification/parameters.h"
#include "widgets/figures/theme.h"

class QCheckBox;
class QLabel;

namespace capstan::widgets {

/// Check boxes for the twelve parameters to identify, by name: pulley radius, stiffness, damping and friction
/// of each joint.
class ParameterChoice : public QWidget {
  Q_OBJECT

 public:
  explicit ParameterChoice(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Checked parameters in the format of identification::ParameterSet, r_l1,k_e2…; empty: none is checked.
  std::string names() const;
  /// Checks exactly the parameters in `names`, in the format of ParameterSet.
  void setNames(const std::string& names);
  QCheckBox& box(identification::Quantity quantity, int joint) const;

 signals:
  void changed();

 private:
  std::vector<QCheckBox*> boxes_;  ///< the boxes, quantity by quantity
  std::vector<QLabel*> heads_;
};

}  // namespace capstan::widgets
