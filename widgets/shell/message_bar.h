#pragma once

#include <QFrame>
#include <functional>
#include <vector>

#include "widgets/figures/theme.h"

class QHBoxLayout;
class QLabel;
class QToolButton;

namespace capstan::widgets {

/// A button beside a message.
struct MessageAction {
  QString text;
  std::function<void()> act;
};

/// A line above the plots: an error and its remedy, or news with buttons for what may be done next. It stays
/// until it is closed, and covers nothing.
class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Shows a message. `about`: its subject, by which settle() removes it.
  void showMessage(const QString& text, const QString& about = {});
  /// Shows news, which are no fault, with a button for each action, which also closes the message.
  void showNews(const QString& text, const std::vector<MessageAction>& actions);
  /// Replaces the text of the message that is shown.
  void setText(const QString& text);
  /// The subject has succeeded since: hides the message if it is about this subject.
  void settle(const QString& about);
  QString message() const;
  /// The subject of the message that is shown.
  QString about() const { return isHidden() ? QString() : about_; }

 private:
  void put(const QString& text, const QString& about, bool fault);

  Theme theme_ = Theme::dark();
  QHBoxLayout* row_;
  QLabel* text_;
  QString about_;
  bool fault_ = true;
  std::vector<QToolButton*> buttons_;
};

}  // namespace capstan::widgets
