#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <string>

#include "core/recording/session_images.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/ring.h"

namespace capstan::widgets {

class JointFigure;
class MessageBar;
class NotesPanel;
class ReplayBar;
class SceneView;
class SessionLink;
class StereoView;

/// Shows a time of the session that was tracked already: images from its file, the arm, and the plots'
/// cursor. The session itself stays where it is.
class ReplayController : public QObject {
  Q_OBJECT

 public:
  struct Views {
    JointFigure& figure;
    StereoView& video;
    SceneView& scene;
    NotesPanel& notes;
    MessageBar& messages;
  };
  ReplayController(ReplayBar& bar, const Views& views, SessionLink& link, QObject* parent);

  /// True while an earlier time is in view: newer snapshots are not shown.
  bool reviewing() const;

 private:
  /// Camera samples kept for the review: 22 min at 15 pairs a second.
  static constexpr std::size_t kMost = 20'000;
  void keep(const std::vector<tracking::Snapshot>& snapshots);
  void show(double t);
  void showNewest();
  void showImages(const tracking::Snapshot& seen);
  void showPlots(double t);
  recording::SessionImages* images();

  ReplayBar& bar_;
  Views views_;
  SessionLink& link_;
  Ring<tracking::Snapshot> samples_{kMost};
  std::optional<tracking::Snapshot> newest_;
  std::string file_, opened_;  ///< file of the session's images, and the one that images_ reads
  std::unique_ptr<recording::SessionImages> images_;
};

}  // namespace capstan::widgets
