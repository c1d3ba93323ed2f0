#include "widgets/panels/marker/marker_panel.h"

#include <QBoxLayout>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <utility>

#include "core/base/error.h"
#include "core/vision/marker_detector.h"
#include "core/vision/marker_file.h"
#include "core/vision/pick_marker.h"
#include "widgets/panels/marker/marker_picture.h"

namespace capstan::widgets {
namespace {

QString adviceFor(vision::PickFault fault) {
  using Fault = vision::PickFault;
  switch (fault) {
    case Fault::kNoColour:
      return QObject::tr("Click a coloured pixel of the marker, not a highlight or a shadow.");
    case Fault::kTooSmall:
      return QObject::tr("Click the marker itself, or move the camera nearer.");
    default:
      return QObject::tr("Click the marker; its colour must differ from the background.");
  }
}

QSpinBox* wholeBox(int highest, const QString& name, const QString& tip) {
  auto* box = new QSpinBox;
  box->setRange(0, highest);
  box->setObjectName(name);
  box->setToolTip(tip);
  box->setKeyboardTracking(false);
  return box;
}

QDoubleSpinBox* realBox(double lowest, double highest, double step, const QString& name, const QString& tip) {
  auto* box = new QDoubleSpinBox;
  box->setRange(lowest, highest);
  box->setSingleStep(step);
  box->setObjectName(name);
  box->setToolTip(tip);
  box->setKeyboardTracking(false);
  return box;
}

}  // namespace

MarkerPanel::MarkerPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(10);
  auto* advice =
      new QLabel(tr("Click the marker in either picture: its limits follow. Tinted pixels are inside the "
                    "limits; only the marker "
                    "should be."));
  advice->setWordWrap(true);
  auto* pictures = new QHBoxLayout;
  for (int side = 0; side < 2; ++side) {
    auto* picture = new MarkerPicture(side == 0 ? tr("Left") : tr("Right"));
    pictures_[static_cast<std::size_t>(side)] = picture;
    pictures->addWidget(picture, 1);
    connect(picture, &MarkerPicture::picked, this, [this, side](const QPoint& pixel) { pick(side, pixel); });
  }
  message_ = new QLabel;
  message_->setWordWrap(true);
  message_->setMargin(8);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(advice);
  column->addLayout(pictures, 1);
  column->addWidget(message_);
  column->addWidget(makeLimits());
  column->addWidget(makeButtons());
  setTheme(theme_);
  fill();
}

QWidget* MarkerPanel::makeLimits() {
  hue_low_ = wholeBox(179, "hue_low", tr("Lowest hue, 0 to 179; above the highest: around red"));
  hue_high_ = wholeBox(179, "hue_high", tr("Highest hue, 0 to 179"));
  saturation_ = wholeBox(255, "saturation_low", tr("Lowest saturation, 0 to 255"));
  value_ = wholeBox(255, "value_low", tr("Lowest value (brightness), 0 to 255"));
  radius_ = realBox(0.5, 320.0, 0.5, "min_radius", tr("Smallest radius"));
  radius_->setDecimals(1);
  radius_->setSuffix(tr(" px"));
  circularity_ = realBox(0.0, 1.0, 0.05, "min_circularity", tr("4π area / perimeter²: 1 for a circle"));
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  const std::array<std::pair<QString, QWidget*>, 6> fields = {{{tr("Hue from"), hue_low_},
                                                               {tr("to"), hue_high_},
                                                               {tr("Saturation from"), saturation_},
                                                               {tr("Value from"), value_},
                                                               {tr("Radius from"), radius_},
                                                               {tr("Circularity from"), circularity_}}};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    auto* label = new QLabel(fields[i].first);
    label->setBuddy(fields[i].second);
    label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    const int row = static_cast<int>(i) / 2, first = 2 * (static_cast<int>(i) % 2);
    grid->addWidget(label, row, first);
    grid->addWidget(fields[i].second, row, first + 1);
  }
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(3, 1);
  for (QSpinBox* each : {hue_low_, hue_high_, saturation_, value_})
    connect(each, QOverload<int>::of(&QSpinBox::valueChanged), this, &MarkerPanel::takeFields);
  for (QDoubleSpinBox* each : {radius_, circularity_})
    connect(each, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &MarkerPanel::takeFields);
  return box;
}

QWidget* MarkerPanel::makeButtons() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  auto* open = new QPushButton(tr("Open…"));
  auto* save = new QPushButton(tr("Save…"));
  save->setToolTip(tr("Marker file for live set-ups and `capstan-cli detect`"));
  default_ = new QPushButton(tr("Green ball"));
  default_->setToolTip(tr("Limits of the simulation's marker"));
  undo_ = new QPushButton(tr("Undo"));
  row->addWidget(open);
  row->addWidget(save);
  row->addStretch(1);
  row->addWidget(default_);
  row->addWidget(undo_);
  connect(open, &QPushButton::clicked, this, &MarkerPanel::askOpen);
  connect(save, &QPushButton::clicked, this, &MarkerPanel::askSave);
  connect(default_, &QPushButton::clicked, this, [this] { use({}); });
  connect(undo_, &QPushButton::clicked, this, [this] {
    if (!before_) return;
    use(*std::exchange(before_, std::nullopt));
    before_.reset();
    fill();
  });
  return box;
}

void MarkerPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  for (MarkerPicture* picture : pictures_) picture->setTheme(theme);
  say(message(), warning_);
}

QString MarkerPanel::message() const { return message_->text(); }

void MarkerPanel::say(const QString& text, bool warning) {
  warning_ = warning;
  message_->setText(text);
  message_->setVisible(!text.isEmpty());
  restyle(*message_, noticeStyle(theme_, warning ? theme_.warning : theme_.accent));
}

void MarkerPanel::begin(const vision::MarkerOptions& options) {
  options_ = options;
  before_.reset();
  say({}, false);
  fill();
  redraw();
}

void MarkerPanel::showFrames(const tracking::StereoFrame& frame) {
  frame.left.copyTo(frames_[0]);
  frame.right.copyTo(frames_[1]);
  redraw();
}

void MarkerPanel::clear() {
  frames_ = {};
  for (MarkerPicture* picture : pictures_) picture->clear();
}

void MarkerPanel::redraw() {
  for (std::size_t side = 0; side < 2; ++side) {
    const cv::Mat& frame = frames_[side];
    if (frame.empty()) {
      pictures_[side]->clear();
      continue;
    }
    vision::MarkerDetector detector(options_, frame.cols, frame.rows);
    const auto found = detector.detect(frame);
    pictures_[side]->showPicture(frame, detector.mask(), found);
  }
}

void MarkerPanel::pick(int side, const QPoint& pixel) {
  const cv::Mat& frame = frames_[static_cast<std::size_t>(side)];
  const auto picked = vision::pickMarker(frame, {pixel.x(), pixel.y()});
  if (!picked) {
    const auto reason = base::nameOf(picked.error());
    return say(tr("%1, at %2, %3 px. %4")
                   .arg(QString::fromUtf8(reason.data(), static_cast<int>(reason.size())))
                   .arg(pixel.x())
                   .arg(pixel.y())
                   .arg(adviceFor(picked.error())),
               true);
  }
  use(picked->options);
  if (picked->ambiguous())
    say(tr("Another area of %1 px has the marker's colour: a search of the whole picture takes neither. "
           "Cover it, or "
           "use a marker of another colour.")
            .arg(picked->largest_background),
        true);
  else
    say(tr("Limits from the %1 picture. Other areas inside them: %2 px.")
            .arg(side == 0 ? tr("left") : tr("right"))
            .arg(picked->background),
        false);
}

void MarkerPanel::use(const vision::MarkerOptions& options) {
  before_ = options_;
  options_ = options;
  say({}, false);
  fill();
  redraw();
  Q_EMIT optionsChanged(options_);
}

void MarkerPanel::fill() {
  filling_ = true;
  hue_low_->setValue(options_.hue_low);
  hue_high_->setValue(options_.hue_high);
  saturation_->setValue(options_.saturation_low);
  value_->setValue(options_.value_low);
  radius_->setValue(options_.min_radius);
  circularity_->setValue(options_.min_circularity);
  undo_->setEnabled(before_.has_value());
  filling_ = false;
}

void MarkerPanel::takeFields() {
  if (filling_) return;
  vision::MarkerOptions options = options_;
  options.hue_low = hue_low_->value();
  options.hue_high = hue_high_->value();
  options.saturation_low = saturation_->value();
  options.value_low = value_->value();
  options.min_radius = radius_->value();
  options.min_circularity = circularity_->value();
  use(options);
}

bool MarkerPanel::openFile(const QString& file) {
  try {
    use(vision::readMarkerFile(file.toStdString()));
    return true;
  } catch (const base::InputError& error) {
    say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

bool MarkerPanel::saveFile(const QString& file) {
  try {
    vision::writeMarkerFile(options_, file.toStdString());
    say(tr("Saved: %1").arg(file), false);
    return true;
  } catch (const base::InputError& error) {
    say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

void MarkerPanel::askOpen() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open marker file"), {}, tr("Marker files (*.yaml)"));
  if (!file.isEmpty()) openFile(file);
}

void MarkerPanel::askSave() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save marker file"), "marker.yaml", tr("Marker files (*.yaml)"));
  if (!file.isEmpty()) saveFile(file);
}

}  // namespace capstan::widgets
