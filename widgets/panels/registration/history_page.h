#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "core/registration/registration_history.h"
#include "widgets/figures/theme.h"

class QLabel;
class QPushButton;
class QTableWidget;

namespace capstan::widgets {

/// History of registrations, newest first: compares two of them, or one with the registration in use; puts an
/// earlier one in use again; writes and reads registration files.
class HistoryPage : public QWidget {
  Q_OBJECT

 public:
  explicit HistoryPage(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Shows the entries of a history, oldest first.
  void setEntries(std::vector<registration::HistoryEntry> entries);
  /// Sets the session's robot; none: no session, so that nothing can be put in use.
  void setRobot(const std::optional<robot::Description>& robot);
  /// Sets the registration in use.
  void setCurrent(const std::optional<Eigen::Isometry3d>& current);
  /// Shows why the history cannot be read or written; empty: it can.
  void showFault(const QString& fault);

  const std::vector<registration::HistoryEntry>& entries() const { return entries_; }
  /// Selects entries by their index in entries().
  void select(const std::vector<std::size_t>& entries);
  QString comparison() const;
  QString fault() const;
  /// Writes the selected entry as a registration file. The page shows errors.
  void exportTo(const QString& file);
  /// Reads a registration file and asks for its use. The page shows errors.
  void importFrom(const QString& file);

 signals:
  /// Requests that an earlier registration, or one of a file, is put in use.
  void useRequested(const capstan::registration::HistoryEntry& entry);

 private:
  enum Column { kDate, kDecision, kMethod, kResidual, kPoints, kReason, kColumns };

  void makeTable();
  QWidget* makeButtons();
  void fillRow(int row);
  void refresh();
  std::vector<std::size_t> selected() const;
  const registration::HistoryEntry* chosen() const;
  QString comparisonText() const;
  QString whyNotUsed() const;
  void restore();

  Theme theme_ = Theme::dark();
  std::vector<registration::HistoryEntry> entries_;
  std::optional<robot::Description> robot_;
  std::optional<Eigen::Isometry3d> current_;
  QTableWidget* table_;
  QLabel *comparison_, *fault_;
  QPushButton *restore_, *export_, *import_;
};

}  // namespace capstan::widgets
