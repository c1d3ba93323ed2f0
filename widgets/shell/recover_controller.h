#pragma once

#include <QObject>
#include <optional>

#include "core/recording/recover.h"
#include "widgets/jobs/job.h"

namespace capstan::widgets {

class MessageBar;
class SessionLink;

/// Recovery of damaged session files, as `capstan-cli recover` does it: asks for the files, works in the
/// background, opens what was saved and states what is lost.
class RecoverController : public QObject {
  Q_OBJECT

 public:
  RecoverController(MessageBar& faults, MessageBar& news, SessionLink& link, QObject* parent);

  /// Offers to recover a file that was refused as damaged.
  void offer(const QString& file, const QString& why);
  void askDamaged();
  void askNew(const QString& damaged);
  /// `robot`: robot file for a session whose own is lost; empty: none.
  void recover(const QString& damaged, const QString& saved, const QString& robot = {});

 private:
  /// What the background work ends with; nothing: the session's robot is lost.
  using Outcome = std::optional<recording::Recovery>;
  void askRobot(const QString& damaged, const QString& saved);
  bool isRecorded(const QString& file) const;
  void show(const recording::Recovery& recovery, const QString& damaged, const QString& saved);

  MessageBar &faults_, &news_;
  SessionLink& link_;
  Job job_;
};

}  // namespace capstan::widgets
