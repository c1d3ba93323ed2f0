#include "widgets/shell/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <utility>

namespace capstan::widgets {

MessageBar::MessageBar(QWidget* parent) : QFrame(parent), row_(new QHBoxLayout(this)) {
  text_ = new QLabel;
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setText(tr("Close"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  row_->addWidget(text_, 1);
  row_->addWidget(close);
  setTheme(Theme::dark());
  hide();
}

void MessageBar::setTheme(const Theme& theme) {
  theme_ = theme;
  const QColor& edge = fault_ ? theme.fault : theme.accent;
  setStyleSheet(QStringLiteral("capstan--widgets--MessageBar { border-left: 6px solid %1; background: %2; }")
                    .arg(edge.name(), theme.raised.name()));
}

void MessageBar::put(const QString& text, const QString& about, bool fault) {
  for (QToolButton* button : std::exchange(buttons_, {})) {
    button->hide();
    button->deleteLater();  // it may be the one that was pressed
  }
  about_ = about;
  text_->setText(text);
  if (std::exchange(fault_, fault) != fault) setTheme(theme_);
  show();
}

void MessageBar::showMessage(const QString& text, const QString& about) {
  put(tr("Fault: %1").arg(text), about, true);
}

void MessageBar::showNews(const QString& text, const std::vector<MessageAction>& actions) {
  put(text, {}, false);
  for (const MessageAction& action : actions) {
    auto* button = new QToolButton;
    button->setText(action.text);
    row_->insertWidget(row_->count() - 1, button);
    button->show();
    connect(button, &QToolButton::clicked, this, &QWidget::hide);
    connect(button, &QToolButton::clicked, this, action.act);
    buttons_.push_back(button);
  }
}

void MessageBar::setText(const QString& text) { text_->setText(text); }

void MessageBar::settle(const QString& about) {
  if (about == about_) hide();
}

QString MessageBar::message() const { return isHidden() ? QString() : text_->text(); }

}  // namespace capstan::widgets
