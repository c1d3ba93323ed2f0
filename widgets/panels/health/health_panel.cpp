#include "widgets/panels/health/health_panel.h"

#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/health/health_text.h"
#include "widgets/panels/health/nis_plot.h"

namespace capstan::widgets {

using tracking::HealthCheck;
using tracking::HealthVerdict;

namespace {

void paint(QLabel& label, const QColor& colour) {
  QPalette palette = label.palette();
  palette.setColor(QPalette::WindowText, colour);
  label.setPalette(palette);
}

QString toQt(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

HealthPanel::HealthPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 10, 12, 10);
  column->setSpacing(8);
  headline_ = new QLabel;
  headline_->setFont(textFont(13.0, true));
  plot_ = new NisPlot;
  grid_ = new QGridLayout;
  grid_->setHorizontalSpacing(12);
  grid_->setVerticalSpacing(3);
  grid_->setColumnStretch(2, 1);
  column->addWidget(headline_);
  column->addLayout(grid_);
  column->addWidget(plot_, 1);
  showHealth({}, {});
}

QString HealthPanel::headline() const { return headline_->text(); }

void HealthPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  plot_->setTheme(theme);
  for (std::size_t i = 0; i < rows_.size(); ++i) showRow(rows_[i], checks_[i]);
  paintHeadline();
}

void HealthPanel::showHealth(const std::vector<HealthCheck>& checks, const tracking::InnovationRecord& nis) {
  checks_ = checks;
  const HealthVerdict verdict = tracking::worstOf(checks);
  const auto unknown = std::ranges::count(checks, HealthVerdict::kUnknown, &HealthCheck::verdict);
  headline_->setText(
      checks.empty() ? tr("Nothing has been tracked yet")
      : unknown == 0
          ? verdictText(verdict)
          : tr("%1 · %2 of %3 checks unknown").arg(verdictText(verdict)).arg(unknown).arg(checks.size()));
  paintHeadline();
  setRows(checks.size());
  for (std::size_t i = 0; i < checks.size(); ++i) showRow(rows_[i], checks[i]);
  plot_->showRecord(nis);
}

void HealthPanel::paintHeadline() {
  restyle(*headline_,
          QStringLiteral("color: %1").arg(verdictColour(tracking::worstOf(checks_), theme_).name()));
}

void HealthPanel::setRows(std::size_t count) {
  while (rows_.size() > count) {
    for (QLabel* label : {rows_.back().name, rows_.back().verdict, rows_.back().value, rows_.back().advice})
      delete label;
    rows_.pop_back();
  }
  while (rows_.size() < count) {
    const int line = 2 * static_cast<int>(rows_.size());
    Row row{new QLabel, new QLabel, new QLabel, new QLabel};
    row.advice->setWordWrap(true);
    row.value->setWordWrap(true);
    row.value->setTextInteractionFlags(Qt::TextSelectableByMouse);
    row.advice->setTextInteractionFlags(Qt::TextSelectableByMouse);
    grid_->addWidget(row.name, line, 0, Qt::AlignTop);
    grid_->addWidget(row.verdict, line, 1, Qt::AlignTop);
    grid_->addWidget(row.value, line, 2);
    grid_->addWidget(row.advice, line + 1, 0, 1, 3);
    rows_.push_back(row);
  }
}

void HealthPanel::showRow(const Row& row, const HealthCheck& check) {
  row.name->setText(toQt(check.name));
  row.verdict->setText(verdictText(check.verdict));
  row.value->setText(toQt(check.value.empty() ? "–" : check.value));
  row.value->setToolTip(tr("expected: %1").arg(toQt(check.expected)));
  row.advice->setText(toQt(check.advice));
  row.advice->setVisible(!check.advice.empty());
  paint(*row.name, theme_.muted);
  paint(*row.verdict, verdictColour(check.verdict, theme_));
  paint(*row.value, theme_.text);
  paint(*row.advice, theme_.text);
}

}  // namespace capstan::widgets
