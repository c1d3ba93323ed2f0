// Book-keeping of the window: title, recent recordings, offers after a recording, export of everything,
// layouts by name, undo of settings, the manual at the panel in use.
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QStackedWidget>
#include <QTextBrowser>
#include <QTextStream>
#include <QToolButton>
#include <nlohmann/json.hpp>

#include "core/estimation/nis_verdict.h"
#include "core/tracking/snapshot.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/shell/export_controller.h"
#include "widgets/shell/help_window.h"
#include "widgets/shell/layout_controller.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/recent_menu.h"
#include "widgets/shell/source_menu.h"

namespace capstan::widgets {
namespace {

/// The window with a session, and a cache of its own.
class Books : public Shell {
 protected:
  void SetUp() override {
    Shell::SetUp();
    qputenv("XDG_CACHE_HOME", file("cache").toUtf8());
  }
  std::unique_ptr<MainWindow> windowAtRest() {
    auto window = makeWindow();
    window->open(atRest());
    EXPECT_TRUE(opened(*window));
    return window;
  }
  QString simulated(const QString& name, const QString& seconds, const QStringList& more = {}) const {
    commandLine(QStringList{"simulate", "--out", file(name), "--duration", seconds} + more);
    return file(name);
  }
  static QToolButton* buttonOf(const MessageBar& bar, const QString& text) {
    for (auto* button : bar.findChildren<QToolButton*>())
      if (button->text() == text && !button->isHidden()) return button;
    return nullptr;
  }
  static QString textOf(const QString& path) {
    QFile text(path);
    EXPECT_TRUE(text.open(QIODevice::ReadOnly)) << path.toStdString();
    return QString::fromUtf8(text.readAll());
  }
};

TEST_F(Books, TheTitleSaysWhatIsShownAndWhetherItIsRecorded) {
  auto window = windowAtRest();
  ASSERT_TRUE(waitFor([&] { return window->windowTitle() == "Capstan ─ simulated RAVEN-II left"; }))
      << window->windowTitle().toStdString();
  window->link().toggleRecording(file("recordings"));
  ASSERT_TRUE(waitFor([&] { return window->windowTitle().contains("● REC"); }));
  window->link().toggleRecording(file("recordings"));
  ASSERT_TRUE(waitFor([&] { return !window->windowTitle().contains("● REC"); }));
  window->open(SourceChoice::ofFile(simulated("trial.capstan", "1", {"--no-images"})));
  ASSERT_TRUE(waitFor([&] { return window->windowTitle().contains("recording trial.capstan"); }))
      << window->windowTitle().toStdString();
}

TEST_F(Books, ACompleteRecordingIsOfferedToOpenAndToAnalyse) {
  auto window = windowAtRest();
  const auto record = [&] {
    window->link().toggleRecording(file("recordings"));
    EXPECT_TRUE(waitFor([&] { return window->link().recording(); }));
    QTest::qWait(300);
    EXPECT_TRUE(window->news().message().isEmpty());
    window->link().toggleRecording(file("recordings"));
    EXPECT_TRUE(waitFor([&] { return window->news().message().startsWith("Recorded: "); }));
    return QString::fromStdString(window->link().runner()->status().recording);
  };
  const QString recorded = record();
  EXPECT_EQ(window->bar().sources().recent().files(), QStringList{recorded});
  test::grab(*window, "recording_offer");
  buttonOf(window->news(), "Analyse")->click();
  EXPECT_EQ(window->analysis().picker(0).choice().path, recorded);
  EXPECT_TRUE(window->analysis().isVisible());
  EXPECT_TRUE(window->news().message().isEmpty());
  QTest::qWait(1000);  // names of recordings have seconds
  const QString second = record();
  buttonOf(window->news(), "Open")->click();
  ASSERT_TRUE(waitFor([&] { return window->lastSource().file == second; }));
}

TEST_F(Books, RecentRecordingsHaveImageDateDurationAndRobot) {
  const QString trial = simulated("trial.capstan", "1.5");
  auto window = makeWindow();
  RecentMenu& recent = window->bar().sources().recent();
  QFile broken(file("broken.capstan"));
  ASSERT_TRUE(broken.open(QIODevice::WriteOnly) && broken.write("no session") > 0);
  broken.close();
  recent.setFiles({trial, file("gone.capstan"), broken.fileName()});
  recent.popup(window->mapToGlobal(QPoint(50, 50)));
  ASSERT_TRUE(waitFor([&] { return recent.details(0).contains("RAVEN-II left"); }))
      << recent.details(0).toStdString();
  EXPECT_TRUE(recent.details(0).contains(QDate::currentDate().toString("yyyy-MM-dd")));
  EXPECT_TRUE(recent.details(0).contains("0:02")) << recent.details(0).toStdString();
  EXPECT_FALSE(recent.actions()[0]->icon().isNull());
  EXPECT_FALSE(recent.actions()[1]->isEnabled());
  EXPECT_EQ(recent.details(1), "no longer there");
  EXPECT_TRUE(waitFor([&] { return recent.details(2).endsWith("not readable"); }));
  EXPECT_FALSE(test::grab(recent, "recent").isNull());
  recent.close();

  RecentMenu again;  // from the cache, at once
  again.setFiles({trial});
  EXPECT_EQ(again.details(0), recent.details(0));
  QFile(trial).resize(1000);  // another file now
  again.setFiles({trial});
  EXPECT_EQ(again.details(0), "reading…");
  again.setFiles({});
  EXPECT_TRUE(QDir(file("cache/capstan/recordings")).isEmpty(QDir::Files)) << "what nobody lists is not kept";
}

TEST_F(Books, ExportsEverythingAsTheCommandLineDoes) {
  const QString trial = simulated("trial.capstan", "2");
  commandLine({"export", trial, "--out", file("expected")});
  auto window = makeWindow();
  window->bar().setSpeed(50.0);
  window->open(SourceChoice::ofFile(trial));
  ASSERT_TRUE(waitFor([&] { return stateOf(*window) == live::RunState::kEnded; }));
  QTest::qWait(200);  // the last rows
  window->exports().exportEverything(file("out"));
  ASSERT_TRUE(window->exports().busy()) << window->message().toStdString();
  ASSERT_TRUE(waitFor([&] { return !window->exports().busy(); }));
  EXPECT_TRUE(window->message().isEmpty()) << window->message().toStdString();
  const QString index = textOf(file("out/index.html"));
  EXPECT_TRUE(index.contains("<h1>recording trial.capstan")) << "the title names the recording";
  for (const QString& name : QDir(file("expected")).entryList(QDir::Files)) {
    QString mine = name;
    mine.replace("trial-trajectory-trial", "session-trajectory-session")
        .replace("trial-histogram-trial", "session-histogram-session");
    if (mine.startsWith("trial-")) mine.replace(0, 5, "session");
    EXPECT_TRUE(QFileInfo(file("out/" + mine)).size() > 0) << mine.toStdString();
    EXPECT_TRUE(name == "index.html" || index.contains(mine)) << mine.toStdString();
  }
  for (const char* settings : {"robot.yaml", "filter.yaml", "registration.yaml", "camera_left.yaml"})
    EXPECT_EQ(textOf(file("out/") + settings), textOf(file("expected/") + settings)) << settings;
  EXPECT_EQ(textOf(file("out/session-table-means.csv")).section('\n', 1),
            textOf(file("expected/trial-table-means.csv")).section('\n', 1));
}

TEST_F(Books, AnExportOfEverythingCanBeCancelledAndNamesAFolderThatIsNotFree) {
  auto window = windowAtRest();
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > 0.3; }));
  QDir().mkpath(file("mine"));
  QFile mine(file("mine/text"));
  ASSERT_TRUE(mine.open(QIODevice::WriteOnly));
  window->exports().exportEverything(file("mine"));
  EXPECT_TRUE(window->message().contains("is not empty")) << window->message().toStdString();
  window->exports().exportEverything(file("out"));
  EXPECT_TRUE(window->message().isEmpty());
  MessageBar* bar = nullptr;
  for (auto* one : window->findChildren<MessageBar*>())
    if (one->message().startsWith("Exporting everything")) bar = one;
  ASSERT_TRUE(bar);
  ASSERT_TRUE(waitFor([&] { return QFile::exists(file("out/session-joints.csv")); }));
  buttonOf(*bar, "Cancel")->click();
  EXPECT_TRUE(waitFor([&] { return !window->exports().busy(); }));
  EXPECT_TRUE(bar->message().startsWith("Cancelled")) << bar->message().toStdString();
  EXPECT_TRUE(textOf(file("out/index.html")).contains("Cancelled: not all figures are here"));
  EXPECT_FALSE(QFile::exists(file("out/session-boxplot.pdf")));
}

TEST_F(Books, PanelsOfOcclusionAndErrorsAreWholeInARestoredLayoutToo) {
  for (const char* start : {"first", "second, with the layout of the first"}) {
    auto window = windowAtRest();
    for (const char* name : {"occlusion", "errors"}) {
      const QWidget& panel = *window->findChild<QDockWidget*>(name)->widget();
      EXPECT_GE(panel.height(), panel.sizeHint().height()) << name << ", start: " << start;
      EXPECT_GT(panel.minimumHeight(), 100) << name << ", start: " << start;
    }
    window->close();
  }
}

TEST_F(Books, LayoutsAreSavedChosenDeletedAndResetByName) {
  const auto hidden = [](MainWindow& window, const char* name) {
    return window.findChild<QDockWidget*>(name)->isHidden();
  };
  {
    auto window = makeWindow();
    window->findChild<QDockWidget*>("scene")->close();
    window->layouts().store("Plots/only & more");
    window->findChild<QDockWidget*>("scene")->show();
    window->close();
  }
  auto window = makeWindow();
  EXPECT_FALSE(hidden(*window, "scene"));
  EXPECT_EQ(window->layouts().names(), QStringList{"Plots/only & more"});
  window->layouts().actions().front()->trigger();
  EXPECT_TRUE(hidden(*window, "scene"));
  window->findChild<QDockWidget*>("errors")->close();
  window->action("layoutReset")->trigger();
  EXPECT_FALSE(hidden(*window, "scene"));
  EXPECT_FALSE(hidden(*window, "errors"));
  test::grab(*window, "layout_reset");
  QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(hidden(*window, "errors")) << "undo of the reset";
  QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(hidden(*window, "errors")) << "undo of its closing";
  EXPECT_TRUE(hidden(*window, "scene"));
  window->layouts().remove("Plots/only & more");
  EXPECT_TRUE(window->layouts().names().isEmpty());
}

TEST_F(Books, SettingsAreUndoneAndDoneAgainByTheirNames) {
  auto window = windowAtRest();
  auto* undo = window->action("undo");
  EXPECT_FALSE(undo->isEnabled());
  window->setThemeNamed("light");
  EXPECT_EQ(undo->text(), "Undo theme light");
  window->bar().setSpeed(0.5);
  auto* occlusion = window->findChild<OcclusionPanel*>();
  for (auto* button : occlusion->findChildren<QAbstractButton*>())
    if (button->text() == "40") button->click();
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().occlusion.percentage == 40.0; }));
  EXPECT_EQ(undo->text(), "Undo occlusion schedule");
  const auto press = [&](Qt::KeyboardModifiers keys) { QTest::keyClick(window.get(), Qt::Key_Z, keys); };
  press(Qt::ControlModifier);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().occlusion.percentage == 0.0; }));
  EXPECT_EQ(occlusion->schedule().percentage, 0.0);
  press(Qt::ControlModifier);
  EXPECT_EQ(window->bar().speed(), 1.0);
  EXPECT_TRUE(waitFor([&] { return window->link().runner()->status().speed == 1.0; }));
  press(Qt::ControlModifier);
  EXPECT_EQ(window->themeName(), "dark");
  EXPECT_FALSE(undo->isEnabled());
  for (int i = 0; i < 3; ++i) press(Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(window->themeName(), "light");
  EXPECT_EQ(window->bar().speed(), 0.5);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().occlusion.percentage == 40.0; }));
  EXPECT_FALSE(window->action("redo")->isEnabled());
}

TEST_F(Books, EveryActionOfTheBarHasRoomAt1280Pixels) {
  auto window = windowAtRest();
  for (auto* action : window->bar().actions()) {
    const auto* widget = window->bar().widgetForAction(action);
    EXPECT_TRUE(action->isSeparator() || !widget || widget->isVisible()) << action->text().toStdString();
  }
}

TEST_F(Books, UndoEndsWithItsSession) {
  auto window = windowAtRest();
  window->bar().setSpeed(2.0);
  EXPECT_TRUE(window->action("undo")->isEnabled());
  window->open(atRest(50.0));
  EXPECT_TRUE(waitFor([&] { return !window->action("undo")->isEnabled(); }));
  EXPECT_EQ(window->bar().speed(), 2.0);
}

TEST_F(Books, EveryPanelHasItsSectionOfTheManual) {
  auto window = makeWindow();
  HelpWindow help;
  for (const auto& [panel, topic] : helpTopics()) {
    help.show(topic);
    QCoreApplication::processEvents();
    EXPECT_FALSE(help.section().isEmpty()) << panel.toStdString();
    EXPECT_TRUE(topic.section.isEmpty() || help.section() == topic.section) << panel.toStdString();
  }
  const HelpTopic begin = topicOf(nullptr);
  for (auto* dock : window->findChildren<QDockWidget*>()) {
    const auto inside = dock->findChildren<QWidget*>();
    EXPECT_TRUE(std::any_of(inside.begin(), inside.end(), [&](auto* w) { return !(topicOf(w) == begin); }))
        << dock->objectName().toStdString() << ": a panel needs a section of the manual (help_topics.cpp)";
  }
}

template <class Enum>
void expectNames(const QString& page) {
  for (const auto& [value, name] : base::NamesOf<Enum>::value)
    EXPECT_TRUE(value == Enum{} || page.contains(name)) << name;  // the first one: nothing is wrong
}

TEST_F(Books, TroubleshootingNamesEveryWordOfTheStatus) {
  HelpWindow help;
  help.show({"troubleshooting.md", {}});
  const QString page = help.text();
  expectNames<tracking::Gate>(page);
  expectNames<vision::MarkerFault>(page);
  expectNames<estimation::NisVerdict>(page);
  EXPECT_TRUE(page.contains("no pixels of the marker's colour"));
}

TEST_F(Books, F1OpensTheManualAtThePanelWithTheFocus) {
  auto window = windowAtRest();
  auto* interval = window->findChild<OcclusionPanel*>()->findChild<QWidget*>("qt_spinbox_lineedit");
  ASSERT_TRUE(interval && QTest::qWaitForWindowActive(window.get()));
  interval->setFocus();
  window->action("help")->trigger();
  auto* help = window->findChild<HelpWindow*>();
  ASSERT_TRUE(help && help->isVisible());
  EXPECT_TRUE(waitFor([&] { return help->section() == "Occlusion"; })) << help->section().toStdString();
  EXPECT_FALSE(test::grab(*help, "help_occlusion").isNull());
}

}  // namespace
}  // namespace capstan::widgets
