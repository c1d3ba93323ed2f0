#include <gtest/gtest.h>

#include <QObject>
#include <QtTest/QTest>

#include "widgets/figures/drawing_turn.h"

namespace capstan::widgets {
namespace {

TEST(DrawingTurn, ALongDrawingDelaysOtherViewsForAWhile) {
  const QObject figure, scene;
  DrawingTurn::drew(&figure, 0.5 * kLongDrawing);
  EXPECT_TRUE(DrawingTurn::isFreeFor(&scene)) << "a short one delays nothing";
  DrawingTurn::drew(&figure, 2.0 * kLongDrawing);
  EXPECT_FALSE(DrawingTurn::isFreeFor(&scene));
  EXPECT_TRUE(DrawingTurn::isFreeFor(&figure)) << "not itself";
  DrawingTurn::drew(&scene, 0.5 * kLongDrawing);
  EXPECT_FALSE(DrawingTurn::isFreeFor(&scene)) << "a short drawing does not end the delay";
  QTest::qWait(2 * kApart);
  EXPECT_TRUE(DrawingTurn::isFreeFor(&scene));
}

}  // namespace
}  // namespace capstan::widgets
