#pragma once

#include <QDialog>

namespace capstan::widgets {

/// The manual of resources/manual in a non-modal window with a search line.
class HelpWindow : public QDialog {
  Q_OBJECT

 public:
  explicit HelpWindow(QWidget* parent = nullptr);
  /// The manual as plain text; empty if it was not found.
  QString text() const;

 private:
  class Pages;
  void find(const QString& words);

  Pages* pages_;
};

}  // namespace capstan::widgets
