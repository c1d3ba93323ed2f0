#pragma once

#include <QObject>

namespace capstan::widgets {

/// Keeps long drawings of several views apart, so that an image of the cameras is painted between two of
/// them. For the thread of the window only.
class DrawingTurn {
 public:
  /// `view` has just drawn, for this long [ms].
  static void drew(const QObject* view, double duration);
  /// False if a long drawing of another view ended less than kApart ago: what can wait should wait.
  static bool isFreeFor(const QObject* view);
};
inline constexpr double kLongDrawing = 8.0;  ///< duration from which a drawing delays others [ms]
inline constexpr int kApart = 40;            ///< more than the 33 ms between two images of the cameras [ms]

}  // namespace capstan::widgets
