#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"

class QLabel;
class QLineEdit;

namespace capstan::widgets {

/// One line to enter the tolerance: the smallest displacement that makes an effect a cause. A text that
/// diagnosis::parseTolerance() refuses has its error beside it.
class ToleranceEdit : public QWidget {
  Q_OBJECT

 public:
  explicit ToleranceEdit(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  QString text() const;
  /// Shows `text`; emits no signal.
  void setText(const QString& text);
  /// Error of the present text; empty: none.
  const QString& error() const { return error_; }

 signals:
  void changed();

 private:
  void check();

  Theme theme_ = Theme::dark();
  QLineEdit* edit_;
  QLabel *name_, *words_;
  QString error_;
};

}  // namespace capstan::widgets
