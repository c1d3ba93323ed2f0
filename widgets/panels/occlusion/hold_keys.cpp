#include "widgets/panels/occlusion/hold_keys.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTextEdit>

namespace capstan::widgets {

HoldKeys::HoldKeys(QWidget* owner) : QObject(owner), owner_(owner) { qApp->installEventFilter(this); }

bool HoldKeys::typing() const {
  const QWidget* focus = QApplication::focusWidget();
  return qobject_cast<const QLineEdit*>(focus) || qobject_cast<const QAbstractSpinBox*>(focus) ||
         qobject_cast<const QTextEdit*>(focus) || qobject_cast<const QPlainTextEdit*>(focus) ||
         qobject_cast<const QComboBox*>(focus);
}

bool HoldKeys::eventFilter(QObject* watched, QEvent* event) {
  const bool press = event->type() == QEvent::KeyPress;
  if (!press && event->type() != QEvent::KeyRelease) return false;
  const auto* widget = qobject_cast<QWidget*>(watched);
  if (!widget || widget->window() != owner_->window()) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  const auto action = actions_.find(key->key());
  if (action == actions_.end() || key->isAutoRepeat()) return false;
  bool& down = down_[key->key()];
  if (down == press) return false;
  if (press && (typing() || (key->modifiers() & ~Qt::KeypadModifier) || !owner_->isEnabled())) return false;
  down = press;
  action->second(press);
  return true;
}

}  // namespace capstan::widgets
