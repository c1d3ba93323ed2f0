#include "widgets/panels/calibration/view_table.h"

#include <QHeaderView>
#include <cmath>

namespace capstan::widgets {

namespace {

using vision::CalibrationView;
using vision::ViewFault;

enum Column { kView, kLeft, kRight, kStereo, kEpipolar, kState, kColumns };

QTableWidgetItem* cell(const QString& text) {
  auto* item = new QTableWidgetItem(text);
  item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  return item;
}

QString stateOf(const CalibrationView& view, bool fitted) {
  const auto name = base::nameOf(view.fault);
  if (!view.used()) return QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  if (fitted && view.outlying) return QObject::tr("outlier: exclude it");
  return view.crowded ? QObject::tr("used; corners close together") : QObject::tr("used");
}

}  // namespace

ViewTable::ViewTable(QWidget* parent) : QTableWidget(0, kColumns, parent) {
  setHorizontalHeaderLabels(
      {tr("view"), tr("left [px]"), tr("right [px]"), tr("stereo [px]"), tr("epipolar [px]"), tr("state")});
  horizontalHeaderItem(kLeft)->setToolTip(tr("RMS reprojection error of the left camera alone"));
  horizontalHeaderItem(kStereo)->setToolTip(tr("RMS reprojection error of both with one pose of the board"));
  horizontalHeaderItem(kEpipolar)->setToolTip(tr("RMS distance from the epipolar lines of the other image"));
  setAccessibleName(tr("views"));
  verticalHeader()->hide();
  horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  horizontalHeader()->setStretchLastSection(true);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setMinimumHeight(84);
  connect(this, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (!filling_ && item->column() == kView) Q_EMIT excluded(item->row(), item->checkState() != Qt::Checked);
  });
}

void ViewTable::showViews(const std::vector<CalibrationView>& views, bool fitted) {
  filling_ = true;
  const bool grown = static_cast<int>(views.size()) > rowCount();
  setRowCount(static_cast<int>(views.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const CalibrationView& view = views[static_cast<std::size_t>(row)];
    auto* name = cell(QString::fromStdString(view.left));
    name->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    if (view.used() || view.fault == ViewFault::kExcluded) {
      name->setFlags(name->flags() | Qt::ItemIsUserCheckable);
      name->setCheckState(view.used() ? Qt::Checked : Qt::Unchecked);
    }
    setItem(row, kView, name);
    const double errors[] = {view.left_error, view.right_error, view.stereo_error, view.epipolar_error};
    for (int i = 0; i < 4; ++i)
      setItem(row, kLeft + i, cell(fitted && view.used() ? QString::number(errors[i], 'f', 3) : "–"));
    auto* state = cell(stateOf(view, fitted));
    state->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    setItem(row, kState, state);
  }
  if (grown) scrollToBottom();
  filling_ = false;
}

}  // namespace capstan::widgets
