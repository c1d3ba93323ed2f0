#pragma once

#include <QObject>

#include "core/tracking/options.h"

namespace capstan::widgets {

class FilterPanel;
class NotesPanel;
class SessionLink;
class SettingsUndo;

/// Connects the panel of filter options and the session: the pipeline uses what the panel shows, a note is
/// added, and the change can be undone. A session that begins again keeps its options.
class FilterController : public QObject {
  Q_OBJECT

 public:
  FilterController(FilterPanel& panel, SessionLink& link, NotesPanel& notes, SettingsUndo& undo,
                   QObject* parent);

 private:
  void use(const tracking::TrackingOptions& options);

  FilterPanel& panel_;
  SessionLink& link_;
  NotesPanel& notes_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
