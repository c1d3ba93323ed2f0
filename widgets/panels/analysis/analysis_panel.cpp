#include "widgets/panels/analysis/analysis_panel.h"

#include <QBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QShortcut>
#include <QSplitter>
#include <QToolButton>

#include "core/base/error.h"
#include "widgets/panels/analysis/analysis_table.h"
#include "widgets/panels/analysis/figure_pair.h"
#include "widgets/panels/analysis/options_bar.h"

namespace capstan::widgets {

using analysis::Analysis;
using analysis::ErrorRun;
using Kind = RunChoice::Kind;

namespace {

constexpr int kFigureShare = 64;  ///< share of the height for the figures, the rest for the table [%]

const std::array<QString, 2> kLetters = {QStringLiteral("A"), QStringLiteral("B")};

QString text(const std::string& words) { return QString::fromStdString(words); }

ErrorRun readRun(const RunChoice& choice, base::Progress& progress) {
  if (choice.kind == Kind::kRecording)
    return analysis::trackErrors(choice.path.toStdString(), choice.robot.toStdString(), progress);
  progress.report(0.0, "reading");
  return analysis::readErrors(choice.path.toStdString(), choice.trial.toStdString());
}

}  // namespace

AnalysisPanel::AnalysisPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  column->setSpacing(5);
  addHead(column);
  split_ = new QSplitter(Qt::Vertical);
  split_->setChildrenCollapsible(false);
  split_->addWidget(figures_ = new FigurePair);
  split_->addWidget(table_ = new AnalysisTable);
  column->addWidget(split_, 1);
  connect(split_, &QSplitter::splitterMoved, this, [this] { user_split_ = true; });
  addFoot(column);
  connect(&job_, &Job::failed, this, &AnalysisPanel::onFailed);
  connect(&job_, &Job::ended, this, [this] {
    work_ = Work::kNothing;
    proceed();
  });
  connect(&job_, &Job::progressed, this, &AnalysisPanel::onProgress);
  connect(&full_export_, &FullExport::progressed, this, &AnalysisPanel::onProgress);
  connect(&full_export_, &FullExport::ended, this, [this](const QString& index, const QString& words) {
    said_ = words;
    if (!index.isEmpty()) Q_EMIT exported(index);
    proceed();
  });
  sides_[0].picker->setChoice({.kind = Kind::kSession});
  setTheme(Theme::dark());
  say();
}

AnalysisPanel::~AnalysisPanel() = default;

void AnalysisPanel::onProgress(double fraction, const QString& doing) {
  progress_->setValue(qRound(100.0 * fraction));
  progress_->setFormat(doing + QStringLiteral(" %p %"));
}

void AnalysisPanel::addHead(QBoxLayout* column) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    sides_[i].picker = new RunPicker(kLetters[i], i > 0);
    column->addWidget(sides_[i].picker);
    connect(sides_[i].picker, &RunPicker::changed, this, [this, i] { onRunChanged(i); });
  }
  options_ = new OptionsBar;
  column->addWidget(options_);
  connect(options_, &OptionsBar::changed, this, &AnalysisPanel::onOptionsChanged);
  connect(options_, &OptionsBar::exportRequested, this, &AnalysisPanel::askExport);
}

void AnalysisPanel::addFoot(QBoxLayout* column) {
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  words_->setAccessibleName(tr("state of the analysis"));
  progress_ = new QProgressBar;
  progress_->setFixedWidth(150);
  cancel_ = new QPushButton(tr("Cancel"));
  cancel_->setObjectName("cancel_analysis");
  cancel_->setToolTip(tr("Stop the computation (Esc)"));
  cancel_->setStyleSheet("padding: 3px 8px;");
  refresh_ = new QToolButton;
  refresh_->setObjectName("refresh_analysis");
  refresh_->setText(tr("↻ Refresh"));
  refresh_->setToolTip(tr("Read the runs again: the session so far, changed files (F5)"));
  row->addWidget(words_, 1);
  row->addWidget(progress_);
  row->addWidget(cancel_);
  export_all_ = new QToolButton;
  export_all_->setObjectName("export_all");
  export_all_->setText(tr("Export all…"));
  export_all_->setToolTip(
      tr("Every figure and table of the runs into a folder with an index page (Ctrl+Shift+E)"));
  row->addWidget(export_all_);
  row->addWidget(refresh_);
  column->addLayout(row);
  connect(cancel_, &QPushButton::clicked, this, &AnalysisPanel::cancel);
  connect(refresh_, &QToolButton::clicked, this, &AnalysisPanel::refresh);
  connect(export_all_, &QToolButton::clicked, this, &AnalysisPanel::askExportAll);
  connect(new QShortcut(QKeySequence(Qt::Key_F5), this), &QShortcut::activated, this,
          &AnalysisPanel::refresh);
  connect(new QShortcut(QKeySequence(Qt::CTRL + Qt::SHIFT + Qt::Key_E), this), &QShortcut::activated,
          export_all_, &QToolButton::click);
  auto* escape = new QShortcut(QKeySequence(Qt::Key_Escape), this);
  escape->setContext(Qt::WidgetWithChildrenShortcut);
  connect(escape, &QShortcut::activated, this, &AnalysisPanel::cancel);
}

void AnalysisPanel::setTheme(const Theme& theme) {
  for (Side& side : sides_) side.picker->setTheme(theme);
  options_->setTheme(theme);
  figures_->setTheme(theme);
  table_->setTheme(theme);
  QPalette palette = words_->palette();
  palette.setColor(QPalette::WindowText, theme.text);
  words_->setPalette(palette);
}

void AnalysisPanel::setSession(std::function<ErrorRun()> session) { session_ = std::move(session); }

void AnalysisPanel::sessionOpened() {
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (sides_[i].picker->choice().kind == Kind::kSession) onRunChanged(i);
}

void AnalysisPanel::setJointNames(const std::array<QString, 3>& names) { joint_names_ = names; }

void AnalysisPanel::save(QSettings& settings) const {
  for (std::size_t i = 0; i < sides_.size(); ++i)
    sides_[i].picker->choice().save(settings, "analysis/" + kLetters[i]);
  options_->save(settings);
}

void AnalysisPanel::restore(const QSettings& settings) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    sides_[i].picker->setChoice(
        RunChoice::restore(settings, "analysis/" + kLetters[i], i == 0 ? Kind::kSession : Kind::kNone));
    sides_[i].stale = true;
  }
  options_->restore(settings);
  refresh();
}

void AnalysisPanel::choose(std::size_t run, const RunChoice& choice) {
  sides_[run].picker->setChoice(choice);
  onRunChanged(run);
}

void AnalysisPanel::onRunChanged(std::size_t run) {
  sides_[run].stale = true;
  onOptionsChanged();
}

/// Cancels work for an older choice; the reading of a run for the present choice continues.
void AnalysisPanel::onOptionsChanged() {
  analysis_stale_ = intervals_stale_ = true;
  halted_ = false;
  fault_.clear();
  said_.clear();
  const bool loading = work_ == Work::kLoadingA || work_ == Work::kLoadingB;
  if (!loading || sides_[work_ == Work::kLoadingA ? 0 : 1].stale) job_.cancel();
  proceed();
}

void AnalysisPanel::refresh() {
  for (Side& side : sides_) side.stale = true;
  onOptionsChanged();
}

void AnalysisPanel::cancel() {
  if (full_export_.busy()) return full_export_.cancel();
  if (!job_.busy()) return;
  halted_ = true;
  if (work_ == Work::kLoadingA || work_ == Work::kLoadingB)
    sides_[work_ == Work::kLoadingA ? 0 : 1].stale = true;
  job_.cancel();
  say();
}

void AnalysisPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  proceed();
}

void AnalysisPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  if (!user_split_) {
    const int figures = kFigureShare * split_->height() / 100;
    split_->setSizes({figures, split_->height() - figures});
  }
}

bool AnalysisPanel::settled() const {
  return !busy() && !sides_[0].stale && !sides_[1].stale && !analysis_stale_ && !intervals_stale_;
}

/// Starts the next piece of work, if there is one and nothing is running.
void AnalysisPanel::proceed() {
  if (isVisible() && !halted_ && !busy()) {
    bool started = false;
    for (std::size_t i = 0; i < sides_.size() && !started; ++i)
      if (sides_[i].stale) started = load(i);
    const bool complete = sides_[0].run && (sides_[1].run || sides_[1].picker->choice().kind == Kind::kNone);
    if (!started && analysis_stale_) {
      analysis_stale_ = false;
      if (complete) {
        prepare();
      } else {
        intervals_stale_ = false;
        analysis_ = {};
        figures_->clear();
        table_->showAnalysis(analysis_);
      }
    } else if (!started && intervals_stale_) {
      intervals_stale_ = false;
      addIntervals();
    }
  }
  say();
}

/// Returns true if the run is being read in the background.
bool AnalysisPanel::load(std::size_t run) {
  Side& side = sides_[run];
  const RunChoice choice = side.picker->choice();
  side.stale = false;
  side.run.reset();
  side.fault.clear();
  if (choice.kind == Kind::kNone) return false;
  if (choice.kind == Kind::kSession) {
    try {
      if (!session_)
        throw base::InputError({"this session", 0, {}, {}, "is not open", "Open a source first"});
      took(run, session_());
    } catch (const base::InputError& error) {
      side.fault = text(error.what());
    }
    return false;
  }
  work_ = run == 0 ? Work::kLoadingA : Work::kLoadingB;
  progress_->setValue(0);
  progress_->setFormat(tr("opening"));
  job_.start([choice](base::Progress& progress) { return readRun(choice, progress); },
             [this, run](ErrorRun loaded) { took(run, std::move(loaded)); });
  return true;
}

void AnalysisPanel::took(std::size_t run, ErrorRun loaded) {
  Side& side = sides_[run];
  if (side.stale) return;  // something else was chosen meanwhile
  if (!loaded.trials.empty()) {
    QStringList trials;
    for (const std::string& name : loaded.trials) trials << text(name);
    const QString asked = side.picker->choice().trial;
    side.picker->setTrials(trials, asked.isEmpty() ? trials.front() : asked);
  }
  side.run = std::make_shared<const ErrorRun>(std::move(loaded));
}

void AnalysisPanel::prepare() {
  const auto a = sides_[0].run, b = sides_[1].run;
  work_ = Work::kAnalysing;
  progress_->setFormat(tr("counting"));
  job_.start(
      [a, b, options = options_->options(), names = joint_names_](base::Progress&) {
        Prepared prepared{analysis::analyse(*a, b.get(), options), {}};
        prepared.figures = analysisFigures(prepared.analysis, *a, b.get(), names);
        return prepared;
      },
      [this](Prepared prepared) {
        analysis_ = std::move(prepared.analysis);
        figures_->show(std::move(prepared.figures));
        table_->showAnalysis(analysis_);
      });
}

void AnalysisPanel::addIntervals() {
  if (analysis_.against == analysis::Against::kNothing || analysis_.rows.empty()) return;
  const auto a = sides_[0].run, b = sides_[1].run;
  work_ = Work::kIntervals;
  progress_->setValue(0);
  progress_->setFormat(tr("intervals"));
  job_.start(
      [a, b, analysis = analysis_](base::Progress& progress) mutable {
        analysis::addIntervals(analysis, *a, b.get(), progress);
        return std::move(analysis);
      },
      [this](Analysis analysis) {
        analysis_ = std::move(analysis);
        table_->showAnalysis(analysis_);
      });
}

void AnalysisPanel::onFailed(const QString& why) {
  if (work_ == Work::kLoadingA || work_ == Work::kLoadingB) {
    sides_[work_ == Work::kLoadingA ? 0 : 1].fault = why;
    return;
  }
  fault_ = why;
  intervals_stale_ = false;
  if (work_ != Work::kAnalysing) return;
  analysis_ = {};
  figures_->clear();
  table_->showAnalysis(analysis_);
}

QString AnalysisPanel::words() const { return words_->text(); }

void AnalysisPanel::say() {
  QStringList lines;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (!sides_[i].fault.isEmpty()) lines << kLetters[i] + QStringLiteral(": ") + sides_[i].fault;
    if (!sides_[i].run) continue;
    for (const std::string& notice : sides_[i].run->notices)
      lines << kLetters[i] + QStringLiteral(": ") + text(notice);
  }
  if (!fault_.isEmpty()) lines << fault_;
  if (halted_) lines << tr("Cancelled. Refresh (F5) continues.");
  if (!said_.isEmpty()) lines << said_;
  words_->setText(lines.join('\n'));
  const bool working = busy();
  progress_->setVisible(working);
  cancel_->setVisible(working);
  refresh_->setVisible(!working);
  options_->setExportEnabled(figures_->histogram() != nullptr && !working);
  export_all_->setVisible(!working);
  export_all_->setEnabled(!working && (sides_[0].run || sides_[1].run));
}

}  // namespace capstan::widgets
