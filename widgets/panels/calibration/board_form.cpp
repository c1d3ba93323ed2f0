#include "widgets/panels/calibration/board_form.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSpinBox>

#include "core/base/units.h"

namespace capstan::widgets {

namespace {

using vision::BoardDictionary;
using vision::BoardKind;

QSpinBox* countBox(const QString& name) {
  auto* box = new QSpinBox;
  box->setRange(2, 50);
  box->setObjectName(name);
  box->setKeyboardTracking(false);
  return box;
}

QDoubleSpinBox* lengthBox(const QString& name) {
  auto* box = new QDoubleSpinBox;
  box->setRange(0.1, 1000.0);
  box->setDecimals(2);
  box->setSuffix(QObject::tr(" mm"));
  box->setObjectName(name);
  box->setKeyboardTracking(false);
  return box;
}

}  // namespace

BoardForm::BoardForm(QWidget* parent) : QWidget(parent) {
  kind_ = new QComboBox;
  kind_->addItem(tr("Chessboard"), static_cast<int>(BoardKind::kChessboard));
  kind_->addItem(tr("ChArUco board"), static_cast<int>(BoardKind::kCharuco));
  kind_->addItem(tr("ArUco grid"), static_cast<int>(BoardKind::kAruco));
  dictionary_ = new QComboBox;
  for (const auto& [dictionary, name] : base::NamesOf<BoardDictionary>::value)
    dictionary_->addItem(name, static_cast<int>(dictionary));
  columns_ = countBox("columns");
  rows_ = countBox("rows");
  square_ = lengthBox("square");
  marker_ = lengthBox("marker");
  size_label_ = new QLabel;
  marker_label_ = new QLabel(tr("Marker"));
  dictionary_label_ = new QLabel(tr("Dictionary"));
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  const auto add = [grid](int row, int column, QLabel* label, QWidget* field) {
    label->setBuddy(field);
    grid->addWidget(label, row, column, Qt::AlignRight);
    grid->addWidget(field, row, column + 1);
  };
  auto* size = new QWidget;
  auto* pair = new QHBoxLayout(size);
  pair->setContentsMargins(0, 0, 0, 0);
  pair->addWidget(columns_);
  pair->addWidget(new QLabel(QStringLiteral("×")));
  pair->addWidget(rows_);
  add(0, 0, new QLabel(tr("Board")), kind_);
  add(0, 2, size_label_, size);
  add(1, 0, new QLabel(tr("Square")), square_);
  add(1, 2, marker_label_, marker_);
  add(2, 0, dictionary_label_, dictionary_);
  grid->setColumnStretch(4, 1);
  setOptions({});
  const auto tell = [this] {
    showMarkerFields();
    if (!filling_) Q_EMIT changed();
  };
  for (auto* box : {kind_, dictionary_})
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, tell);
  for (auto* box : {columns_, rows_}) connect(box, QOverload<int>::of(&QSpinBox::valueChanged), this, tell);
  for (auto* box : {square_, marker_})
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, tell);
}

vision::CalibrationOptions BoardForm::options() const {
  vision::CalibrationOptions options;
  options.board = static_cast<BoardKind>(kind_->currentData().toInt());
  options.dictionary = static_cast<BoardDictionary>(dictionary_->currentData().toInt());
  options.board_columns = columns_->value();
  options.board_rows = rows_->value();
  options.square_size = 1e-3 * square_->value();
  options.marker_size = 1e-3 * marker_->value();
  return options;
}

void BoardForm::setOptions(const vision::CalibrationOptions& options) {
  filling_ = true;
  kind_->setCurrentIndex(kind_->findData(static_cast<int>(options.board)));
  dictionary_->setCurrentIndex(dictionary_->findData(static_cast<int>(options.dictionary)));
  columns_->setValue(options.board_columns);
  rows_->setValue(options.board_rows);
  square_->setValue(base::toMillimetres(options.square_size));
  marker_->setValue(base::toMillimetres(options.marker_size));
  filling_ = false;
  showMarkerFields();
}

void BoardForm::showMarkerFields() {
  const auto kind = static_cast<BoardKind>(kind_->currentData().toInt());
  for (QWidget* field : {static_cast<QWidget*>(dictionary_), static_cast<QWidget*>(marker_),
                         static_cast<QWidget*>(marker_label_), static_cast<QWidget*>(dictionary_label_)})
    field->setVisible(kind != BoardKind::kChessboard);
  size_label_->setText(kind == BoardKind::kAruco ? tr("Markers") : tr("Inner corners"));
  const QString square =
      kind == BoardKind::kAruco ? tr("From one marker to the next") : tr("Side of a square");
  square_->setToolTip(square);
  columns_->setMinimum(kind == BoardKind::kAruco ? 2 : 3);
  rows_->setMinimum(columns_->minimum());
}

}  // namespace capstan::widgets
