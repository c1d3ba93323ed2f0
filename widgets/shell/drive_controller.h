#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QTimer>
#include <memory>

#include "core/live/robot_commands.h"
#include "widgets/panels/registration/registration_panel.h"

class QDockWidget;

namespace capstan::widgets {

class NotesPanel;
class SessionLink;
class StatusLine;

/// Commands to the real robot of a live session, by the registration panel's bar, F8 (held: drive) and F9
/// (stop, wherever the keyboard focus is). Stops where the program loses the focus, the session does not run
/// or ends, or the panel is closed. What happens is in the status line and the notes.
class DriveController : public QObject {
  Q_OBJECT

 public:
  struct Views {
    RegistrationPanel& panel;
    QDockWidget& dock;
    StatusLine& status;
    NotesPanel& notes;
  };
  DriveController(const Views& views, SessionLink& link, QObject* parent);
  ~DriveController() override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void connectBar();
  void askForCommands();
  void take(std::shared_ptr<live::RobotCommands> commands);
  void setHeld(bool held);
  void renew();
  void stop(live::DriveStop cause);
  void showStatus();

  static constexpr int kRenew = 30;  ///< period of renewing a held key [ms]

  Views views_;
  QPointer<RegistrationPanel> panel_;  ///< null: the views are gone
  SessionLink& link_;
  std::shared_ptr<live::RobotCommands> commands_;  ///< null: the session's robot is not commanded
  live::CommandStatus shown_;
  QTimer renew_, look_;
  QElapsedTimer renewed_;  ///< since the held key was renewed last
  bool held_ = false;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
