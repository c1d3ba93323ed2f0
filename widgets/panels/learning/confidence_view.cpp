#include "widgets/panels/learning/confidence_view.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QLabel>
#include <QShortcut>
#include <QSlider>

#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

namespace {

constexpr int kSteps = 40, kSoon = 150;  ///< steps of the slider; delay after its last move [ms]

}  // namespace

ConfidenceView::ConfidenceView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 6, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  axis_ = new QComboBox;
  axis_->setObjectName("slice_axis");
  for (const char* name : {"x", "y", "z"}) axis_->addItem(tr("plane across %1").arg(name));
  axis_->setCurrentIndex(2);
  axis_->setToolTip(tr("Axis normal to the plane (Alt+A: the next)"));
  depth_ = new QSlider(Qt::Horizontal);
  depth_->setObjectName("slice_depth");
  depth_->setRange(0, kSteps);
  depth_->setPageStep(kSteps / 10);
  depth_->setValue(kSteps / 2);
  depth_->setToolTip(tr("Position of the plane, from the lowest to the highest training position (← →)"));
  depth_->setAccessibleName(tr("depth of the plane"));
  words_ = new QLabel;
  words_->setMinimumWidth(words_->fontMetrics().horizontalAdvance(tr("computing…")) + 8);
  row->addWidget(axis_);
  row->addWidget(new QLabel(tr("depth")));
  row->addWidget(depth_, 1);
  row->addWidget(words_);
  column->addLayout(row);
  column->addWidget(sheet_ = new FigureSheet, 1);
  sheet_->setEmptyWords(tr("Confidence of the correction, once it is trained: press Train (F5)"));
  soon_.setSingleShot(true);
  soon_.setInterval(kSoon);
  connect(&soon_, &QTimer::timeout, this, &ConfidenceView::compute);
  connect(axis_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &ConfidenceView::ask);
  connect(depth_, &QSlider::valueChanged, this, &ConfidenceView::ask);
  connect(&job_, &Job::ended, this, [this] {
    if (stale_)
      compute();
    else
      words_->clear();
  });
  connect(new QShortcut(QKeySequence(QStringLiteral("Alt+A")), this), &QShortcut::activated, this,
          [this] { axis_->setCurrentIndex((axis_->currentIndex() + 1) % axis_->count()); });
}

void ConfidenceView::setTheme(const Theme& theme) {
  sheet_->setTheme(theme);
  QPalette palette = words_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  words_->setPalette(palette);
}

void ConfidenceView::showResults(const LearningResults& results) {
  if (learned_ == results.learned) return;
  learned_ = results.learned;
  sheet_->setFigure(nullptr);
  for (QWidget* one : {static_cast<QWidget*>(axis_), static_cast<QWidget*>(depth_)})
    one->setEnabled(learned_ != nullptr);
  ask();
}

const learning::ConfidenceSlice* ConfidenceView::slice() const {
  const auto* figure = qobject_cast<ConfidenceFigure*>(sheet_->figure());
  return figure ? &figure->data().slice : nullptr;
}

void ConfidenceView::ask() {
  stale_ = learned_ != nullptr;
  job_.cancel();
  soon_.start();
}

void ConfidenceView::compute() {
  if (!stale_ || job_.busy()) return;
  stale_ = false;
  words_->setText(tr("computing…"));
  learning::SliceOptions options;
  options.axis = axis_->currentIndex();
  options.depth = static_cast<double>(depth_->value()) / kSteps;
  job_.start(
      [learned = learned_, options](base::Progress& progress) {
        return learning::confidenceSlice(
            learned->model, learning::kept(learned->prepared.states, learned->cleaning), options, &progress);
      },
      [this](learning::ConfidenceSlice slice) {
        sheet_->setFigure(std::make_unique<ConfidenceFigure>(confidenceData(slice)));
      });
}

}  // namespace capstan::widgets
