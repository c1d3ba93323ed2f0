#pragma once

#include <QApplication>
#include <QColor>
#include <QDir>
#include <QImage>
#include <QWidget>
#include <cstdlib>

/// Pictures of widgets, and questions about them.
namespace capstan::test {

/// Left under `name` in the folder CAPSTAN_PICTURES, where that is set: to be looked at.
inline void leave(const QImage& image, const QString& name) {
  const QString folder = qEnvironmentVariable("CAPSTAN_PICTURES");
  if (folder.isEmpty()) return;
  QDir().mkpath(folder);
  image.save(folder + "/" + name + ".png");
}

inline QImage grab(QWidget& widget, const QString& name) {
  QApplication::processEvents();
  const QImage image = widget.grab().toImage().convertToFormat(QImage::Format_RGB32);
  leave(image, name);
  return image;
}

/// Largest difference of a channel.
inline int distance(QRgb a, QRgb b) {
  return std::max(
      {std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)), std::abs(qBlue(a) - qBlue(b))});
}

/// Pixels of `image` inside `area` within `tolerance` of `colour`: how many, and their centre.
struct Count {
  int pixels = 0;
  QPointF centre;
  QRect box;
};

inline Count count(const QImage& image, const QRect& area, const QColor& colour, int tolerance) {
  Count found;
  double x_sum = 0.0, y_sum = 0.0;
  const QRect inside = area.intersected(image.rect());
  for (int y = inside.top(); y <= inside.bottom(); ++y)
    for (int x = inside.left(); x <= inside.right(); ++x) {
      if (distance(image.pixel(x, y), colour.rgb()) > tolerance) continue;
      ++found.pixels;
      x_sum += x + 0.5;
      y_sum += y + 0.5;
      found.box |= QRect(x, y, 1, 1);
    }
  if (found.pixels > 0) found.centre = {x_sum / found.pixels, y_sum / found.pixels};
  return found;
}

}  // namespace capstan::test
