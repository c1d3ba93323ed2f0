#include "widgets/shell/recent_menu.h"

#include <QFileInfo>
#include <QIcon>
#include <QProxyStyle>

#include "widgets/shell/recording_card.h"

namespace capstan::widgets {

namespace {

/// Menus with icons as large as the images of recordings.
class LargeIcons : public QProxyStyle {
 public:
  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override {
    return metric == PM_SmallIconSize ? kCardWidth : QProxyStyle::pixelMetric(metric, option, widget);
  }
};

}  // namespace

RecentMenu::RecentMenu(QWidget* parent) : QMenu(tr("Recent"), parent) {
  menuAction()->setObjectName("recent");
  setToolTipsVisible(true);
  auto* large = new LargeIcons;
  large->setParent(this);
  setStyle(large);
  connect(this, &QMenu::aboutToShow, this, [this] {
    refresh();
    readMissing();
  });
  connect(&job_, &Job::ended, this, &RecentMenu::refresh);
}

void RecentMenu::setFiles(const QStringList& files) {
  files_ = files.mid(0, kMost);
  keepCards(files_);
  clear();
  menuAction()->setEnabled(!files_.isEmpty());
  for (const QString& file : files_) {
    auto* action = addAction(QString());
    action->setData(file);
    action->setToolTip(file);
    connect(action, &QAction::triggered, this, [this, file] { Q_EMIT chosen(file); });
  }
  refresh();
}

void RecentMenu::remember(const QString& file) {
  const QString path = QFileInfo(file).absoluteFilePath();
  QStringList files = files_;
  files.removeAll(path);
  files.prepend(path);
  setFiles(files);
}

QString RecentMenu::details(int index) const { return actions().value(index)->text().section('\t', 1); }

void RecentMenu::refresh() {
  for (QAction* action : actions()) {
    const QFileInfo file(action->data().toString());
    RecordingCard card;
    action->setEnabled(file.exists());
    if (!file.exists())
      card.details = tr("no longer there");
    else if (!readCard(file.filePath(), card))
      card.details = tr("reading…");
    action->setIcon(card.image.isNull() ? QIcon() : QIcon(QPixmap::fromImage(card.image)));
    action->setText(file.fileName().replace('&', "&&") + '\t' + card.details);
  }
}

void RecentMenu::readMissing() {
  QStringList missing;
  RecordingCard card;
  for (const QString& file : files_)
    if (QFileInfo::exists(file) && !readCard(file, card)) missing << file;
  if (missing.isEmpty() || job_.busy()) return;
  job_.start(
      [missing](base::Progress& progress) {
        for (const QString& file : missing)
          if (!progress.cancelled()) makeCard(file);
        return 0;
      },
      [](int) {});
}

}  // namespace capstan::widgets
