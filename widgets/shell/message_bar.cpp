#include "widgets/shell/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace capstan::widgets {

MessageBar::MessageBar(QWidget* parent) : QFrame(parent) {
  auto* row = new QHBoxLayout(this);
  text_ = new QLabel;
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setText(tr("Close"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  row->addWidget(text_, 1);
  row->addWidget(close);
  setTheme(Theme::dark());
  hide();
}

void MessageBar::setTheme(const Theme& theme) {
  setStyleSheet(QStringLiteral("capstan--widgets--MessageBar { border-left: 6px solid %1; background: %2; }")
                    .arg(theme.fault.name(), theme.raised.name()));
}

void MessageBar::showMessage(const QString& text, const QString& about) {
  about_ = about;
  text_->setText(tr("Fault: %1").arg(text));
  show();
}

void MessageBar::settle(const QString& about) {
  if (about == about_) hide();
}

QString MessageBar::message() const { return isHidden() ? QString() : text_->text(); }

}  // namespace capstan::widgets
