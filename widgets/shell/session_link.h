#pragma once

#include <QObject>
#include <QTimer>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/live/runner.h"
#include "core/recording/settle_units.h"
#include "widgets/shell/robot_choice.h"
#include "widgets/shell/source_choice.h"

namespace capstan::widgets {

/// Connects the window and the session: opens sources in the background, and reads 30 times per second the
/// data that the runner has published. Nothing here waits for the pipeline.
class SessionLink : public QObject {
  Q_OBJECT
 public:
  explicit SessionLink(QObject* parent = nullptr);
  ~SessionLink() override;

  /// Opens a source; ends in opened(), failed() or unitsAsked(). While another source is opening, this one
  /// waits for it and replaces it and any source that was waiting: only the newest choice is reported.
  void open(const SourceChoice& choice);
  /// Opens a source that exists already, for tests.
  void take(std::unique_ptr<tracking::Source> source);
  bool opening() const { return opening_.valid(); }
  /// Null while there is no session.
  live::Runner* runner() const { return runner_.get(); }
  void setRunning(bool on);
  bool running() const { return runner_ && runner_->status().state == live::RunState::kRunning; }
  /// The source has no more samples.
  bool ended() const { return runner_ && last_state_ == live::RunState::kEnded; }
  bool recording() const;
  /// The newest pair of images, and the pipeline's result for it. Without images: none has come.
  const tracking::StereoFrame& newestFrame() const { return frame_; }
  const tracking::Snapshot& newestSeen() const { return seen_; }
  /// Whether the open session is the previous one from its beginning: both were opened by the same choice.
  bool again() const { return again_; }
  /// Makes the pipeline use `robot` from now on, and every session of the same arm (RobotChoice). Returns
  /// false if it is refused: nothing changes, and failed() gives the reason.
  bool useRobot(const robot::Description& robot, const RobotWords& words);
  const RobotChoice& robots() const { return robots_; }
  /// Registers `listener` for `who`: it receives every sample of the running session's pipeline, beside other
  /// listeners. {} removes it. Whenever a listener is added or removed, all others receive begin() again. A
  /// new session starts without listeners.
  void listen(const QObject* who, live::Listener listener);
  /// Starts or stops recording; errors are reported by failed().
  void toggleRecording(const QString& folder);

 signals:
  /// `choice`: the argument of open() for this source.
  void opened(const capstan::tracking::SourceInfo& info, const capstan::widgets::SourceChoice& choice);
  void failed(const QString& message);
  /// A session file that was to be opened, or is replayed, is damaged and may be recovered; failed() was
  /// emitted, too.
  void damaged(const QString& file, const QString& message);
  /// useRobot() has changed the robot; emitted before the notes are written.
  void robotChanged();
  /// open() read a table whose units have to be chosen first (SourceChoice::read_as).
  void unitsAsked(const capstan::recording::ImplausibleUnits& refused,
                  const capstan::widgets::SourceChoice& choice);
  void history(const std::vector<capstan::tracking::Snapshot>& snapshots);
  void snapshot(const capstan::tracking::Snapshot& snapshot);
  /// The newest pair of images and the pipeline's result for this pair.
  void frames(const capstan::tracking::StereoFrame& frame, const capstan::tracking::Snapshot& seen);
  void status(const capstan::live::RunStatus& status);
  void report(const capstan::tracking::TrackReport& report);

 private:
  void tick();
  void emitStatus(const live::RunStatus& now);
  void lookForFrames();
  void beginOpening(const SourceChoice& choice);
  void finishOpening();
  void refuse(const base::InputError& error);
  void offerRecovery(const std::string& file);
  void begin(std::unique_ptr<live::Runner> runner, const std::optional<SourceChoice>& choice);
  void retire(std::unique_ptr<live::Runner> runner, bool report_recording);
  void hearRetired();

  QTimer timer_, frames_timer_;
  std::future<std::unique_ptr<live::Runner>> opening_;
  SourceChoice choice_;                     ///< choice of opening_
  std::optional<SourceChoice> waiting_;     ///< the source to open next
  std::optional<SourceChoice> running_by_;  ///< choice that runner_ was opened with
  bool again_ = false;
  RobotChoice robots_;
  std::vector<std::future<std::string>> retiring_;  ///< ending runners; result: error of the recording
  bool reported_recording_ = false;                 ///< runner_ was recording at the last status()
  std::unique_ptr<live::Runner> runner_;
  std::map<const QObject*, live::Listener> listeners_;
  tracking::Snapshot snapshot_, seen_;
  tracking::StereoFrame frame_;
  std::vector<tracking::Snapshot> history_;
  live::RunState last_state_ = live::RunState::kPaused;
  std::uint64_t command_faults_ = 0;  ///< number of faults reported so far
  int ticks_ = 0;
};

}  // namespace capstan::widgets
