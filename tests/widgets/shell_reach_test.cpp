// Everything within reach of the keyboard in a window of 960×540 logical pixels: docks, their controls, the
// toolbar's actions.
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QButtonGroup>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QKeySequence>
#include <QLineEdit>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QScrollArea>
#include <QScrollBar>
#include <QSet>
#include <QTabBar>
#include <QToolButton>

#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"

namespace capstan::widgets {
namespace {

const QSize kSmall(960, 540);
constexpr std::array kDocks = {"cameras", "scene", "occlusion", "identification", "errors", "notes"};

std::string nameOf(const QWidget& widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  return QString("%1 '%2%3'")
      .arg(widget.metaObject()->className(), widget.objectName(), button ? button->text() : QString())
      .toStdString();
}

bool isControl(const QWidget& widget) {
  if (qobject_cast<const QHeaderView*>(&widget) || qobject_cast<const QTabBar*>(widget.parentWidget()))
    return false;
  if (qobject_cast<const QAbstractSpinBox*>(widget.parentWidget()) ||
      qobject_cast<const QComboBox*>(widget.parentWidget()))
    return false;
  return qobject_cast<const QAbstractButton*>(&widget) || qobject_cast<const QComboBox*>(&widget) ||
         qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QLineEdit*>(&widget) ||
         qobject_cast<const QAbstractItemView*>(&widget);
}

/// Of buttons of which one is pressed, Tab reaches that one and arrows reach the others.
bool reachedByArrows(const QWidget& widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  return button && button->group() && button->group()->exclusive();
}

QSet<QWidget*> controlsOf(const QWidget& content) {
  QSet<QWidget*> all;
  for (auto* widget : content.findChildren<QWidget*>())
    if (widget->isVisible() && widget->isEnabled() && isControl(*widget)) all.insert(widget);
  return all;
}

/// Whether it stands behind no tab, and every scroll area around shows it or as much as there is room for.
bool inView(const QWidget& widget) {
  for (const QWidget* up = widget.parentWidget(); up; up = up->parentWidget())
    if (qobject_cast<const QDockWidget*>(up) && up->visibleRegion().isEmpty()) return false;
  for (const QWidget* up = widget.parentWidget(); up; up = up->parentWidget()) {
    const auto* area = qobject_cast<const QScrollArea*>(up);
    if (!area) continue;
    const QRect shown = area->viewport()->rect();
    const QRect place(widget.mapTo(area->viewport(), QPoint()), widget.size());
    if (place.height() <= shown.height() && (place.top() < 0 || place.bottom() > shown.bottom()))
      return false;
    if (place.width() <= shown.width() && (place.left() < 0 || place.right() > shown.right())) return false;
    if (!shown.intersects(place)) return false;
  }
  return true;
}

/// Where Tab leads, once round.
QSet<QWidget*> walk(QWidget& window) {
  QSet<QWidget*> visited;
  constexpr int kMostSteps = 400;
  for (int step = 0; step < kMostSteps; ++step) {
    QWidget* at = QApplication::focusWidget();
    QTest::keyClick(at ? at : &window, Qt::Key_Tab);
    QWidget* now = QApplication::focusWidget();
    if (!now || visited.contains(now)) break;
    EXPECT_TRUE(QTest::qWaitFor([&] { return inView(*now); }, 500))
        << nameOf(*now) << " has the focus not observable";
    visited.insert(now);
  }
  return visited;
}

void expectReached(QWidget& content) {
  const auto controls = controlsOf(content);
  const auto visited = walk(*content.window());
  for (auto* control : controls)
    EXPECT_TRUE(visited.contains(control) || reachedByArrows(*control) || !control->isVisible())
        << nameOf(*control);
}

class Reach : public Shell {
 protected:
  std::unique_ptr<MainWindow> smallWindow() {
    auto window = std::make_unique<MainWindow>(file("settings.ini"));
    window->resize(kSmall);
    window->show();
    QApplication::setActiveWindow(window.get());
    window->open(atRest());
    EXPECT_TRUE(opened(*window));
    EXPECT_TRUE(waitFor([&] { return window->figure().history().end() > 0.5; }));
    return window;
  }
};

TEST_F(Reach, TheWindowIsAsSmallAsWasAsked) {
  auto window = smallWindow();
  const auto expectSmall = [&](const char* state) {
    window->resize(kSmall);
    QTest::qWait(100);
    EXPECT_EQ(window->size().width(), kSmall.width()) << state;
    EXPECT_EQ(window->size().height(), kSmall.height()) << state;
    EXPECT_LE(window->minimumSizeHint().width(), kSmall.width()) << state;
    EXPECT_LE(window->minimumSizeHint().height(), kSmall.height()) << state;
  };
  expectSmall("plots");
  test::grab(*window, "reach_960x540");
  for (const char* page : {"analyse", "diagnose", "learn"}) {
    window->action(page)->trigger();
    expectSmall(page);
    test::grab(*window, QString("reach_960x540_%1").arg(page));
    window->action(page)->trigger();
  }
  Q_EMIT window->link().failed(QString("only 0.4 GB are free on the disk. ").repeated(8));
  expectSmall("with a long message");
  test::grab(*window, "reach_960x540_message");
}

TEST_F(Reach, EveryDockComesByItsKeyAndTabReachesItsControls) {
  auto window = smallWindow();
  for (const char* name : kDocks) {
    SCOPED_TRACE(name);
    auto* dock = window->findChild<QDockWidget*>(name);
    auto* action = window->action(QString("view_%1").arg(name));
    ASSERT_TRUE(dock && action);
    ASSERT_FALSE(action->shortcut().isEmpty());
    dock->hide();
    QApplication::processEvents();
    QTest::keySequence(window.get(), action->shortcut());
    ASSERT_TRUE(waitFor([&] { return dock->isVisible() && !dock->visibleRegion().isEmpty(); }));
    EXPECT_TRUE(action->isChecked());
    QTest::keySequence(window.get(), action->shortcut());
    EXPECT_TRUE(waitFor([&] { return !dock->isVisible(); })) << "its key takes it away";
    EXPECT_FALSE(action->isChecked());
    QTest::keySequence(window.get(), action->shortcut());
    ASSERT_TRUE(waitFor([&] { return dock->isVisible() && !dock->visibleRegion().isEmpty(); }));
    test::grab(*window, QString("reach_dock_%1").arg(name));
    expectReached(*dock->widget());
  }
}

TEST_F(Reach, OneKeyTakesEveryDockAwayAndBringsThemBack) {
  auto window = smallWindow();
  auto* action = window->action("view_docks");
  ASSERT_TRUE(action);
  const auto shown = [&] {
    int count = 0;
    for (const char* name : kDocks) count += !window->findChild<QDockWidget*>(name)->isHidden();
    return count;
  };
  ASSERT_EQ(shown(), 6);
  QTest::keySequence(window.get(), action->shortcut());
  EXPECT_EQ(shown(), 0);
  window->action("view_notes")->trigger();
  EXPECT_EQ(shown(), 1);
  QTest::keySequence(window.get(), action->shortcut());
  EXPECT_EQ(shown(), 6);
}

TEST_F(Reach, TheRegistrationIsReachedByItsKey) {
  auto window = smallWindow();
  auto* dock = window->findChild<QDockWidget*>("registration");
  QTest::keySequence(window.get(), window->action("register")->shortcut());
  ASSERT_TRUE(waitFor([&] { return dock->isVisible(); }));
  const QSize screen = window->screen()->availableSize();
  EXPECT_LE(dock->height(), screen.height());
  EXPECT_LE(dock->minimumSizeHint().width(), kSmall.width());
  EXPECT_LE(dock->minimumSizeHint().height(), kSmall.height());
  QApplication::setActiveWindow(dock);
  dock->resize(640, 400);
  QTest::qWait(100);
  expectReached(*dock->widget());
  test::grab(*dock, "reach_dock_registration");
}

TEST_F(Reach, TabReachesTheControlsOfThePagesInTheMiddle) {
  auto window = smallWindow();
  for (const char* page : {"analyse", "diagnose", "learn"}) {
    SCOPED_TRACE(page);
    window->action(page)->trigger();
    QTest::qWait(100);
    expectReached(*window->centralWidget());
    window->action(page)->trigger();
  }
}

TEST_F(Reach, ReturnPressesTheButtonThatHasTheFocus) {
  auto window = smallWindow();
  auto* dock = window->findChild<QDockWidget*>("occlusion");
  auto* action = window->action("view_occlusion");
  ASSERT_TRUE(action);
  dock->hide();
  action->trigger();
  QAbstractButton* left = nullptr;
  for (auto* button : dock->findChildren<QAbstractButton*>())
    if (button->text() == "Left") left = button;
  ASSERT_TRUE(left);
  EXPECT_TRUE(waitFor([&] { return left->hasFocus(); }))
      << "a dock that was brought has the focus in its first control, not "
      << (QApplication::focusWidget() ? nameOf(*QApplication::focusWidget()) : "nothing");
  left->setFocus();
  QTest::keyClick(left, Qt::Key_Return);
  EXPECT_TRUE(waitFor([&] { return window->link().runner()->status().blocked[0]; }));
  EXPECT_EQ(stateOf(*window), live::RunState::kRunning);
}

void gather(const QList<QAction*>& actions, QSet<QAction*>& all) {
  for (auto* action : actions) {
    all.insert(action);
    if (action->menu()) gather(action->menu()->actions(), all);
  }
}

TEST_F(Reach, NoTwoActionsOfTheWindowShareAKey) {
  auto window = smallWindow();
  QSet<QAction*> listed;
  gather(window->findChild<QMenuBar*>()->actions(), listed);
  QMap<QKeySequence, QString> owners;
  for (auto* action : listed)
    for (const auto& key : action->shortcuts()) {
      EXPECT_FALSE(owners.contains(key))
          << key.toString().toStdString() << ": " << action->text().toStdString() << " and "
          << owners.value(key).toStdString();
      owners.insert(key, action->text());
    }
  EXPECT_GT(owners.size(), 10);
}

TEST_F(Reach, EveryActionOfTheBarIsInAMenuOfTheWindow) {
  auto window = smallWindow();
  auto* menus = window->findChild<QMenuBar*>();
  ASSERT_TRUE(menus);
  QSet<QAction*> listed;
  gather(menus->actions(), listed);
  for (auto* action : window->bar().actions()) {
    if (action->isSeparator()) continue;
    EXPECT_FALSE(action->text().isEmpty());
    const bool named = std::any_of(listed.begin(), listed.end(), [&](const QAction* one) {
      return one == action || QString(one->text()).remove('&') == action->text();
    });
    EXPECT_TRUE(named) << action->text().toStdString();
  }
  for (const char* name : {"run", "step", "slower", "faster", "simulate", "open", "record", "export", "note",
                           "identify", "diagnose", "analyse", "learn", "register", "theme", "help"})
    EXPECT_TRUE(window->action(name) && listed.contains(window->action(name))) << name;
}

TEST_F(Reach, WhatTheBarHasNoRoomForIsInItsMenu) {
  auto window = smallWindow();
  auto& bar = window->bar();
  auto* more = bar.findChild<QToolButton*>("qt_toolbar_ext_button");
  ASSERT_TRUE(more);
  int hidden = 0;
  for (auto* action : bar.actions()) {
    auto* widget = bar.widgetForAction(action);
    if (action->isSeparator() || !widget || widget->isVisible()) continue;
    ++hidden;
    ASSERT_TRUE(more->isVisible());
    ASSERT_TRUE(more->menu());
    EXPECT_TRUE(more->menu()->actions().contains(action)) << action->text().toStdString();
  }
  EXPECT_GT(hidden, 0);
}

}  // namespace
}  // namespace capstan::widgets
