#include "widgets/panels/registration/result_page.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVariant>

#include "core/base/units.h"
#include "core/live/arm_overlay.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {

namespace {

constexpr int kLeastFrames = 120;  ///< [px]

QString row(const QString& name, const Eigen::Vector3d& metres, const QString& sign) {
  QString line = name.leftJustified(22);
  for (int i = 0; i < 3; ++i) {
    const double mm = base::toMillimetres(metres(i));
    const QString number = QString::number(std::abs(mm), 'f', 2);
    line += (sign + (mm < -0.005 && sign.isEmpty() ? QString("−") : QString()) + number).rightJustified(10);
  }
  return line + " mm";
}

}  // namespace

ResultPage::ResultPage(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  numbers_ = new QLabel;
  numbers_->setFont(numberFont(10.5));
  numbers_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  note_ = new QLabel;
  note_->setWordWrap(true);
  frames_ = new StereoView;
  frames_->setWholeFrameLarge(true);
  frames_->setMinimumHeight(kLeastFrames);
  // A scroll area gives its content the preferred height: that of the images would push the buttons out.
  frames_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
  reason_ = new QComboBox;
  reason_->setEditable(true);
  reason_->addItems(
      {"overlay does not lie on the arm", "arm was not at its stop", "wrong thing detected", "only a trial"});
  reason_->setCurrentIndex(-1);
  reason_->lineEdit()->setPlaceholderText("reason to reject");
  reason_->setMinimumWidth(160);
  accept_ = new QPushButton("Accept");
  accept_->setProperty("primary", true);
  redo_ = new QPushButton("Redo");
  reject_ = new QPushButton("Reject");
  reject_->setEnabled(false);
  column->addWidget(numbers_);
  column->addWidget(frames_, 1);
  column->addWidget(note_);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(redo_);
  buttons->addStretch(1);
  buttons->addWidget(reason_, 2);
  buttons->addWidget(reject_);
  buttons->addSpacing(12);
  buttons->addWidget(accept_);
  column->addLayout(buttons);
  connect(accept_, &QPushButton::clicked, this, &ResultPage::acceptRequested);
  connect(redo_, &QPushButton::clicked, this, &ResultPage::redoRequested);
  connect(reject_, &QPushButton::clicked, this,
          [this] { Q_EMIT rejectRequested(reason_->currentText().trimmed()); });
  connect(reason_, &QComboBox::editTextChanged, this,
          [this](const QString& text) { reject_->setEnabled(!text.trimmed().isEmpty()); });
}

ResultPage::~ResultPage() = default;

void ResultPage::setTheme(const Theme& theme) {
  theme_ = theme;
  frames_->setTheme(theme);
  note_->setStyleSheet(QString("color:%1;").arg(theme.muted.name()));
}

void ResultPage::setRig(const robot::Description& robot, const std::optional<vision::StereoRig>& rig) {
  arm_.emplace(robot);
  marker_radius_ = robot.marker_radius;
  rig_ = rig;
}

QString ResultPage::summary() const { return numbers_->text(); }

void ResultPage::setEnded(bool ended) { redo_->setEnabled(!ended); }

void ResultPage::showGuide(const registration::RegistrationGuide& guide) {
  const auto& proposal = guide.proposal();
  if (!proposal) return;
  old_ = guide.current();
  new_ = proposal->registration.base_from_camera;
  QStringList lines = {QString("%1%2%3%4").arg("", 22).arg("x", 10).arg("y", 10).arg("z", 10),
                       row("base_from_camera", new_->translation(), ""),
                       row("at the tool, 95 %", proposal->half_width, "±")};
  if (old_) lines << row("moves observed tip by", proposal->shift, "");
  numbers_->setText(lines.join('\n'));
  note_->setText(
      QString(
          "%1 frames, %2 mm rms about their place. The ± is what the scatter leaves. One pose cannot show a "
          "wrong mounting angle: each degree of it moves the far end of the workspace by %3 mm.")
          .arg(proposal->registration.frames)
          .arg(base::toMillimetres(proposal->registration.rms), 0, 'f', 2)
          .arg(base::toMillimetres(proposal->per_degree), 0, 'f', 1));
  overlay(guide, guide.collectedPose());
  reason_->setCurrentIndex(-1);
  reason_->clearEditText();
}

void ResultPage::showFrames(const cv::Mat& left, const cv::Mat& right, const tracking::Snapshot& snapshot) {
  frames_->showFrames(left, right, snapshot);
}

void ResultPage::overlay(const registration::RegistrationGuide& guide, const Eigen::Vector3d& q) {
  std::array<std::vector<ImageLine>, 2> lines;
  if (!rig_) return;
  const auto add = [&](const Eigen::Isometry3d& pose, const QColor& colour, bool dashed,
                       const QString& label) {
    const auto seen = live::projectArm(*arm_, marker_radius_, *rig_, pose, q);
    for (std::size_t side = 0; side < 2; ++side)
      lines[side].push_back({seen.sides[side].shaft, colour, dashed, seen.sides[side].marker_radius, label});
  };
  if (guide.current()) add(*guide.current(), theme_.colour(Quantity::kKinematic), true, "old");
  add(*new_, theme_.colour(Quantity::kUkf), false, "new");
  frames_->setLines(lines);
}

}  // namespace capstan::widgets
