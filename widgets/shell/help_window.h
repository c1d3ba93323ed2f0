#pragma once

#include <QDialog>

#include "widgets/shell/help_topics.h"

namespace capstan::widgets {

/// The manual of resources/manual in a non-modal window with a search line.
class HelpWindow : public QDialog {
  Q_OBJECT

 public:
  explicit HelpWindow(QWidget* parent = nullptr);
  /// Shows a page of the manual with its section at the top.
  void show(const HelpTopic& topic);
  using QDialog::show;
  /// The page as plain text; empty if the manual was not found.
  QString text() const;
  /// Heading at or above the top of the view; empty: none.
  QString section() const;

 private:
  class Pages;
  void find(const QString& words);
  void open(const QString& page);

  Pages* pages_;
};

}  // namespace capstan::widgets
