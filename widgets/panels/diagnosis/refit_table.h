#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Numbers of the nominal model after the refit, before any cause was looked for: what moved stands first and
/// strong, what would go further than a mistuned number may has a word.
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
