#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"

class QComboBox;
class QLabel;
class QSettings;
class QToolButton;

namespace capstan::widgets {

/// Where the errors of a run come from; kept between starts.
struct RunChoice {
  enum class Kind { kNone, kSession, kRecording, kResults };

  Kind kind = Kind::kNone;
  QString path = {};   ///< of a recording, or folder of results
  QString trial = {};  ///< of results; empty: the first
  QString robot = {};  ///< robot file that the estimator assumes, of a recording; empty: its own

  bool operator==(const RunChoice&) const = default;
  void save(QSettings& settings, const QString& key) const;
  static RunChoice restore(const QSettings& settings, const QString& key, Kind otherwise);
};

/// One line that chooses a run: its letter, the kind of source, what was chosen, trial or robot.
class RunPicker : public QWidget {
  Q_OBJECT

 public:
  /// `may_be_none`: "nothing" is among the kinds.
  RunPicker(const QString& letter, bool may_be_none, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  const RunChoice& choice() const { return choice_; }
  /// Shows `choice`, without a signal.
  void setChoice(const RunChoice& choice);
  /// Trials of the results just read, and which of them it was.
  void setTrials(const QStringList& trials, const QString& current);

  /// Asks for a file or folder of the kind, beside the program's other windows.
  void ask(RunChoice::Kind kind);

 signals:
  void changed();

 private:
  void choose(const RunChoice& choice);
  void askRobot();
  void onKind(int index);
  void refresh();
  QString words() const;

  RunChoice choice_;
  QLabel *letter_, *what_;
  QComboBox *kind_, *trial_;
  QToolButton *browse_, *robot_;
};

}  // namespace capstan::widgets
