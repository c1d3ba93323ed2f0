#include "widgets/panels/identification/identification_panel.h"

#include <QBoxLayout>
#include <QFileDialog>
#include <QLabel>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSaveFile>
#include <QStackedWidget>
#include <utility>

#include "core/base/error.h"
#include "widgets/panels/identification/change_text.h"
#include "widgets/panels/identification/motion_offer.h"
#include "widgets/panels/identification/parameter_choice.h"
#include "widgets/panels/identification/parameter_table.h"
#include "widgets/panels/identification/trace_plot.h"

namespace capstan::widgets {

using identification::LivePhase;

namespace {
constexpr int kPoll = 200;          ///< [ms]
constexpr int kRoomForTrace = 330;  ///< height of the panel below which the table needs it all [px]
constexpr int kLeastPage = 88, kLeastTable = 112;  ///< least heights of the pages [px]

QString text(const std::string& words) { return QString::fromStdString(words); }

}  // namespace

IdentificationPanel::IdentificationPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 6, 10, 8);
  column->setSpacing(6);
  column->addWidget(makeBody(), 1);
  progress_ = new QProgressBar;
  progress_->setMaximumHeight(14);
  progress_->setTextVisible(false);
  column->addWidget(progress_);
  addButtons(column);
  addKeys();
  connect(choice_, &ParameterChoice::changed, this, &IdentificationPanel::showButtons);
  connect(table_, &ParameterTable::chosenChanged, this, &IdentificationPanel::showChosen);
  connect(offer_, &MotionOffer::proposeRequested, this, [this] {
    offer_->setSearching(true);
    poll();
  });
  connect(offer_, &MotionOffer::driveRequested, this, [this](const auto& motion, const QString& words) {
    Q_EMIT motionRequested(motion, words);
    if (live_.phase() == LivePhase::kStopped) startOrStop();
  });
  connect(&polls_, &QTimer::timeout, this, &IdentificationPanel::poll);
  connect(&job_, &Job::ended, this, &IdentificationPanel::poll);
  connect(&job_, &Job::failed, this, [this](const QString& why) {
    live_.failed(why.toStdString(), 1e-3 * static_cast<double>(clock_.elapsed()));
    refresh();
  });
  connect(&job_, &Job::progressed, this,
          [this](double fraction) { progress_->setValue(qRound(100.0 * fraction)); });
  clock_.start();
  polls_.setInterval(kPoll);
  setTheme(theme_);
  refresh();
}

IdentificationPanel::~IdentificationPanel() = default;

void IdentificationPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  choice_->setTheme(theme);
  table_->setTheme(theme);
  trace_->setTheme(theme);
  QPalette palette = advice_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  advice_->setPalette(palette);
}

void IdentificationPanel::begin(const tracking::SourceInfo& source) {
  job_.cancel();
  title_ = source.title;
  offer_->setDrivable(source.live && !source.real_time);
  offer_->setWeak(false);
  live_.begin(source.robot, title_);
  in_use_ = source.robot;
  said_.clear();
  sink_.reset();  // the new runner listens to nobody
  open_ = true;
  ended_ = false;
  polls_.stop();
  refresh();
}

void IdentificationPanel::useRobot(const robot::Description& robot, const QString& origin) {
  live_.keep(robot, origin.toStdString());
  in_use_ = robot;
  said_.clear();
  overtake();
}

void IdentificationPanel::showStatus(const live::RunStatus& status) {
  const bool ended = status.state == live::RunState::kEnded || status.state == live::RunState::kFailed;
  if (ended == ended_) return;
  ended_ = ended;
  if (ended && live_.phase() == LivePhase::kCollecting) {
    live_.stop();
    overtake();
  }
  refresh();
}

void IdentificationPanel::startOrStop() {
  said_.clear();
  try {
    if (live_.phase() == LivePhase::kCollecting)
      live_.stop();
    else if (live_.phase() == LivePhase::kStopped)
      live_.resume();
    else
      live_.start(in_use_, choice_->names());
  } catch (const base::InputError& error) {
    said_ = text(error.what());
  }
  overtake();
}

void IdentificationPanel::refine() {
  said_.clear();
  if (live_.refining())
    live_.cancelRefinement();
  else
    live_.refine();
  progress_->setValue(0);
  overtake();
}

void IdentificationPanel::discard() {
  said_.clear();
  live_.discard();
  overtake();
}

void IdentificationPanel::accept() {
  if (!live_.acceptable()) return;
  const QString summary = text(live_.summary());
  in_use_ = live_.accept();
  overtake();
  said_ = tr("In use from now on; errors restart. Differences from the robot file:");
  Q_EMIT robotChosen(in_use_, tr("identified values in use, errors restarted: %1").arg(summary));
  refresh();
}

void IdentificationPanel::revert() {
  in_use_ = live_.revert();
  overtake();
  said_ = tr("The robot file's values are in use again; errors restart.");
  Q_EMIT robotChosen(in_use_, tr("the robot file's values in use again, errors restarted"));
  refresh();
}

void IdentificationPanel::askFile() {
  auto* dialog = new QFileDialog(this, tr("Save the robot in use"), "identified.yaml",
                                 tr("Robot files (*.yaml);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix("yaml");
  connect(dialog, &QFileDialog::fileSelected, this, &IdentificationPanel::saveRobot);
  dialog->open();
}

void IdentificationPanel::saveRobot(const QString& path) {
  QSaveFile file(path);
  const QByteArray content = QByteArray::fromStdString(live_.robotFile());
  const bool saved = !content.isEmpty() && file.open(QIODevice::WriteOnly) &&
                     file.write(content) == content.size() && file.commit();
  said_ = saved ? tr("Saved as %1.").arg(path)
                : tr("%1 cannot be written (%2). Choose a folder that exists and has room.")
                      .arg(path, file.errorString());
  if (saved) Q_EMIT robotSaved(path);
  refresh();
}

/// The user has decided: cancels running work, and stops sending samples to an old recording.
void IdentificationPanel::overtake() {
  job_.cancel();
  offer_->setSearching(false);
  if (live_.sink() != sink_) {
    sink_ = live_.sink();
    Q_EMIT listenerRequested(sink_);
  }
  const bool under_way = live_.phase() == LivePhase::kCollecting || live_.phase() == LivePhase::kStopped;
  under_way ? polls_.start() : polls_.stop();
  poll();
}

/// Starts the next run when it is due.
void IdentificationPanel::poll() {
  const auto now = [this] { return 1e-3 * static_cast<double>(clock_.elapsed()); };
  if (job_.busy()) return refresh();
  if (offer_->searching())
    propose();
  else if (const auto request = live_.next(now()))
    job_.start(
        [request = *request](base::Progress& progress) { return identification::runLive(request, progress); },
        [this, now](identification::LiveReport report) { live_.take(std::move(report), now()); });
  refresh();
}

QString IdentificationPanel::stateWords() const {
  if (!said_.isEmpty()) return said_;
  if (live_.phase() != LivePhase::kIdle) return text(live_.words());
  if (!open_) return tr("No session: open one first.");
  if (ended_) return tr("The session has ended: begin it again (Space), then Start.");
  return tr("Finds wrong constants of the robot from its motion.");
}

void IdentificationPanel::refresh() {
  const LivePhase phase = live_.phase();
  const bool accepted = phase == LivePhase::kAccepted;
  const bool results = phase == LivePhase::kCollecting || phase == LivePhase::kStopped;
  words_->setText(stateWords());
  pages_->setCurrentIndex(results ? 1 : accepted ? 2 : 0);
  pages_->setMinimumHeight(results ? kLeastTable : kLeastPage);
  if (accepted) {
    QString changed = changesText(live_.changes(), live_.shown().estimates);
    if (live_.error()) changed = errorsText(*live_.error(), in_use_) + "\n\n" + changed;
    if (changed != changes_->toPlainText()) changes_->setPlainText(changed);
  }
  if (auto rows = live_.rows(); rows != rows_) {
    rows_ = std::move(rows);
    table_->showRows(rows_);
  }
  advice_->setVisible(results && offer_->words().isEmpty());
  offer_->setWeak(live_.motionRequest().has_value() && !live_.refining());
  progress_->setVisible(live_.refining());
  showChosen();
  showButtons();
}

/// Runs beside no other run: a recording is read by one at a time.
void IdentificationPanel::propose() {
  const auto request = live_.motionRequest();
  if (!request) return offer_->setSearching(false);
  job_.start(
      [request = *request, estimates = live_.shown().estimates](base::Progress& progress) {
        return identification::proposeMotion(request.recording->data(), request.set, estimates,
                                             request.camera, progress);
      },
      [this](std::optional<identification::MotionProposal> found) {
        offer_->setProposal(std::move(found));
        refresh();
      });
}

void IdentificationPanel::showChosen() {
  const int row = table_->chosen();
  const bool any = row >= 0 && row < static_cast<int>(rows_.size()) && live_.set();
  const QString words = any ? text(rows_[static_cast<std::size_t>(row)].name + ": " +
                                   rows_[static_cast<std::size_t>(row)].words)
                            : QString();
  if (words != advice_->text()) advice_->setText(words);
  const std::pair wanted{any ? live_.shown().serial : 0, any ? row : -1};
  if (std::exchange(drawn_, wanted) == wanted) return;
  if (any)
    trace_->showTrace(live_.trace(), *live_.set(), row);
  else
    trace_->clear();
}

void IdentificationPanel::showButtons() {
  const LivePhase phase = live_.phase();
  const bool idle = phase == LivePhase::kIdle, accepted = phase == LivePhase::kAccepted;
  start_->setText(phase == LivePhase::kCollecting ? tr("Stop")
                  : phase == LivePhase::kStopped  ? tr("Go on")
                  : accepted                      ? tr("Again")
                                                  : tr("Start"));
  start_->setEnabled(open_ && !(ended_ && phase != LivePhase::kCollecting) && !choice_->names().empty() &&
                     !live_.refining());
  refine_->setText(live_.refining() ? tr("Cancel") : tr("Refine"));
  refine_->setEnabled(!live_.shown().estimates.empty());
  accept_->setEnabled(live_.acceptable() && !live_.refining());
  accept_->setToolTip(acceptTip(live_.shown().estimates));
  for (auto* one : {refine_, discard_, accept_}) one->setVisible(!idle && !accepted);
  for (auto* one : {revert_, save_}) one->setVisible(accepted);
}

void IdentificationPanel::resizeEvent(QResizeEvent*) { trace_->setVisible(height() >= kRoomForTrace); }

QString IdentificationPanel::words() const { return words_->text(); }
QString IdentificationPanel::advice() const { return advice_->text(); }
QString IdentificationPanel::changes() const { return changes_->toPlainText(); }

}  // namespace capstan::widgets
