#include "widgets/panels/calibration/calibration_panel.h"

#include <QBoxLayout>
#include <QFileDialog>
#include <QLabel>
#include <QPushButton>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/vision/rig_file.h"
#include "widgets/panels/calibration/board_form.h"
#include "widgets/panels/calibration/coverage_picture.h"
#include "widgets/panels/calibration/view_table.h"

namespace capstan::widgets {

using vision::CalibrationReport;
using vision::CalibrationViews;

CalibrationPanel::CalibrationPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(8);
  auto* advice = new QLabel(tr(
      "Show a flat board to both cameras: everywhere in the images, near and far, tilted to all sides. A "
      "view is taken when the board stands still at a new place. The bars are full when the views suffice."));
  advice->setWordWrap(true);
  auto* pictures = new QHBoxLayout;
  for (const int side : {0, 1}) {
    pictures_[static_cast<std::size_t>(side)] = new CoveragePicture(side == 0 ? tr("Left") : tr("Right"));
    pictures->addWidget(pictures_[static_cast<std::size_t>(side)], 1);
  }
  message_ = new QLabel;
  message_->setWordWrap(true);
  message_->setMargin(8);
  other_ = new QPushButton;
  auto* said = new QHBoxLayout;
  said->addWidget(message_, 1);
  said->addWidget(other_);
  table_ = new ViewTable;
  column->addWidget(advice);
  column->addWidget(form_ = new BoardForm);
  column->addWidget(makeButtons());
  column->addLayout(pictures, 3);
  column->addLayout(said);
  column->addWidget(table_, 2);
  column->addWidget(makeResult());
  connect(form_, &BoardForm::changed, this, &CalibrationPanel::clear);
  connect(table_, &ViewTable::excluded, this, &CalibrationPanel::exclude);
  connect(other_, &QPushButton::clicked, this, &CalibrationPanel::useOtherBoard);
  for (Job* job : {&look_, &fit_})
    connect(job, &Job::failed, this, [this](const QString& why) { say(why, true); });
  connect(&look_, &Job::ended, this, [this] {
    refresh();
    observeNewest();
  });
  connect(&fit_, &Job::progressed, this, [this](double, const QString& doing) { say(doing + "…"); });
  connect(&fit_, &Job::ended, this, &CalibrationPanel::refresh);
  clear();
  setTheme(theme_);
}

CalibrationPanel::~CalibrationPanel() = default;

QWidget* CalibrationPanel::makeButtons() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  collect_ = new QPushButton(tr("Collect views"));
  collect_->setProperty("primary", true);
  folder_ = new QPushButton(tr("From folder…"));
  folder_->setToolTip(tr("Pairs of images left01.png, right01.png and so on"));
  clear_ = new QPushButton(tr("Clear"));
  count_ = new QLabel;
  row->addWidget(collect_);
  row->addWidget(folder_);
  row->addWidget(clear_);
  row->addStretch(1);
  row->addWidget(count_);
  connect(collect_, &QPushButton::clicked, this, [this] { setCollecting(!collecting_); });
  connect(clear_, &QPushButton::clicked, this, &CalibrationPanel::clear);
  connect(folder_, &QPushButton::clicked, this,
          [this] { askFolder(tr("Folder with pairs of images"), &CalibrationPanel::addFolder); });
  return box;
}

QWidget* CalibrationPanel::makeResult() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  result_ = new QLabel;
  result_->setFont(numberFont(10.5));
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  calibrate_ = new QPushButton(tr("Calibrate"));
  calibrate_->setProperty("primary", true);
  save_images_ = new QPushButton(tr("Save images…"));
  save_images_->setToolTip(tr("Views from the cameras, for `capstan-cli calibrate`"));
  save_ = new QPushButton(tr("Save calibration…"));
  save_->setToolTip(tr("left.yaml and right.yaml (ROS camera_info), for live set-ups"));
  auto* row = new QHBoxLayout;
  row->addWidget(calibrate_);
  row->addStretch(1);
  row->addWidget(save_images_);
  row->addWidget(save_);
  column->addWidget(result_);
  column->addLayout(row);
  connect(calibrate_, &QPushButton::clicked, this, &CalibrationPanel::calibrate);
  connect(save_, &QPushButton::clicked, this,
          [this] { askFolder(tr("Folder for left.yaml and right.yaml"), &CalibrationPanel::saveAt); });
  connect(save_images_, &QPushButton::clicked, this,
          [this] { askFolder(tr("Folder for the images"), &CalibrationPanel::saveImagesAt); });
  return box;
}

void CalibrationPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  for (CoveragePicture* picture : pictures_) picture->setTheme(theme);
  say(message(), warning_);
}

QString CalibrationPanel::message() const { return message_->text(); }

void CalibrationPanel::say(const QString& text, bool warning) {
  warning_ = warning;
  message_->setText(text);
  message_->setVisible(!text.isEmpty());
  restyle(*message_, noticeStyle(theme_, warning ? theme_.warning : theme_.accent));
}

void CalibrationPanel::clear() {
  look_.cancel();
  fit_.cancel();
  report_.reset();
  say({});
  try {
    views_ = std::make_shared<CalibrationViews>(form_->options());
  } catch (const base::InputError& error) {
    if (!views_) throw;
    setCollecting(false);
    say(QString::fromUtf8(error.what()), true);
  }
  refresh();
}

void CalibrationPanel::setCollecting(bool on) {
  collecting_ = on;
  if (!on) say({});
  refresh();
  observeNewest();
}

void CalibrationPanel::stop() { setCollecting(false); }

void CalibrationPanel::showFrames(const tracking::StereoFrame& frame) {
  if (frame.left.empty() || frame.right.empty()) return;
  frame.left.copyTo(frame_[0]);
  frame.right.copyTo(frame_[1]);
  frame_t_ = frame.t;
  fresh_ = true;
  if (collecting_) return observeNewest();
  for (std::size_t side = 0; side < 2; ++side) pictures_[side]->showImage(frame_[side], std::nullopt);
}

/// Looks for the board in the newest frame, unless the one before is still being looked at.
void CalibrationPanel::observeNewest() {
  if (!collecting_ || !fresh_ || busy()) return;
  fresh_ = false;
  struct Result {
    std::shared_ptr<CalibrationViews> views;
    CalibrationViews::Observation seen;
    std::array<cv::Mat, 2> frame;
  };
  look_.start(
      [views = std::make_shared<CalibrationViews>(*views_), t = frame_t_,
       frame = std::array{frame_[0].clone(), frame_[1].clone()}](base::Progress&) {
        const CalibrationViews::Observation seen = views->observe(frame[0], frame[1], t);
        return Result{views, seen, frame};
      },
      [this, before = views_](const Result& result) {
        if (views_ != before || !collecting_) return;
        pictures_[0]->showImage(result.frame[0], result.seen.left);
        pictures_[1]->showImage(result.frame[1], result.seen.right);
        take(result.views, result.seen);
      });
}

void CalibrationPanel::take(std::shared_ptr<CalibrationViews> views,
                            const CalibrationViews::Observation& seen) {
  views_ = std::move(views);
  if (seen.verdict == CalibrationViews::Verdict::kTaken) {
    report_.reset();
    say(tr("Taken."));
  } else {
    say(QString::fromStdString(vision::wordsOf(seen.verdict)));
  }
}

void CalibrationPanel::addFolder(const QString& folder) {
  if (busy()) return;
  setCollecting(false);
  try {
    const auto input = vision::findStereoPairs(folder.toStdString());
    fit_.start(
        [views = std::make_shared<CalibrationViews>(*views_), input](base::Progress& progress) {
          views->addFiles(input, progress);
          return views;
        },
        [this](const std::shared_ptr<CalibrationViews>& views) {
          views_ = views;
          report_.reset();
          say({});
        });
  } catch (const base::InputError& error) {
    say(QString::fromUtf8(error.what()), true);
  }
  refresh();
}

void CalibrationPanel::exclude(int view, bool out) {
  auto views = std::make_shared<CalibrationViews>(*views_);
  views->exclude(static_cast<std::size_t>(view), out);
  views_ = views;
  report_.reset();
  refresh();
}

void CalibrationPanel::calibrate() {
  if (fit_.busy()) return;
  setCollecting(false);
  fit_.start([views = views_](base::Progress& progress) { return views->calibrate(progress); },
             [this, of = views_](const CalibrationReport& report) {
               if (views_ != of) return;
               report_ = report;
               say({});
             });
  refresh();
}

void CalibrationPanel::useOtherBoard() {
  const auto size = views_->otherBoard();
  if (!size) return;
  vision::CalibrationOptions options = form_->options();
  options.board_columns = size->width;
  options.board_rows = size->height;
  form_->setOptions(options);
  clear();
}

bool CalibrationPanel::save(const QString& folder) {
  if (!report_) return false;
  const std::filesystem::path path = folder.toStdString();
  try {
    vision::writeStereoRig(report_->rig, path / "left.yaml", path / "right.yaml");
    say(tr("Saved: left.yaml and right.yaml in %1").arg(folder));
    return true;
  } catch (const base::InputError& error) {
    say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

bool CalibrationPanel::saveImages(const QString& folder) {
  try {
    views_->saveImages(folder.toStdString());
    say(tr("Saved: the images of the views in %1").arg(folder));
    return true;
  } catch (const base::InputError& error) {
    say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

void CalibrationPanel::askFolder(const QString& title, void (CalibrationPanel::*then)(const QString&)) {
  auto* dialog = new QFileDialog(this, title);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, then);
  dialog->open();
}

void CalibrationPanel::refresh() {
  const auto used = views_->used();
  count_->setText(tr("%1 views, %2 used").arg(views_->views().size()).arg(used));
  collect_->setText(collecting_ ? tr("Stop") : tr("Collect views"));
  folder_->setEnabled(!busy());
  clear_->setEnabled(!views_->views().empty());
  calibrate_->setEnabled(used >= 3 && !fit_.busy());
  save_->setEnabled(report_.has_value());
  save_images_->setEnabled(!views_->views().empty());
  for (const int side : {0, 1})
    pictures_[static_cast<std::size_t>(side)]->showCoverage(views_->corners(side), views_->imageSize(),
                                                            views_->coverage(side));
  table_->showViews(report_ ? report_->views : views_->views(), report_.has_value());
  result_->setVisible(report_.has_value());
  if (report_) result_->setText(resultText());
  const auto other = views_->otherBoard();
  other_->setVisible(other.has_value());
  if (other) {
    other_->setText(tr("Use %1 × %2").arg(other->width).arg(other->height));
    say(tr("The images show a chessboard of %1 × %2 inner corners.").arg(other->width).arg(other->height),
        true);
  }
}

QString CalibrationPanel::resultText() const {
  const auto line = [](const QString& name, const QString& left, const QString& right = {}) {
    return name.leftJustified(28) + left.rightJustified(18) + right.rightJustified(18);
  };
  const auto number = [](double value, int digits) { return QString::number(value, 'f', digits); };
  const auto& [left, right] = std::pair{report_->rig.left, report_->rig.right};
  return QStringList{
      line({}, tr("left"), tr("right")),
      line(tr("focal length [px]"),
           tr("%1 ± %2").arg(number(left.fx, 1), number(report_->left.focal_sigma, 1)),
           tr("%1 ± %2").arg(number(right.fx, 1), number(report_->right.focal_sigma, 1))),
      line(tr("reprojection RMS [px]"), number(report_->left.rms, 3), number(report_->right.rms, 3)),
      line(tr("stereo RMS, epipolar [px]"), number(report_->stereo_rms, 3), number(report_->epipolar_rms, 3)),
      line(tr("base line [mm]"), number(base::toMillimetres(report_->rig.baseline()), 2))}
      .join('\n');
}

}  // namespace capstan::widgets
