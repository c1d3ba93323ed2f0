#pragma once

#include <QObject>
#include <QTimer>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/live/runner.h"
#include "core/recording/settle_units.h"
#include "widgets/shell/robot_choice.h"
#include "widgets/shell/source_choice.h"

namespace capstan::widgets {

/// Between the window and the session: opens sources in the background and pulls 30 times a second what the
/// runner has published. Nothing here waits for the pipeline.
class SessionLink : public QObject {
  Q_OBJECT
 public:
  explicit SessionLink(QObject* parent = nullptr);
  ~SessionLink() override;

  /// Ends in opened(), failed() or unitsAsked(). While another one is opening, this one waits for it, takes
  /// its place and that of what waited before: of several only the newest is heard of.
  void open(const SourceChoice& choice);
  /// Takes a ready source, as tests have.
  void take(std::unique_ptr<tracking::Source> source);
  bool opening() const { return opening_.valid(); }
  /// Null while there is no session.
  live::Runner* runner() const { return runner_.get(); }
  void setRunning(bool on);
  bool running() const { return runner_ && runner_->status().state == live::RunState::kRunning; }
  /// The source has no more samples.
  bool ended() const { return runner_ && last_state_ == live::RunState::kEnded; }
  bool recording() const;
  /// The session that is open is the one before from its beginning: it was opened by the same choice.
  bool again() const { return again_; }
  /// The pipeline uses `robot` from now on, and so does every session of the same arm (RobotChoice). False:
  /// refused, nothing changes, failed() says why.
  bool useRobot(const robot::Description& robot, const RobotWords& words);
  const RobotChoice& robots() const { return robots_; }
  /// `who` hears what the running session's pipeline makes of every sample, beside others that listen, with
  /// the listener given last; {}: no longer. Whenever somebody comes or goes, all that stay hear begin()
  /// again. A new session begins with nobody.
  void listen(const QObject* who, live::Listener listener);
  /// Starts or stops; failures come as failed().
  void toggleRecording(const QString& folder);

 signals:
  /// `choice`: what open() was given for this source.
  void opened(const capstan::tracking::SourceInfo& info, const capstan::widgets::SourceChoice& choice);
  void failed(const QString& message);
  /// What useRobot() put to use, before the notes hear of it.
  void robotChanged();
  /// open() met a table whose units have to be chosen first (SourceChoice::read_as).
  void unitsAsked(const capstan::recording::ImplausibleUnits& refused,
                  const capstan::widgets::SourceChoice& choice);
  void history(const std::vector<capstan::tracking::Snapshot>& snapshots);
  void snapshot(const capstan::tracking::Snapshot& snapshot);
  /// The newest pair of pictures and what the pipeline made of exactly these.
  void frames(const capstan::tracking::StereoFrame& frame, const capstan::tracking::Snapshot& seen);
  void status(const capstan::live::RunStatus& status);
  void report(const capstan::tracking::TrackReport& report);

 private:
  void tick();
  void beginOpening(const SourceChoice& choice);
  void finishOpening();
  void begin(std::unique_ptr<live::Runner> runner, const std::optional<SourceChoice>& choice);
  void retire(std::unique_ptr<live::Runner> runner);
  void hearRetired();

  QTimer timer_;
  std::future<std::unique_ptr<live::Runner>> opening_;
  SourceChoice choice_;                     ///< of opening_
  std::optional<SourceChoice> waiting_;     ///< to be opened next
  std::optional<SourceChoice> running_by_;  ///< what runner_ was opened by
  bool again_ = false;
  RobotChoice robots_;
  std::vector<std::future<std::string>> retiring_;  ///< old runners end; a fault of their recordings
  bool recorded_when_left_ = false;  ///< runner_ was recording when another source was requested
  std::unique_ptr<live::Runner> runner_;
  std::map<const QObject*, live::Listener> listeners_;
  tracking::Snapshot snapshot_, seen_;
  tracking::StereoFrame frame_;
  std::vector<tracking::Snapshot> history_;
  live::RunState last_state_ = live::RunState::kPaused;
  std::uint64_t command_faults_ = 0;  ///< reported so far
  int ticks_ = 0;
};

}  // namespace capstan::widgets
