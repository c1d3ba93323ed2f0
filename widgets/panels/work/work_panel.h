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

/// What panels share that work in the background: a picker beside the button that begins, a headline with its
/// summary, the body, and below it words about what was done, progress, and buttons for what came of it. F5
/// begins, Esc cancels, keys act as their buttons do: only where these are shown and enabled.
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
  /// From the top to the bottom, each once.
  void addHead(QWidget* picker, QPushButton* begin, const QString& accessible_name);
  void addBody(QWidget* body);
  void addFoot(const std::vector<QPushButton*>& buttons, const QString& accessible_name);

  void addKey(const QString& sequence, std::function<void()> act);
  void addKey(const QString& sequence, QPushButton* pressed);

  void styleWords(const Theme& theme);
  /// The body is shown where there is something in it.
  void showHead(const QString& headline, const QString& summary, bool body);
  /// Nothing where they are empty.
  void showWords(const QString& words, const QString& tip = {});
  void showProgress(bool shown);
  void beginProgress(const QString& doing);
  void onProgress(double fraction, const QString& doing);

 private:
  QVBoxLayout* column_;
  QPushButton* begin_ = nullptr;
  QLabel *headline_, *summary_, *words_;
  QWidget *body_ = nullptr, *rest_;  ///< `rest_` takes the body's room while there is nothing in it
  QProgressBar* progress_;
};

}  // namespace capstan::widgets
