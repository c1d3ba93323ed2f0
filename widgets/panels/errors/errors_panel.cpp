#include "widgets/panels/errors/errors_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <cmath>

namespace capstan::widgets {

namespace {

constexpr Quantity kColumns[] = {Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf};
constexpr double kCellPoints = 14.0;

/// Cell text with fixed width and two decimals, so that decimal points line up.
QString cellText(double rms, int joint) {
  if (!std::isfinite(rms)) return QStringLiteral("—.——").rightJustified(5);
  return QString::number(tracking::forPeople(rms, joint), 'f', 2).rightJustified(5);
}

QString samplesOf(const tracking::TrackReport& report) {
  return QString::number(report.errors.ukf().count());
}

/// What restarted the report; empty: nothing.
QString startOf(const tracking::TrackReport& report) {
  if (report.since == tracking::ReportStart::kBeginning) return {};
  return QString::fromStdString(std::string(base::nameOf(report.since)));
}

QString noteOf(const tracking::TrackReport& report) {
  if (report.own_kinematics)
    return report.errors.ukf().count() > 0 ? ErrorsPanel::tr("own kinematics, no truth")
                                           : ErrorsPanel::tr("no joint encoders");
  const QString start = startOf(report);
  return start.isEmpty() ? ErrorsPanel::tr("%1 samples").arg(samplesOf(report))
                         : ErrorsPanel::tr("%1 since %2").arg(samplesOf(report), start);
}

QString tipOf(const tracking::TrackReport& report) {
  if (report.own_kinematics)
    return ErrorsPanel::tr(
               "The reference is the robot's own kinematics, computed from its motors: these are "
               "differences from it, not errors. %1 samples.")
        .arg(samplesOf(report));
  const QString start = startOf(report);
  return start.isEmpty() ? QString()
                         : ErrorsPanel::tr(
                               "RMS of the samples since %1, at %2 s: those before are of other "
                               "assumptions")
                               .arg(start)
                               .arg(report.first_t, 0, 'f', 1);
}

}  // namespace

ErrorsPanel::ErrorsPanel(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(10, 6, 10, 8);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  const char* heads[] = {"kin", "cam", "UKF"};
  for (int column = 0; column < 3; ++column) {
    auto*& head = heads_[static_cast<std::size_t>(column)];
    head = new QLabel(heads[column]);
    head->setFont(numberFont(11.0, true));
    grid->addWidget(head, 0, column + 1, Qt::AlignRight);
  }
  for (int joint = 0; joint < 3; ++joint) {
    const auto row = static_cast<std::size_t>(joint);
    auto*& name = quiet_[row];
    auto*& unit = quiet_[row + 3];
    name = new QLabel(QStringLiteral("q%1").arg(joint + 1));
    unit = new QLabel(tracking::kJointUnits[row]);
    name->setFont(numberFont(kCellPoints));
    unit->setFont(textFont(11.0));
    grid->addWidget(name, joint + 1, 0);
    grid->addWidget(unit, joint + 1, 4);
    for (int column = 0; column < 3; ++column) {
      auto*& cell = cells_[row][static_cast<std::size_t>(column)];
      cell = new QLabel;
      cell->setFont(numberFont(kCellPoints));
      cell->setTextInteractionFlags(Qt::TextSelectableByMouse);
      grid->addWidget(cell, joint + 1, column + 1, Qt::AlignRight);
    }
  }
  note_ = new QLabel;
  note_->setFont(textFont(9.5));
  note_->setWordWrap(true);
  note_->setFixedHeight(2 * note_->fontMetrics().lineSpacing());  // the panel has one height
  reset_ = new QPushButton(tr("Reset"));
  reset_->setToolTip(tr("Restart the errors (E)"));
  reset_->setShortcut(QKeySequence(Qt::Key_E));
  connect(reset_, &QPushButton::clicked, this, &ErrorsPanel::resetRequested);
  health_ = new QPushButton;
  health_->setToolTip(tr("Estimator health: checks of the estimator, with advice (Ctrl+7)"));
  connect(health_, &QPushButton::clicked, this, &ErrorsPanel::healthRequested);
  auto* foot = new QHBoxLayout;
  foot->setSpacing(6);
  foot->addWidget(note_, 1);
  foot->addWidget(health_);
  foot->addWidget(reset_);
  grid->addLayout(foot, 4, 0, 1, 5);
  showVerdict({});
  grid->setRowStretch(5, 1);
  for (int column = 1; column <= 3; ++column) grid->setColumnStretch(column, 1);
  auto* copy = new QAction(tr("Copy as text"), this);
  connect(copy, &QAction::triggered, this, [this] { QApplication::clipboard()->setText(text()); });
  addAction(copy);
  setContextMenuPolicy(Qt::ActionsContextMenu);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  setTheme(Theme::dark());
  showReport({});
}

void ErrorsPanel::showVerdict(const QString& verdict) {
  health_->setText(verdict.isEmpty() ? tr("– health") : verdict);
  health_->setAccessibleName(tr("Estimator health: %1").arg(verdict.isEmpty() ? tr("unknown") : verdict));
}

QString ErrorsPanel::text() const {
  QString out = tr("RMS\tkinematic\tcamera\tUKF\tunit\n");
  for (int joint = 0; joint < 3; ++joint) {
    out += QStringLiteral("q%1").arg(joint + 1);
    for (int column = 0; column < 3; ++column) out += "\t" + cell(joint, column).trimmed();
    out += QStringLiteral("\t%1\n").arg(tracking::kJointUnits[static_cast<std::size_t>(joint)]);
  }
  return out;
}

void ErrorsPanel::setTheme(const Theme& theme) {
  const auto paint = [](QWidget* widget, const QColor& colour) {
    QPalette palette = widget->palette();
    palette.setColor(QPalette::WindowText, colour);
    widget->setPalette(palette);
  };
  for (std::size_t column = 0; column < 3; ++column) {
    paint(heads_[column], theme.inkOf(theme.colour(kColumns[column])));
    for (auto& row : cells_) paint(row[column], theme.text);
  }
  for (auto* label : quiet_) paint(label, theme.muted);
  paint(note_, theme.muted);
}

void ErrorsPanel::setReference(bool fitted) {
  reference_ = fitted;
  showReport({});
}

void ErrorsPanel::showReport(const tracking::TrackReport& report) {
  const tracking::ErrorTable& errors = report.errors;
  const Eigen::Vector3d columns[] = {errors.kinematic().value(), errors.camera().value(),
                                     errors.ukf().value()};
  for (int joint = 0; joint < 3; ++joint)
    for (std::size_t column = 0; column < 3; ++column)
      cells_[static_cast<std::size_t>(joint)][column]->setText(cellText(columns[column][joint], joint));
  note_->setText(reference_ ? noteOf(report) : tr("no joint encoders here"));
  note_->setToolTip(tipOf(report));
}

QString ErrorsPanel::note() const { return note_->text(); }

QString ErrorsPanel::cell(int joint, int column) const {
  return cells_[static_cast<std::size_t>(joint)][static_cast<std::size_t>(column)]->text();
}

}  // namespace capstan::widgets
