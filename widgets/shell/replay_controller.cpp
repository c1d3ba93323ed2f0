#include "widgets/shell/replay_controller.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/recording/session_file.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/replay/replay_bar.h"
#include "widgets/scene/scene_view.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_link.h"
#include "widgets/shell/source_choice.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {
namespace {

constexpr double kSameImage = 0.02;  // time between a snapshot and its images in the file [s]

}  // namespace

ReplayController::ReplayController(ReplayBar& bar, const Views& views, SessionLink& link, QObject* parent)
    : QObject(parent), bar_(bar), views_(views), link_(link) {
  connect(&link, &SessionLink::opened, this,
          [this](const tracking::SourceInfo& info, const SourceChoice& choice) {
            samples_.clear();
            newest_.reset();
            images_.reset();
            opened_.clear();
            const bool session = choice.isRecording() && choice.file.endsWith(recording::kSessionSuffix);
            file_ = session ? choice.file.toStdString() : std::string();
            bar_.begin(info.begin, info.duration);
          });
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) {
    if (file_.empty()) file_ = status.recording;
  });
  connect(&link, &SessionLink::history, this, &ReplayController::keep);
  connect(&link, &SessionLink::snapshot, this, [this](const tracking::Snapshot& snapshot) {
    newest_ = snapshot;
    bar_.setNewest(snapshot.t);
  });
  connect(&views.notes, &NotesPanel::eventAdded, &bar, &ReplayBar::addEvent);
  connect(&bar, &ReplayBar::reviewed, this, &ReplayController::show);
  connect(&bar, &ReplayBar::followed, this, &ReplayController::showNewest);
}

bool ReplayController::reviewing() const { return bar_.reviewing(); }

void ReplayController::keep(const std::vector<tracking::Snapshot>& snapshots) {
  for (const tracking::Snapshot& snapshot : snapshots) {
    if (!snapshot.camera_updated) continue;
    samples_.push(snapshot);
  }
}

void ReplayController::show(double t) {
  showPlots(t);
  if (samples_.empty()) return;
  const std::size_t later = samples_.partitionPoint([t](const auto& sample) { return sample.t < t; });
  const tracking::Snapshot& seen = samples_[std::min(later, samples_.size() - 1)];
  views_.scene.showSnapshot(seen);
  if (seen.camera_images) showImages(seen);
}

/// Shows the newest sample at once: of a session that stands still, no other one comes.
void ReplayController::showNewest() {
  views_.figure.setCursor(std::nullopt);
  views_.figure.setFollowing(true);
  if (newest_) views_.scene.showSnapshot(*newest_);
  const tracking::StereoFrame& frame = link_.newestFrame();
  if (!frame.left.empty() || !frame.right.empty())
    views_.video.showFrames(frame.left, frame.right, link_.newestSeen());
}

void ReplayController::showPlots(double t) {
  JointFigure& figure = views_.figure;
  const QCPRange range = figure.timeRange();
  if (!range.contains(t)) figure.setTimeRange(t - 0.5 * figure.span(), t + 0.5 * figure.span());
  figure.setCursor(t);
  figure.refresh();
}

void ReplayController::showImages(const tracking::Snapshot& seen) {
  tracking::StereoFrame frame;
  try {
    if (recording::SessionImages* file = images(); file && file->at(seen.t_cam, kSameImage, frame))
      return views_.video.showFrames(frame.left, frame.right, seen);
  } catch (const base::InputError& error) {
    views_.messages.showMessage(QString::fromUtf8(error.what()));
  }
  views_.video.clear(file_.empty() ? tr("no images of this time: the session is not recorded")
                                   : tr("no images of this time in the recording"));
}

recording::SessionImages* ReplayController::images() {
  if (file_.empty()) return nullptr;
  if (opened_ != file_) {
    images_ = std::make_unique<recording::SessionImages>(file_);
    opened_ = file_;
  }
  return images_.get();
}

}  // namespace capstan::widgets
