#pragma once

#include <QFrame>

#include "widgets/figures/theme.h"

class QLabel;

namespace capstan::widgets {

/// A line above the plots for an error and its remedy. It stays until it is closed, and covers nothing.
class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Shows a message. `about`: its subject, by which settle() removes it.
  void showMessage(const QString& text, const QString& about = {});
  /// The subject has succeeded since: hides the message if it is about this subject.
  void settle(const QString& about);
  QString message() const;

 private:
  QLabel* text_;
  QString about_;
};

}  // namespace capstan::widgets
