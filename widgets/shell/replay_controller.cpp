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
  connect(&link, &SessionLink::snapshot, this,
          [this](const tracking::Snapshot& snapshot) { bar_.setNewest(snapshot.t); });
  connect(&views.notes, &NotesPanel::eventAdded, &bar, &ReplayBar::addEvent);
  connect(&bar, &ReplayBar::reviewed, this, &ReplayController::show);
  connect(&bar, &ReplayBar::followed, this, [this] {
    views_.figure.setCursor(std::nullopt);
    views_.figure.setFollowing(true);
  });
}

bool ReplayController::reviewing() const { return bar_.reviewing(); }

void ReplayController::keep(const std::vector<tracking::Snapshot>& snapshots) {
  for (const tracking::Snapshot& snapshot : snapshots) {
    if (!snapshot.camera_updated) continue;
    samples_.push_back(snapshot);
    if (samples_.size() > kMost) samples_.pop_front();
  }
}

void ReplayController::show(double t) {
  showPlots(t);
  const auto later = std::ranges::lower_bound(samples_, t, {}, &tracking::Snapshot::t);
  if (samples_.empty()) return;
  const tracking::Snapshot& seen = later == samples_.end() ? samples_.back() : *later;
  views_.scene.showSnapshot(seen);
  if (seen.camera_images) showImages(seen);
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
