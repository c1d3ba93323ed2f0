#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Parameters of the nominal model after the refit, without and with the effects of the model; without
/// effects one value alone. Those that changed are first and bold. The change of those at the bound of what
/// the refit allows is marked.
class RefitTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kName, kNominal, kWithout, kValue, kChange, kColumns };

  explicit RefitTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  void fitNames();
  void addNumber(const diagnosis::RefitNumber& number);

  Theme theme_ = Theme::dark();
  std::vector<diagnosis::RefitNumber> numbers_;
  bool effects_ = false;  ///< the model has effects
};

}  // namespace capstan::widgets
