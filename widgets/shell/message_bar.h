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
  /// `about` names what it is of, so that settle() takes it away.
  void showMessage(const QString& text, const QString& about = {});
  /// What the message is about has succeeded since: it goes, if it is still that one.
  void settle(const QString& about);
  QString message() const;

 private:
  QLabel* text_;
  QString about_;
};

}  // namespace capstan::widgets
