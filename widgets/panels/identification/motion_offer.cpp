#include "widgets/panels/identification/motion_offer.h"

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

MotionOffer::MotionOffer(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setFont(textFont(9.5));
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  words_->setAccessibleName(tr("proposed motion"));
  button_ = new QPushButton;
  button_->setObjectName("motion");
  button_->setFocusPolicy(Qt::TabFocus);
  button_->setStyleSheet("padding: 4px 6px;");
  row->addWidget(words_, 1);
  row->addWidget(button_);
  connect(button_, &QPushButton::clicked, this, &MotionOffer::press);
  setVisible(false);
  refresh();
}

void MotionOffer::setDrivable(bool drivable) {
  drivable_ = drivable;
  refresh();
}

void MotionOffer::setWeak(bool weak) {
  setVisible(weak);
  if (weak) return;
  proposal_.reset();
  searching_ = false;
  refresh();
}

void MotionOffer::setSearching(bool searching) {
  if (searching_ == searching) return;
  searching_ = searching;
  refresh();
}

void MotionOffer::setProposal(std::optional<identification::MotionProposal> proposal) {
  proposal_ = std::move(proposal);
  searching_ = false;
  refresh();
}

QString MotionOffer::words() const { return words_->text(); }

void MotionOffer::press() {
  if (!proposal_) return Q_EMIT proposeRequested();
  const identification::MotionProposal proposal = *proposal_;
  setProposal(std::nullopt);
  Q_EMIT driveRequested(proposal.motion, QString::fromStdString(proposal.words));
}

void MotionOffer::refresh() {
  words_->setText(proposal_ ? QString::fromStdString(proposal_->words) : QString());
  words_->setVisible(proposal_.has_value());
  words_->setToolTip(words_->text());
  setSizePolicy(proposal_ ? QSizePolicy::Preferred : QSizePolicy::Maximum, QSizePolicy::Preferred);
  button_->setText(proposal_ ? tr("Drive it") : searching_ ? tr("Computing…") : tr("Better motion"));
  button_->setEnabled(proposal_ ? drivable_ : !searching_);
  button_->setToolTip(
      !proposal_  ? tr("Find a motion that determines the weak parameters (Shift+M)")
      : drivable_ ? tr("Drive the robot along this motion and collect (Shift+M)")
                  : tr("This robot cannot be driven from here: move it like this by its own controller"));
}

}  // namespace capstan::widgets
