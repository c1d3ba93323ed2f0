#pragma once

#include <QWidget>
#include <functional>
#include <vector>

#include "widgets/figures/theme.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace capstan::widgets {

/// Base class of panels with background work: a picker beside the button that starts the work, a headline
/// with a summary, the body, and below it a message, the progress, and buttons for the results. F5 starts,
/// Esc cancels. A key acts as its button: only while the button is shown and enabled.
class WorkPanel : public QWidget {
  Q_OBJECT

 public:
  virtual void cancel() = 0;
  virtual bool busy() const = 0;

  QString headline() const;
  QString summary() const;
  QString words() const;

 protected:
  explicit WorkPanel(QWidget* parent);

  QPushButton* button(const QString& name, const QString& words, const QString& tip,
                      std::function<void()> pressed);
  /// Add the parts from top to bottom; call each once.
  void addHead(QWidget* picker, QPushButton* begin, const QString& accessible_name);
  void addBody(QWidget* body);
  void addFoot(const std::vector<QPushButton*>& buttons, const QString& accessible_name);

  void addKey(const QString& sequence, std::function<void()> act);
  void addKey(const QString& sequence, QPushButton* pressed);

  void styleWords(const Theme& theme);
  /// Shows headline and summary, and the body if `body`.
  void showHead(const QString& headline, const QString& summary, bool body);
  /// Shows a message; empty: none.
  void showWords(const QString& words, const QString& tip = {});
  void showProgress(bool shown);
  void beginProgress(const QString& doing);
  void onProgress(double fraction, const QString& doing);

 private:
  QVBoxLayout* column_;
  QPushButton* begin_ = nullptr;
  QLabel *headline_, *summary_, *words_;
  QWidget *body_ = nullptr, *rest_;  ///< `rest_` fills the body's room while it is hidden
  QProgressBar* progress_;
};

}  // namespace capstan::widgets
