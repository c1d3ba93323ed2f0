#include "widgets/panels/registration/collect_page.h"

#include <QBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QVariant>

#include "core/base/units.h"

namespace capstan::widgets {

CollectPage::CollectPage(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  count_ = new QLabel;
  progress_ = new QProgressBar;
  progress_->setTextVisible(false);
  progress_->setMaximumHeight(8);
  plot_ = new ScatterPlot;
  sigma_ = new QLabel;
  sigma_->setFont(numberFont(10.5));
  outliers_ = new QListWidget;
  outliers_->setMaximumHeight(72);
  outliers_->setAccessibleName("rejected points");
  outliers_->setFocusPolicy(Qt::NoFocus);
  outliers_->setSelectionMode(QAbstractItemView::NoSelection);
  refusal_ = new QLabel;
  refusal_->setWordWrap(true);
  refusal_->setTextFormat(Qt::RichText);
  refusal_->setMargin(8);
  back_ = new QPushButton("Back to the stop");
  exchange_ = new QPushButton("Exchange the cameras");
  exchange_->setObjectName("exchange");
  exchange_->hide();
  again_ = new QPushButton("Collect again");
  again_->setProperty("primary", true);
  column->addWidget(count_);
  column->addWidget(progress_);
  column->addWidget(plot_, 1);
  column->addWidget(sigma_);
  column->addWidget(outliers_);
  column->addWidget(refusal_);
  auto* row = new QHBoxLayout;
  row->addWidget(back_);
  row->addStretch(1);
  row->addWidget(exchange_);
  row->addWidget(again_);
  column->addLayout(row);
  connect(back_, &QPushButton::clicked, this, &CollectPage::backRequested);
  connect(exchange_, &QPushButton::clicked, this, &CollectPage::exchangeRequested);
  connect(again_, &QPushButton::clicked, this, &CollectPage::againRequested);
}

void CollectPage::setTheme(const Theme& theme) {
  theme_ = theme;
  plot_->setTheme(theme);
  refusal_->setStyleSheet(noticeStyle(theme, theme.fault));
}

QString CollectPage::refusal() const { return refusal_->isHidden() ? QString() : refusal_->text(); }

void CollectPage::setEnded(bool ended) {
  ended_ = ended;
  if (ended) again_->setEnabled(false);
}

void CollectPage::showGuide(const registration::RegistrationGuide& guide) {
  const auto& scatter = guide.scatter();
  const bool refused = guide.step() == registration::RegistrationStep::kRefused;
  count_->setText(QString("%1 of %2 points used, %3 rejected, %4 frames seen")
                      .arg(scatter.used)
                      .arg(registration::RegistrationGuide::kFrames)
                      .arg(scatter.outliers)
                      .arg(guide.framesSeen()));
  progress_->setRange(0, registration::RegistrationGuide::kFrames);
  progress_->setValue(std::min(scatter.used, registration::RegistrationGuide::kFrames));
  const Eigen::Vector3d mm = base::toMillimetres(1.0) * scatter.sigma;
  sigma_->setText(QString("σ of one point:  x %1  y %2  z %3 mm")
                      .arg(mm.x(), 6, 'f', 3)
                      .arg(mm.y(), 6, 'f', 3)
                      .arg(mm.z(), 6, 'f', 3));
  plot_->showGuide(guide);
  listOutliers(guide);
  refusal_->setVisible(refused);
  again_->setVisible(refused);
  exchange_->setVisible(refused && guide.fault() == registration::RegistrationFault::kCamerasExchanged);
  again_->setEnabled(guide.canCollect() && !ended_);
  if (!refused) return;
  const auto name = base::nameOf(guide.fault());
  refusal_->setText(QString("<b>Refused: %1.</b><br>%2<br>%3")
                        .arg(QString::fromUtf8(name.data(), static_cast<int>(name.size())),
                             QString::fromStdString(guide.reason()).toHtmlEscaped(),
                             QString::fromStdString(guide.advice()).toHtmlEscaped()));
}

void CollectPage::listOutliers(const registration::RegistrationGuide& guide) {
  if (outliers_->count() == guide.scatter().outliers && outliers_->count() > 0) return;
  outliers_->clear();
  outliers_->setVisible(guide.scatter().outliers > 0);
  int frame = 0;
  for (const auto& point : guide.points()) {
    ++frame;
    if (point.verdict == registration::PointVerdict::kUsed) continue;
    const double off = base::toMillimetres(point.position(point.axis) - guide.scatter().median(point.axis));
    outliers_->addItem(QString("point %1 rejected: %2 is %3 mm from the median, %4 σ")
                           .arg(frame)
                           .arg(QChar("xyz"[point.axis]))
                           .arg(off, 0, 'f', 2)
                           .arg(point.excess, 0, 'f', 1));
  }
  outliers_->scrollToBottom();
}

}  // namespace capstan::widgets
