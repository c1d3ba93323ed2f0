#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Parameters of the nominal model after the refit, before the search for causes. Those that changed are
/// first and bold. A remark marks those at the bound of the change that the refit allows.
class RefitTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kName, kNominal, kValue, kChange, kRemark, kColumns };

  explicit RefitTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);

 private:
  void fill();

  Theme theme_ = Theme::dark();
  std::vector<diagnosis::RefitNumber> numbers_;
};

}  // namespace capstan::widgets
