#include "widgets/panels/analysis/options_bar.h"

#include <QBoxLayout>
#include <QCheckBox>
#include <QComboBox>
#include <QMenu>
#include <QSettings>
#include <QShortcut>
#include <QSignalBlocker>
#include <QToolButton>

#include "widgets/panels/analysis/analysis_figures.h"

namespace capstan::widgets {

using analysis::TimeShare;
using experiments::Estimator;

namespace {

constexpr std::array kEstimators = {Estimator::kKinematic, Estimator::kCamera, Estimator::kUkf};
constexpr const char* kLetters = "KCU";

/// Selects the next entry; after the last, the first.
void turn(QComboBox* box) { box->setCurrentIndex((box->currentIndex() + 1) % box->count()); }

}  // namespace

OptionsBar::OptionsBar(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2);  // all of it fits beside the docks of a window of 1280 px
  addChoices();
  addEstimators();
  row->addStretch(1);
  addExport();
  addKeys();
  setTheme(Theme::dark());
}

void OptionsBar::addChoices() {
  const auto box = [this](const QString& name, const QString& tip, const QStringList& entries) {
    auto* made = new QComboBox;
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setAccessibleName(name);
    made->addItems(entries);
    layout()->addWidget(made);
    connect(made, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &OptionsBar::changed);
    return made;
  };
  joint_ = box("joint", tr("Joint (Alt+0 all, Alt+1, Alt+2, Alt+3)"),
               {tr("all joints"), tr("joint 1"), tr("joint 2"), tr("joint 3")});
  error_ = box("error", tr("Error, or its absolute value (Alt+A)"), {tr("error"), tr("|error|")});
  share_ = box("time", tr("Time to analyse: all, only occluded, only observed (Alt+T)"),
               {tr("all time"), tr("occluded"), tr("seen")});
}

void OptionsBar::addEstimators() {
  for (std::size_t i = 0; i < kEstimators.size(); ++i) {
    auto* box = new QCheckBox(nameOf(quantityOf(kEstimators[i])));
    box->setObjectName(QString::fromStdString(std::string(base::nameOf(kEstimators[i]))));
    box->setToolTip(tr("Show it (Alt+%1)").arg(QLatin1Char(kLetters[i])));
    box->setChecked(kEstimators[i] != Estimator::kCamera);
    layout()->addWidget(box);
    estimators_[i] = box;
    connect(box, &QCheckBox::toggled, this, &OptionsBar::changed);
  }
}

void OptionsBar::addExport() {
  export_ = new QToolButton;
  export_->setObjectName("export_analysis");
  export_->setText(tr("Export ▾"));
  export_->setToolTip(tr("Figures as PDF, SVG, PNG and CSV, the table as Markdown, LaTeX and CSV (Alt+E)"));
  export_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(export_);
  const std::pair<PaperSize, QString> sizes[] = {{{180.0, 120.0}, tr("two columns, %1 × %2 mm")},
                                                 {{180.0, 240.0}, tr("page, %1 × %2 mm")},
                                                 {{88.0, 60.0}, tr("one column, %1 × %2 mm")},
                                                 {{88.0, 90.0}, tr("one column, %1 × %2 mm")},
                                                 {{240.0, 135.0}, tr("slide, %1 × %2 mm")}};
  for (const auto& [size, words] : sizes)
    menu->addAction(words.arg(size.width_mm).arg(size.height_mm), this,
                    [this, size = size] { Q_EMIT exportRequested(size); });
  menu->addSeparator();
  titles_ = menu->addAction(tr("titles above the figures"));
  titles_->setCheckable(true);
  titles_->setChecked(true);
  titles_->setToolTip(tr("If off, title and note are only in the captions of the index page"));
  export_->setMenu(menu);
  layout()->addWidget(export_);
}

void OptionsBar::addKeys() {
  const auto key = [this](const QString& sequence, auto&& act) {
    auto* shortcut = new QShortcut(QKeySequence(sequence), this);
    shortcut->setAutoRepeat(false);
    connect(shortcut, &QShortcut::activated, this, act);
  };
  for (int i = 0; i <= 3; ++i)
    key(QStringLiteral("Alt+%1").arg(i), [this, i] { joint_->setCurrentIndex(i); });
  key("Alt+A", [this] { turn(error_); });
  key("Alt+T", [this] { turn(share_); });
  for (std::size_t i = 0; i < estimators_.size(); ++i)
    key(QStringLiteral("Alt+%1").arg(QLatin1Char(kLetters[i])), [this, i] { estimators_[i]->toggle(); });
  key("Alt+E", [this] {
    if (export_->isEnabled()) export_->showMenu();
  });
}

void OptionsBar::setTheme(const Theme& theme) {
  for (std::size_t i = 0; i < kEstimators.size(); ++i)
    estimators_[i]->setStyleSheet(QStringLiteral("QCheckBox { color: %1; }")
                                      .arg(theme.inkOf(theme.colour(quantityOf(kEstimators[i]))).name()));
}

analysis::AnalysisOptions OptionsBar::options() const {
  analysis::AnalysisOptions options;
  if (joint_->currentIndex() > 0) options.joint = joint_->currentIndex() - 1;
  options.absolute = error_->currentIndex() == 1;
  options.share = static_cast<TimeShare>(share_->currentIndex());
  options.estimators.clear();
  for (std::size_t i = 0; i < kEstimators.size(); ++i)
    if (estimators_[i]->isChecked()) options.estimators.push_back(kEstimators[i]);
  return options;
}

void OptionsBar::setJoint(std::optional<int> joint) { joint_->setCurrentIndex(joint ? *joint + 1 : 0); }

void OptionsBar::setExportEnabled(bool on) { export_->setEnabled(on); }

void OptionsBar::save(QSettings& settings) const {
  settings.setValue("analysis/joint", joint_->currentIndex());
  settings.setValue("analysis/error", error_->currentIndex());
  settings.setValue("analysis/time", share_->currentIndex());
  settings.setValue("analysis/titles", titles());
  for (std::size_t i = 0; i < estimators_.size(); ++i)
    settings.setValue("analysis/" + estimators_[i]->objectName(), estimators_[i]->isChecked());
}

void OptionsBar::restore(const QSettings& settings) {
  const QSignalBlocker quiet(this);
  const std::pair<const char*, QComboBox*> boxes[] = {
      {"analysis/joint", joint_}, {"analysis/error", error_}, {"analysis/time", share_}};
  for (const auto& [key, box] : boxes) {
    const int index = settings.value(key, 0).toInt();
    if (index >= 0 && index < box->count()) box->setCurrentIndex(index);
  }
  titles_->setChecked(settings.value("analysis/titles", true).toBool());
  for (QCheckBox* box : estimators_)
    box->setChecked(settings.value("analysis/" + box->objectName(), box->isChecked()).toBool());
}

}  // namespace capstan::widgets
