#include "widgets/panels/work/work_panel.h"

#include <QBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QShortcut>

namespace capstan::widgets {

WorkPanel::WorkPanel(QWidget* parent)
    : QWidget(parent),
      column_(new QVBoxLayout(this)),
      headline_(new QLabel),
      summary_(new QLabel),
      words_(new QLabel),
      rest_(new QWidget),
      progress_(new QProgressBar) {
  column_->setContentsMargins(10, 6, 10, 6);
  column_->setSpacing(5);
  headline_->setObjectName("headline");
  headline_->setFont(textFont(14.0, true));
  for (QLabel* label : {headline_, summary_, words_}) {
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  addKey("F5", [this] {
    if (!busy()) begin_->click();
  });
  auto* escape = new QShortcut(QKeySequence(Qt::Key_Escape), this);
  escape->setContext(Qt::WidgetWithChildrenShortcut);
  connect(escape, &QShortcut::activated, this, [this] { cancel(); });
}

QPushButton* WorkPanel::button(const QString& name, const QString& words, const QString& tip,
                               std::function<void()> pressed) {
  auto* made = new QPushButton(words);
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setStyleSheet("padding: 4px 8px;");
  connect(made, &QPushButton::clicked, this, std::move(pressed));
  return made;
}

void WorkPanel::addHead(QWidget* picker, QPushButton* begin, const QString& accessible_name) {
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  row->addWidget(picker, 1);
  row->addWidget(begin_ = begin);
  begin->setProperty("primary", true);
  column_->addLayout(row);
  headline_->setAccessibleName(accessible_name);
  column_->addWidget(headline_);
  column_->addWidget(summary_);
}

void WorkPanel::addBody(QWidget* body) {
  column_->addWidget(body_ = body, 1);
  column_->addWidget(rest_, 1);
}

void WorkPanel::addFoot(const std::vector<QPushButton*>& buttons, const QString& accessible_name) {
  words_->setAccessibleName(accessible_name);
  column_->addWidget(words_);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  row->addWidget(progress_, 1);
  row->addStretch();
  for (QPushButton* one : buttons) row->addWidget(one);
  column_->addLayout(row);
}

void WorkPanel::addKey(const QString& sequence, std::function<void()> act) {
  auto* shortcut = new QShortcut(QKeySequence(sequence), this);
  shortcut->setAutoRepeat(false);
  connect(shortcut, &QShortcut::activated, this, std::move(act));
}

void WorkPanel::addKey(const QString& sequence, QPushButton* pressed) {
  addKey(sequence, [pressed] {
    if (pressed->isVisible()) pressed->click();
  });
}

void WorkPanel::styleWords(const Theme& theme) {
  QPalette palette = words_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  words_->setPalette(palette);
}

void WorkPanel::showHead(const QString& headline, const QString& summary, bool body) {
  headline_->setText(headline);
  summary_->setText(summary);
  body_->setVisible(body);
  rest_->setVisible(!body);
}

void WorkPanel::showWords(const QString& words, const QString& tip) {
  words_->setText(words);
  words_->setToolTip(tip);
  words_->setVisible(!words.isEmpty());
}

void WorkPanel::showProgress(bool shown) { progress_->setVisible(shown); }

void WorkPanel::beginProgress(const QString& doing) {
  progress_->setValue(0);
  progress_->setFormat(doing);
}

void WorkPanel::onProgress(double fraction, const QString& doing) {
  if (doing.isEmpty()) return;  // nothing was said yet
  progress_->setValue(qRound(100.0 * fraction));
  progress_->setFormat(doing + QStringLiteral(" %p %"));
}

QString WorkPanel::headline() const { return headline_->text(); }
QString WorkPanel::summary() const { return summary_->text(); }
QString WorkPanel::words() const { return words_->text(); }

}  // namespace capstan::widgets
