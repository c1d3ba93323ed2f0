// Notes and events of a session.
#include "widgets/panels/notes/notes_panel.h"

#include <gtest/gtest.h>

#include <QLineEdit>
#include <QSignalSpy>
#include <QTreeWidget>
#include <QtTest/QTest>

#include "tests/widgets/picture.h"

namespace capstan::widgets {
namespace {

TEST(NotesPanel, TakesANoteAndGivesTheKeyboardBack) {
  NotesPanel panel;
  panel.show();
  QApplication::setActiveWindow(&panel);
  QSignalSpy written(&panel, &NotesPanel::noteWritten);
  panel.beginNote();
  ASSERT_TRUE(panel.line().hasFocus());
  QTest::keyClicks(&panel.line(), "  cable replaced ");
  QTest::keyClick(&panel.line(), Qt::Key_Return);
  ASSERT_EQ(written.count(), 1);
  EXPECT_EQ(written[0][0].toString(), "cable replaced");
  EXPECT_FALSE(panel.line().hasFocus());
  EXPECT_TRUE(panel.line().text().isEmpty());
}

TEST(NotesPanel, EscapeAndEmptyWriteNothing) {
  NotesPanel panel;
  panel.show();
  QApplication::setActiveWindow(&panel);
  QSignalSpy written(&panel, &NotesPanel::noteWritten);
  panel.beginNote();
  QTest::keyClicks(&panel.line(), "half a thou");
  QTest::keyClick(&panel.line(), Qt::Key_Escape);
  EXPECT_TRUE(panel.line().text().isEmpty());
  panel.beginNote();
  QTest::keyClicks(&panel.line(), "   ");
  QTest::keyClick(&panel.line(), Qt::Key_Return);
  EXPECT_EQ(written.count(), 0);
}

TEST(NotesPanel, ListsEventsAndShowsTheirTime) {
  NotesPanel panel;
  panel.resize(300, 240);
  panel.addEvent(1.24, "occlusion", "left camera blocked");
  panel.addEvent(12.0, "note", "cable <b>2</b> replaced");
  EXPECT_EQ(panel.row(0), "1.2 s occlusion: left camera blocked");
  EXPECT_EQ(panel.row(1), "12.0 s cable <b>2</b> replaced");
  QSignalSpy chosen(&panel, &NotesPanel::timeChosen);
  auto* list = panel.findChild<QTreeWidget*>();
  Q_EMIT list->itemActivated(list->topLevelItem(0), 0);
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen[0][0].toDouble(), 1.24);
  test::grab(panel, "notes_panel");
}

TEST(NotesPanel, NamesAFileWhateverTheWidth) {
  NotesPanel panel;
  panel.addFile(3.0, "recording", "/data/arm/2026-11-21_093000_simulated_raven_left.capstan");
  auto* list = panel.findChild<QTreeWidget*>();
  panel.resize(700, 200);
  panel.show();
  QApplication::processEvents();
  EXPECT_EQ(panel.row(0), "3.0 s recording: 2026-11-21_093000_simulated_raven_left.capstan");
  panel.resize(220, 200);
  QApplication::processEvents();
  const QString text = panel.row(0);
  EXPECT_TRUE(text.startsWith("3.0 s recording: 2026") && text.endsWith("capstan")) << text.toStdString();
  EXPECT_TRUE(text.contains(QChar(0x2026))) << text.toStdString() << " in " << list->columnWidth(1);
  EXPECT_EQ(list->topLevelItem(0)->toolTip(1), "/data/arm/2026-11-21_093000_simulated_raven_left.capstan");
  test::grab(panel, "notes_panel_file");
}

TEST(NotesPanel, ALongNoteIsReadableWholeAtEveryWidth) {
  NotesPanel panel;
  const QString words =
      "registration: The cameras were registered with the robot's former constants; with the new ones the "
      "same "
      "poses fit to 0.31 mm instead of 1.24 mm, so the registration was fitted again to the same poses.";
  const QString path = "/home/laboratory/recordings/2026-11-21/raven_left_debridement_after_the_cable_change";
  panel.addEvent(3.0, "note", words);
  panel.addEvent(4.0, "fault", path + ": cannot be written");
  panel.addEvent(5.0, "note", "short");
  auto* list = panel.findChild<QTreeWidget*>();
  panel.show();
  for (const int width : {900, 260, 420}) {
    panel.resize(width, 500);
    QTest::qWait(50);
    const int room = list->columnWidth(1), line = list->visualItemRect(list->topLevelItem(2)).height();
    for (const int row : {0, 1}) {
      const auto* item = list->topLevelItem(row);
      const QFontMetrics metrics(item->font(1));
      const int lines = metrics.horizontalAdvance(item->text(1)) / room + 1;
      EXPECT_GE(list->visualItemRect(item).height(), lines * line) << width << " px, " << row;
    }
    test::grab(panel, QString("notes_panel_long_%1").arg(width));
  }
  EXPECT_TRUE(list->topLevelItem(0)->toolTip(1).startsWith("<qt>")) << "only rich text is wrapped";
}

TEST(NotesPanel, ForgetsTheOldestWhenFull) {
  NotesPanel panel;
  for (int i = 0; i < NotesPanel::kMostRows + 10; ++i) panel.addEvent(i, "note", QString::number(i));
  EXPECT_EQ(panel.rows(), NotesPanel::kMostRows);
  EXPECT_EQ(panel.row(0), "10.0 s 10");
}

}  // namespace
}  // namespace capstan::widgets
