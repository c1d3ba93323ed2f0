#include "widgets/shell/filter_controller.h"

#include "core/base/error.h"
#include "core/tracking/option_changes.h"
#include "widgets/panels/filter/filter_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/session_link.h"
#include "widgets/shell/settings_undo.h"

namespace capstan::widgets {

FilterController::FilterController(FilterPanel& panel, SessionLink& link, NotesPanel& notes,
                                   SettingsUndo& undo, QObject* parent)
    : QObject(parent), panel_(panel), link_(link), notes_(notes) {
  connect(&link, &SessionLink::snapshot, this,
          [this](const tracking::Snapshot& snapshot) { now_ = snapshot.t; });
  connect(&link, &SessionLink::opened, this, [this](const tracking::SourceInfo& info) {
    now_ = info.begin;
    const tracking::TrackingOptions chosen = panel_.options();
    panel_.begin(link_.runner()->tracking());
    if (!link_.again()) return;
    panel_.setOptions(chosen);
    // After the notes have begun the session themselves.
    QMetaObject::invokeMethod(
        this, [this, chosen] { use(chosen); }, Qt::QueuedConnection);
  });
  connect(&panel, &FilterPanel::changed, this,
          [this, &undo](const tracking::TrackingOptions& options, const QString& name) {
            if (!link_.runner()) return;
            const tracking::TrackingOptions before = link_.runner()->tracking();
            if (tracking::optionChanges(before, options).empty()) return;
            use(options);
            undo.changed(
                name, [this, before] { use(before); }, [this, options] { use(options); });
          });
}

void FilterController::use(const tracking::TrackingOptions& options) {
  if (!link_.runner()) return;
  const std::string changes = tracking::optionChanges(link_.runner()->tracking(), options);
  if (changes.empty()) return panel_.setOptions(options);
  try {
    link_.runner()->setTracking(options);
    panel_.setOptions(options);
    notes_.addEvent(now_, "filter options", QString::fromStdString(changes));
  } catch (const base::InputError& error) {
    panel_.setOptions(link_.runner()->tracking());
    Q_EMIT link_.failed(QString::fromUtf8(error.what()));
  }
}

}  // namespace capstan::widgets
