#include "widgets/panels/diagnosis/time_view.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QLabel>
#include <QShortcut>

#include "core/diagnosis/report/shown.h"
#include "widgets/figures/channel_note.h"
#include "widgets/figures/figure_text.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

using diagnosis::ChannelReport;

namespace {

/// Sentence: "The robot file's model is 2.1 mm off, refitted 1.3 mm, with the causes found 0.6 mm (RMS)."
QString wordsOf(const ChannelReport& channel, bool extended) {
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(channel.refitted.unit);
  const auto shown = [&](const diagnosis::ChannelStatistics& statistics) {
    return unbroken(significantText(unit.scale * statistics.rms) + QLatin1Char(' ') +
                    QString::fromStdString(unit.unit));
  };
  QString words = QObject::tr("The robot file's model is %1 off (RMS), refitted %2")
                      .arg(shown(channel.nominal_statistics), shown(channel.refitted_statistics));
  if (extended) words += QObject::tr(", with the causes found %1").arg(shown(channel.extended_statistics));
  return words + QLatin1Char('.');
}

}  // namespace

TimeView::TimeView(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  channels_ = new QComboBox;
  channels_->setObjectName("time_channel");
  channels_->setToolTip(tr("Which sensor (Alt+C: the next)"));
  channels_->setAccessibleName(tr("channel over time"));
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setFont(textFont(10.0, true));
  words_->setAccessibleName(tr("error of each model"));
  row->addWidget(channels_, 0, Qt::AlignTop);
  row->addWidget(words_, 1);
  column->addLayout(row);
  column->addLayout(sheet_ = new QVBoxLayout, 1);
  connect(channels_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &TimeView::draw);
  connect(new QShortcut(QKeySequence(QStringLiteral("Alt+C")), this), &QShortcut::activated, this, [this] {
    if (channels_->count() > 0)
      channels_->setCurrentIndex((channels_->currentIndex() + 1) % channels_->count());
  });
}

void TimeView::setTheme(const Theme& theme) {
  theme_ = theme.isDark() ? &Theme::dark() : &Theme::light();  // figures keep a reference
  if (figure_) figure_->setTheme(*theme_);
}

void TimeView::showReport(std::shared_ptr<const diagnosis::Report> report) {
  const QString shown = channels_->currentText();
  report_ = std::move(report);
  const QSignalBlocker quiet(channels_);
  channels_->clear();
  for (const ChannelReport& channel : report_->channels) channels_->addItem(channelTitle(*report_, channel));
  channels_->setCurrentIndex(std::max(0, channels_->findText(shown)));
  draw();
}

void TimeView::showChannel(const std::string& name) {
  for (std::size_t i = 0; report_ && i < report_->channels.size(); ++i)
    if (report_->channels[i].refitted.name == name) return channels_->setCurrentIndex(static_cast<int>(i));
}

void TimeView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) draw();
}

/// Draws only while visible, because a figure can have tens of thousands of points.
void TimeView::draw() {
  delete figure_;
  figure_ = nullptr;
  words_->clear();
  stale_ = !isVisible();
  const int index = channels_->currentIndex();
  if (stale_ || !report_ || index < 0) return;
  const ChannelReport& channel = report_->channels[static_cast<std::size_t>(index)];
  words_->setText(wordsOf(channel, !report_->causes.empty()));
  ResidualData drawn = residualData(*report_, channel);
  drawn.title.clear();  // the box above says it, and the recording
  drawn.note = explainedNote(*report_, channel);
  figure_ = new ResidualFigure(std::move(drawn));
  figure_->setAccessibleName(words_->text());
  figure_->setToolTip(tr("Drag and wheel move and zoom the time axis; a double click shows all of it"));
  figure_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  for (const PanelFigure::Panel& panel : figure_->panels()) {
    panel.axes->setRangeDrag(Qt::Horizontal);
    panel.axes->setRangeZoom(Qt::Horizontal);
  }
  connect(figure_, &QCustomPlot::mouseDoubleClick, this, &TimeView::showAll);
  figure_->setTheme(*theme_);
  sheet_->addWidget(figure_);
}

void TimeView::showAll() {
  const auto& t = report_->channels[static_cast<std::size_t>(channels_->currentIndex())].refitted.t;
  if (t.size() < 2) return;
  figure_->panels().front().axes->axis(QCPAxis::atBottom)->setRange(t.front(), t.back());
  figure_->replot(QCustomPlot::rpQueuedReplot);
}

QString TimeView::words() const { return words_->text(); }

}  // namespace capstan::widgets
