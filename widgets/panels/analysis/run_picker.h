#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"

class QComboBox;
class QLabel;
class QSettings;
class QToolButton;

namespace capstan::widgets {

/// Source of the errors of a run; saved in the settings.
struct RunChoice {
  enum class Kind { kNone, kSession, kRecording, kResults };

  Kind kind = Kind::kNone;
  QString path = {};   ///< path of a recording, or folder of results
  QString trial = {};  ///< trial of results; empty: the first
  QString robot = {};  ///< for a recording: robot file of the estimator; empty: the recording's own

  bool operator==(const RunChoice&) const = default;
  void save(QSettings& settings, const QString& key) const;
  static RunChoice restore(const QSettings& settings, const QString& key, Kind otherwise);
};

/// One line to choose a run: its letter, the kind of source, the chosen file or folder, trial or robot.
class RunPicker : public QWidget {
  Q_OBJECT

 public:
  /// `may_be_none`: "nothing" is among the kinds.
  RunPicker(const QString& letter, bool may_be_none, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  const RunChoice& choice() const { return choice_; }
  /// Shows `choice`; emits no signal.
  void setChoice(const RunChoice& choice);
  /// Sets the trials of the results that were read, and the one in use.
  void setTrials(const QStringList& trials, const QString& current);

  /// Opens a non-modal dialog for a file or folder of this kind.
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
