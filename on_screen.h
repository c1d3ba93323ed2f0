#pragma once

#include <QGuiApplication>
#include <QScreen>
#include <QWidget>

namespace capstan::widgets {

/// Makes `window` no larger than its screen leaves room for, and moves it into that.
inline void keepOnScreen(QWidget& window) {
  const QScreen* screen = window.screen() ? window.screen() : QGuiApplication::primaryScreen();
  if (!screen) return;
  const QRect room = screen->availableGeometry();
  const QSize frame = window.frameGeometry().size() - window.size();
  window.resize(window.size().boundedTo(room.size() - frame));
  const QRect now = window.frameGeometry();
  window.move(qBound(room.left(), now.left(), qMax(room.left(), room.right() + 1 - now.width())),
              qBound(room.top(), now.top(), qMax(room.top(), room.bottom() + 1 - now.height())));
}

}  // namespace capstan::widgets
