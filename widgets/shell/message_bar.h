#pragma once

#include <QFrame>

#include "widgets/figures/theme.h"

class QLabel;

namespace capstan::widgets {

/// A line above the plots that says what went wrong and what to do; stays until it is closed, never in the
/// way.
class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showMessage(const QString& text);
  QString message() const;

 private:
  QLabel* text_;
};

}  // namespace capstan::widgets
