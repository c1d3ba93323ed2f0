#include <QBoxLayout>
#include <QGridLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QShortcut>
#include <QStackedWidget>

#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/identification/motion_offer.h"
#include "widgets/panels/identification/parameter_choice.h"
#include "widgets/panels/identification/parameter_table.h"
#include "widgets/panels/identification/trace_plot.h"

namespace capstan::widgets {

namespace {

constexpr int kLeastTrace = 96;  ///< [px]
constexpr int kAdviceLines = 2;
constexpr int kLeastBody = 60;  ///< least height of what scrolls above the buttons [px]

}  // namespace

/// Everything above the buttons. It scrolls where it has no room, so that the buttons stay whole.
QWidget* IdentificationPanel::makeBody() {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setFont(textFont(9.5));
  words_->setAccessibleName(tr("state of the identification"));
  words_->setMinimumHeight(kAdviceLines * QFontMetrics(words_->font()).lineSpacing());
  column->addWidget(words_);
  addPages(column);
  advice_ = new QLabel;
  advice_->setWordWrap(true);
  advice_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  advice_->setFont(textFont(9.5));
  advice_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  advice_->setMinimumHeight(kAdviceLines * QFontMetrics(advice_->font()).lineSpacing());
  auto* row = new QHBoxLayout;  // the proposed motion takes the place of the advice
  row->setSpacing(6);
  row->addWidget(advice_, 1);
  row->addWidget(offer_ = new MotionOffer, 1);
  column->addLayout(row);
  auto* body = new QScrollArea;
  body->setFrameShape(QFrame::NoFrame);
  body->setWidgetResizable(true);
  body->setFocusPolicy(Qt::NoFocus);
  body->setMinimumHeight(kLeastBody);
  body->setWidget(content);
  for (QWidget* ground : {body->viewport(), content}) ground->setAutoFillBackground(false);
  return body;
}

void IdentificationPanel::addPages(QVBoxLayout* column) {
  pages_ = new QStackedWidget;
  choice_ = new ParameterChoice;
  results_ = new QWidget;
  auto* results = new QVBoxLayout(results_);
  results->setContentsMargins(0, 0, 0, 0);
  results->setSpacing(6);
  table_ = new ParameterTable;
  trace_ = new TracePlot;
  trace_->setMinimumHeight(kLeastTrace);
  results->addWidget(table_);
  results->addWidget(trace_, 1);
  changes_ = new QPlainTextEdit;
  changes_->setReadOnly(true);
  changes_->setFrameShape(QFrame::NoFrame);
  changes_->setFont(numberFont(8.5));
  changes_->setMinimumHeight(60);
  changes_->setAccessibleName(tr("differences of the robot in use from the robot file"));
  auto* rolled = new QScrollArea;  // a low window does not show every check box
  rolled->setFrameShape(QFrame::NoFrame);
  rolled->setWidgetResizable(true);
  rolled->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  rolled->setMinimumHeight(60);
  rolled->setWidget(choice_);
  for (QWidget* ground : {rolled->viewport(), static_cast<QWidget*>(choice_)})
    ground->setAutoFillBackground(false);  // the panel's own shows
  for (QWidget* page : {static_cast<QWidget*>(rolled), results_, static_cast<QWidget*>(changes_)})
    pages_->addWidget(page);
  pages_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
  column->addWidget(pages_, 1);
}

QPushButton* IdentificationPanel::button(const QString& name, const QString& tip,
                                         void (IdentificationPanel::*pressed)()) {
  auto* made = new QPushButton;
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setFocusPolicy(Qt::TabFocus);
  made->setStyleSheet("padding: 4px 6px;");
  connect(made, &QPushButton::clicked, this, pressed);
  return made;
}

void IdentificationPanel::addButtons(QVBoxLayout* column) {
  auto* grid = new QGridLayout;  // a row of four is wider than a narrow dock
  grid->setSpacing(4);
  start_ =
      button("start", tr("Collect from the running session, or stop (I)"), &IdentificationPanel::startOrStop);
  refine_ = button("refine", tr("Stop, and refine on all collected data by the batch method (Shift+I)"),
                   &IdentificationPanel::refine);
  discard_ = button("discard", tr("Delete the estimates; the robot in use stays (Ctrl+Backspace)"),
                    &IdentificationPanel::discard);
  accept_ = button("accept", tr("The filter uses these values from now on; errors restart (Ctrl+Return)"),
                   &IdentificationPanel::accept);
  save_ = button("save", tr("Save the robot in use as a robot file (Ctrl+S)"), &IdentificationPanel::askFile);
  revert_ = button("revert", tr("Back to the values of the robot file; errors restart"),
                   &IdentificationPanel::revert);
  discard_->setText(tr("Discard"));
  accept_->setText(tr("Accept"));
  save_->setText(tr("Save…"));
  revert_->setText(tr("Undo"));
  grid->addWidget(start_, 0, 0);
  for (auto* one : {refine_, revert_}) grid->addWidget(one, 0, 1);  // one of them is shown
  grid->addWidget(discard_, 1, 0);
  for (auto* one : {accept_, save_}) grid->addWidget(one, 1, 1);
  column->addLayout(grid);
}

/// A key acts as its button: only while the button is shown and enabled.
void IdentificationPanel::addKeys() {
  const auto key = [this](const char* sequence, QPushButton* pressed) {
    auto* shortcut = new QShortcut(QKeySequence(sequence), this);
    shortcut->setAutoRepeat(false);
    connect(shortcut, &QShortcut::activated, pressed, [pressed] {
      if (pressed->isVisible()) pressed->click();
    });
  };
  key("I", start_);
  key("Shift+I", refine_);
  key("Ctrl+Backspace", discard_);
  key("Ctrl+Return", accept_);
  key("Ctrl+S", save_);
  key("Shift+M", &offer_->button());
}

}  // namespace capstan::widgets
