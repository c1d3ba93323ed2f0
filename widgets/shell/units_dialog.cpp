#include "widgets/shell/units_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace capstan::widgets {

namespace {

using recording::ColumnUnit;

QString choiceText(ColumnUnit unit) {
  if (unit == ColumnUnit::kSi) return UnitsDialog::tr("keep");
  const std::string_view word = recording::wordOf(unit);
  return UnitsDialog::tr("read as %1").arg(QString::fromUtf8(word.data(), static_cast<int>(word.size())));
}

QLabel* wrapped(const QString& text) {
  auto* label = new QLabel(text);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

}  // namespace

UnitsDialog::UnitsDialog(const recording::ImplausibleUnits& refused, QWidget* parent) : QDialog(parent) {
  setObjectName("units");
  setWindowTitle(tr("Units of %1").arg(QFileInfo(QString::fromStdString(refused.file())).fileName()));
  auto* column = new QVBoxLayout(this);
  column->addWidget(
      wrapped(tr("This robot can hardly have measured these columns in SI units. Choose how each "
                 "is read; the table is opened after that.")));
  auto* content = new QWidget;
  auto* grid = new QGridLayout(content);
  grid->setColumnStretch(1, 1);
  for (const recording::UnitFinding& finding : refused.findings()) {
    const int row = grid->rowCount();
    const QString name = QString::fromStdString(finding.column);
    rows_.push_back({name, choiceOf(finding)});
    grid->addWidget(new QLabel(name), row, 0, Qt::AlignTop);
    grid->addWidget(wrapped(QString::fromStdString(finding.text)), row, 1, Qt::AlignTop);
    grid->addWidget(rows_.back().choice, row, 2, Qt::AlignTop);
  }
  grid->setRowStretch(grid->rowCount(), 1);
  auto* scroll = new QScrollArea;
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  column->addWidget(scroll, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Open)->setDefault(true);
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(this, &QDialog::accepted, this, [this] { Q_EMIT chosen(readAs()); });
  resize(760, std::min(140 + 52 * static_cast<int>(rows_.size()), 520));
}

QComboBox* UnitsDialog::choiceOf(const recording::UnitFinding& finding) {
  auto* box = new QComboBox;
  box->setObjectName(QString::fromStdString(finding.column));
  box->setAccessibleName(tr("unit of %1").arg(box->objectName()));
  for (const ColumnUnit unit : finding.units) box->addItem(choiceText(unit), static_cast<int>(unit));
  box->addItem(choiceText(ColumnUnit::kSi), static_cast<int>(ColumnUnit::kSi));
  box->setCurrentIndex(box->findData(static_cast<int>(finding.unit.value_or(ColumnUnit::kSi))));
  return box;
}

QString UnitsDialog::readAs() const {
  recording::ReadAs read_as;
  for (const Row& row : rows_)
    read_as.units[row.column.toStdString()] = static_cast<ColumnUnit>(row.choice->currentData().toInt());
  return QString::fromStdString(recording::formatReadAs(read_as));
}

}  // namespace capstan::widgets
