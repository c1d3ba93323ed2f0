#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Parameters of the nominal model after the refit, in two columns: refitted without the effects and together
/// with them; one column if the model has no effects. Parameters whose change is significant and material
/// are first and bold, then those that moved. If a parameter is at the limit that the refit allows, its
/// change says so.
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
  QString tipOf(const diagnosis::RefitNumber& number) const;
  void addLegend();
  void addNumber(const diagnosis::RefitNumber& number);

  Theme theme_ = Theme::dark();
  std::vector<diagnosis::RefitNumber> numbers_;
  diagnosis::Tolerance tolerance_;
  bool effects_ = false;  ///< the model has effects
};

}  // namespace capstan::widgets
