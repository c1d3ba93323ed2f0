#include "widgets/figures/drawing_turn.h"

#include <QElapsedTimer>

namespace capstan::widgets {
namespace {

struct LongDrawing {
  const QObject* view = nullptr;  ///< compared only, never used
  QElapsedTimer since;
};

LongDrawing& last() {
  static LongDrawing drawing;
  return drawing;
}

}  // namespace

void DrawingTurn::drew(const QObject* view, double duration) {
  if (duration < kLongDrawing) return;
  last().view = view;
  last().since.start();
}

bool DrawingTurn::isFreeFor(const QObject* view) {
  return last().view == nullptr || last().view == view || last().since.hasExpired(kApart);
}

}  // namespace capstan::widgets
