#include "widgets/panels/filter/filter_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "core/base/error.h"
#include "core/tracking/option_changes.h"

namespace capstan::widgets {

using tracking::TrackingOptions;

namespace {

constexpr double kMilliseconds = 1e-3;  // [s]

}  // namespace

FilterPanel::FilterPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 10, 12, 10);
  column->setSpacing(8);
  auto* form = new QFormLayout;
  form->setSpacing(8);
  filter_ = addChoice(*form, tr("Filter"), "filter",
                      tr("augmented: with slow errors of the transmission; six_state: as in the paper"));
  one_camera_ = addChoice(
      *form, tr("One camera blocked"), "one_camera",
      tr("What the filter observes meanwhile: the motors (kinematics), or the ray of the other camera"));
  gate_ = addNumber(*form, tr("Probability of the gate"), "gate_probability",
                    tr("Of the chi-square test on the innovation: a camera sample beyond it is rejected"));
  gate_->setDecimals(6);
  gate_->setRange(0.5, 0.999999);
  gate_->setSingleStep(0.001);
  epipolar_ = addNumber(*form, tr("Epipolar limit"), "epipolar_limit",
                        tr("Largest distance of a marker from the other image's epipolar line"));
  epipolar_->setRange(0.1, 100.0);
  epipolar_->setDecimals(1);
  epipolar_->setSingleStep(0.5);
  epipolar_->setSuffix(tr(" px"));
  delay_ = addNumber(*form, tr("Camera delay"), "camera_delay",
                     tr("Time stamp minus exposure of a camera sample; Identification estimates it"));
  delay_->setRange(-500.0, 500.0);
  delay_->setDecimals(1);
  delay_->setSuffix(tr(" ms"));
  column->addLayout(form);
  load_ = new QPushButton(tr("From file…"));
  reset_ = new QPushButton(tr("As in the source"));
  auto* row = new QHBoxLayout;
  row->addWidget(load_);
  row->addStretch(1);
  row->addWidget(reset_);
  column->addLayout(row);
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setMargin(8);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(words_);
  column->addStretch(1);
  fill(*filter_, &TrackingOptions::filter, tr("filter"));
  fill(*one_camera_, &TrackingOptions::one_camera, tr("one camera blocked"));
  follow(*gate_, &TrackingOptions::gate_probability, 1.0, tr("gate"));
  follow(*epipolar_, &TrackingOptions::epipolar_limit, 1.0, tr("epipolar limit"));
  follow(*delay_, &TrackingOptions::camera_delay, kMilliseconds, tr("camera delay"));
  connect(reset_, &QPushButton::clicked, this, [this] { take(source_, tr("filter options")); });
  connect(load_, &QPushButton::clicked, this, [this] {
    auto* dialog = new QFileDialog(this, tr("Filter options"), {}, tr("Filter options (*.yaml)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, &FilterPanel::load);
    dialog->open();
  });
  setTheme(theme_);
  refresh();
}

QComboBox* FilterPanel::addChoice(QFormLayout& form, const QString& label, const QString& key,
                                  const QString& tip) {
  auto* box = new QComboBox;
  box->setObjectName(key);
  box->setToolTip(tip);
  form.addRow(label, box);
  return box;
}

QDoubleSpinBox* FilterPanel::addNumber(QFormLayout& form, const QString& label, const QString& key,
                                       const QString& tip) {
  auto* box = new QDoubleSpinBox;
  box->setObjectName(key);
  box->setToolTip(tip);
  box->setKeyboardTracking(false);  // a half-typed number would restart the filter
  form.addRow(label, box);
  return box;
}

template <class Enum>
void FilterPanel::fill(QComboBox& box, Enum TrackingOptions::*field, const QString& name) {
  for (const auto& [which, text] : base::NamesOf<Enum>::value) box.addItem(text, static_cast<int>(which));
  connect(&box, qOverload<int>(&QComboBox::currentIndexChanged), this, [this, &box, field, name] {
    TrackingOptions next = options_;
    next.*field = static_cast<Enum>(box.currentData().toInt());
    take(next, name);
  });
}

void FilterPanel::follow(QDoubleSpinBox& box, double TrackingOptions::*field, double unit,
                         const QString& name) {
  connect(&box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this, field, unit, name](double value) {
            TrackingOptions next = options_;
            next.*field = unit * value;
            take(next, name);
          });
}

void FilterPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  refresh();
}

void FilterPanel::begin(const TrackingOptions& options) {
  source_ = options;
  open_ = true;
  setOptions(options);
}

void FilterPanel::setOptions(const TrackingOptions& options) {
  options_ = options;
  refusal_.clear();
  const auto choose = [](QComboBox& box, auto which) {
    const QSignalBlocker quiet(box);
    box.setCurrentIndex(box.findData(static_cast<int>(which)));
  };
  const auto show = [](QDoubleSpinBox& box, double value) {
    const QSignalBlocker quiet(box);
    box.setValue(value);
  };
  choose(*filter_, options.filter);
  choose(*one_camera_, options.one_camera);
  show(*gate_, options.gate_probability);
  show(*epipolar_, options.epipolar_limit);
  show(*delay_, options.camera_delay / kMilliseconds);
  refresh();
}

void FilterPanel::take(const TrackingOptions& options, const QString& name) {
  setOptions(options);
  Q_EMIT changed(options, name);
}

void FilterPanel::load(const QString& file) {
  try {
    take(tracking::readTrackingOptions(file.toStdString()),
         tr("options of %1").arg(QFileInfo(file).fileName()));
  } catch (const base::InputError& error) {
    refusal_ = QString::fromUtf8(error.what());
    refresh();
  }
}

QString FilterPanel::words() const { return words_->text(); }

void FilterPanel::refresh() {
  const std::string changes = tracking::optionChanges(source_, options_);
  for (QWidget* each : std::initializer_list<QWidget*>{filter_, one_camera_, gate_, epipolar_, delay_, load_})
    each->setEnabled(open_);
  reset_->setEnabled(open_ && !changes.empty());
  words_->setText(!refusal_.isEmpty() ? refusal_
                  : !open_            ? tr("No session: open one first.")
                  : changes.empty()
                      ? tr("As in the source. A change restarts the filter and the error table.")
                      : tr("Other than in the source: %1").arg(QString::fromStdString(changes)));
  restyle(*words_, noticeStyle(theme_, refusal_.isEmpty() ? theme_.border : theme_.fault));
}

}  // namespace capstan::widgets
