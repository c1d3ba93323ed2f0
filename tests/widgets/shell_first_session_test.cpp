// A first session as a new user plays it, by mouse and keyboard in a real window: simulate, register in
// several poses, identify, a trial with occlusion, replay in a loop, box plot, export; every exported file is
// opened.
#include <QApplication>
#include <QCheckBox>
#include <QDir>
#include <QDirIterator>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QImage>
#include <QPushButton>
#include <QRegularExpression>
#include <QTabBar>
#include <QToolButton>
#include <QXmlStreamReader>

#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/figures/boxplot_figure.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/registration/poses_page.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/replay/replay_bar.h"
#include "widgets/shell/export_controller.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/simulation_dialog.h"

namespace capstan::widgets {
namespace {

/// Waits longer than waitFor(): for a minute of session at ten times its speed.
template <class Condition>
bool waitLong(Condition&& condition) {
  return QTest::qWaitFor(condition, 120000);
}

template <class Button>
Button* buttonOf(const QWidget& panel, const QString& text) {
  for (auto* one : panel.findChildren<Button*>())
    if (one->text() == text && one->isVisible()) return one;
  return nullptr;
}

template <class Dialog>
Dialog* dialogOf() {
  for (QWidget* window : QApplication::topLevelWidgets())
    if (auto* dialog = qobject_cast<Dialog*>(window); dialog && dialog->isVisible()) return dialog;
  return nullptr;
}

class FirstSession : public Shell {
 protected:
  void click(const QWidget& panel, const QString& text) {
    QAbstractButton* button = buttonOf<QPushButton>(panel, text);
    if (!button) button = buttonOf<QToolButton>(panel, text);
    ASSERT_TRUE(button) << "no button " << text.toStdString();
    ASSERT_TRUE(waitFor([&] { return button->isEnabled(); })) << text.toStdString();
    QTest::mouseClick(button, Qt::LeftButton);
  }
  void press(int key, Qt::KeyboardModifiers with = Qt::NoModifier) {
    QTest::keyClick(window_.get(), static_cast<Qt::Key>(key), with);
  }
  void picture(const char* name) {
    if (qEnvironmentVariableIsSet("CAPSTAN_PICTURES"))
      test::grab(*window_, QStringLiteral("first_session_%1").arg(name));
  }
  double time() const { return window_->link().runner()->status().t; }
  void waitUntil(double t) {
    ASSERT_TRUE(waitLong([&] { return time() >= t; })) << "the session stands at " << time() << " s";
  }

  void simulate();
  void registerInSeveralPoses();
  void identify();
  void recordWithOcclusion();
  void replayInALoop();
  void analyse();
  QString exportEverything();

  std::unique_ptr<MainWindow> window_;
};

void FirstSession::simulate() {
  press(Qt::Key_N, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([] { return dialogOf<SimulationDialog>() != nullptr; }));
  auto* dialog = dialogOf<SimulationDialog>();
  for (auto* box : dialog->findChildren<QCheckBox*>())
    if (box->text() == "cameras registered already" && box->isChecked())
      QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
  EXPECT_FALSE(dialog->request().registered);
  auto* duration = dialog->findChild<QDoubleSpinBox*>();
  duration->setFocus();
  duration->selectAll();
  QTest::keyClicks(duration, "3000");
  EXPECT_EQ(dialog->request().duration, 3000.0);
  click(*dialog, "Start");
  ASSERT_TRUE(opened(*window_));
  for (int i = 0; i < 12 && window_->bar().speed() < 10.0; ++i) press(Qt::Key_BracketRight);
  EXPECT_EQ(window_->bar().speed(), 10.0);
}

void FirstSession::registerInSeveralPoses() {
  press(Qt::Key_R, Qt::ControlModifier);
  auto* panel = window_->findChild<RegistrationPanel*>();
  ASSERT_TRUE(waitFor([&] { return panel->isVisible(); }));
  auto* tabs = panel->findChild<QTabBar*>();
  for (int tab = 0; tab < tabs->count(); ++tab)
    if (tabs->tabText(tab) == "Several poses")
      QTest::mouseClick(tabs, Qt::LeftButton, {}, tabs->tabRect(tab).center());
  PosesPage& page = panel->posesPage();
  ASSERT_TRUE(page.isVisible());
  click(page, "Collect poses");
  ASSERT_TRUE(waitLong([&] { return page.collector()->poses().size() >= 12 && page.collector()->fit(); }));
  click(page, "Check at three more poses");
  ASSERT_TRUE(waitLong([&] { return page.collector()->checks().size() == 3; }));
  picture("registration");
  if (qEnvironmentVariableIsSet("CAPSTAN_PICTURES")) test::grab(*panel, "first_session_poses");
  click(page, "Accept");
  ASSERT_TRUE(
      waitFor([&] { return window_->link().runner()->report().gateShare(tracking::Gate::kOpen) > 0.0; }));
  if (panel->window() != window_.get()) panel->window()->close();
  window_->activateWindow();
}

/// At twice its speed: a loaded computer must not collect minutes of data while it fits the first ones.
void FirstSession::identify() {
  for (int i = 0; i < 12 && window_->bar().speed() > 2.0; ++i) press(Qt::Key_BracketLeft);
  press(Qt::Key_I);
  IdentificationPanel& panel = window_->identification();
  ASSERT_EQ(panel.live().phase(), identification::LivePhase::kCollecting);
  const auto radius_known = [&] {
    const auto rows = panel.live().rows();
    return std::any_of(rows.begin(), rows.end(),
                       [](const auto& row) { return row.name == "r_l1" && row.seen; });
  };
  constexpr double kEnough = 60.0;  // of motion [s]
  ASSERT_TRUE(waitLong([&] { return radius_known() && panel.live().shown().recorded > kEnough; }))
      << panel.words().toStdString();
  press(Qt::Key_I, Qt::ShiftModifier);
  ASSERT_TRUE(waitLong([&] { return panel.live().refined(); })) << panel.words().toStdString();
  picture("identification");
  press(Qt::Key_Return, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([&] { return panel.live().phase() == identification::LivePhase::kAccepted; }))
      << panel.words().toStdString();
  click(*window_, "Register again");  // the poses were tips by the former constants
  for (int i = 0; i < 12 && window_->bar().speed() < 10.0; ++i) press(Qt::Key_BracketRight);
}

void FirstSession::recordWithOcclusion() {
  click(*window_->findChild<OcclusionPanel*>(), "40");
  press(Qt::Key_E);
  press(Qt::Key_R);
  ASSERT_TRUE(waitFor([&] { return window_->link().recording(); }));
  const double begin = time();
  ASSERT_NO_FATAL_FAILURE(waitUntil(begin + 30.0));
  picture("occlusion");
  press(Qt::Key_R);
  ASSERT_TRUE(waitFor([&] { return !window_->link().recording(); }));
  press(Qt::Key_Space);
  ASSERT_TRUE(waitFor([&] { return stateOf(*window_) == live::RunState::kPaused; }));
  const tracking::TrackReport report = window_->link().runner()->report();
  EXPECT_NEAR(report.gateShare(tracking::Gate::kBothLost), 0.4, 0.12);
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(report.errors.ukf().value()(joint), report.errors.kinematic().value()(joint))
        << "q" << joint + 1 << ": registration and identification made it better than the motors";
}

void FirstSession::replayInALoop() {
  auto* replay = window_->findChild<ReplayBar*>();
  TimeLine& line = replay->line();
  const double newest = window_->figure().history().end();
  const auto clickAt = [&](double t) {
    QTest::mouseClick(&line, Qt::LeftButton, {}, QPoint(line.placeOf(t), line.height() / 2));
  };
  clickAt(newest - 60.0);
  click(*replay, "A");
  clickAt(newest - 20.0);
  click(*replay, "B");
  ASSERT_TRUE(replay->loop().closed());
  const double from = *replay->loop().from, to = *replay->loop().to;
  EXPECT_GT(to, from + 1.0);
  click(*replay, "▶");
  int wraps = 0;
  double before = *replay->time();
  QObject watcher;
  QObject::connect(replay, &ReplayBar::reviewed, &watcher, [&](double t) {
    EXPECT_GE(t, from - 1e-6);
    EXPECT_LE(t, to + 1e-6);
    wraps += t < before;
    before = t;
  });
  ASSERT_TRUE(waitFor([&] { return wraps >= 2; })) << "the loop does not come round";
  picture("loop");
  replay->setFocus();
  QTest::keyClick(replay, Qt::Key_P);
  EXPECT_FALSE(replay->playing());
  QTest::keyClick(replay, Qt::Key_Escape);
  EXPECT_FALSE(replay->reviewing());
}

void FirstSession::analyse() {
  ASSERT_TRUE(waitFor([&] { return buttonOf<QToolButton>(window_->news(), "Analyse") != nullptr; }));
  click(window_->news(), "Analyse");
  ASSERT_TRUE(waitFor([&] { return window_->analysis().isVisible(); }));
  BoxplotFigure* boxes = nullptr;
  const auto full = [&] {
    boxes = window_->analysis().findChild<BoxplotFigure*>();
    if (!boxes) return false;
    for (const BoxplotPanel& panel : boxes->data().panels)
      if (!panel.groups.empty() && !panel.groups.front().boxes.empty()) return true;
    return false;
  };
  ASSERT_TRUE(waitLong(full)) << "no box";
  QTest::qWait(300);
  picture("boxplot");
}

QString FirstSession::exportEverything() {
  press(Qt::Key_X, Qt::ControlModifier | Qt::ShiftModifier);
  if (!waitFor([] { return dialogOf<QFileDialog>() != nullptr; })) return {};
  dialogOf<QFileDialog>()->selectFile(file("everything"));  // typed, Qt's completer would take the next click
  click(*dialogOf<QFileDialog>(), "&Save");
  const QString index = file("everything/index.html");
  EXPECT_TRUE(waitLong([&] { return QFileInfo::exists(index) && !window_->exports().busy(); }));
  return file("everything");
}

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << path.toStdString();
  return file.readAll();
}

void openCsv(const QString& path) {
  const QStringList lines = QString::fromUtf8(bytesOf(path)).trimmed().split('\n');
  EXPECT_GE(lines.size(), 2) << path.toStdString();
  const auto cells = [](QString line) {
    return line.replace(QRegularExpression("\"(\"\"|[^\"])*\""), "q").count(',');
  };
  for (const QString& line : lines) ASSERT_EQ(cells(line), cells(lines.front())) << line.toStdString();
}

void openXml(const QString& path) {
  QXmlStreamReader xml(bytesOf(path));
  while (!xml.atEnd()) xml.readNext();
  EXPECT_FALSE(xml.hasError()) << path.toStdString() << ": " << xml.errorString().toStdString();
}

/// Every link and picture of the page is a file beside it.
int openHtml(const QString& path) {
  const QString text = QString::fromUtf8(bytesOf(path));
  auto links = QRegularExpression("(?:href|src)=\"([^\"#:]+)\"").globalMatch(text);
  int count = 0;
  for (; links.hasNext(); ++count) {
    const QString target = links.next().captured(1);
    EXPECT_TRUE(QFileInfo::exists(QFileInfo(path).dir().filePath(target))) << target.toStdString();
  }
  return count;
}

void openFile(const QString& path) {
  const QString suffix = QFileInfo(path).suffix();
  const QByteArray bytes = bytesOf(path);
  EXPECT_GT(bytes.size(), 20) << path.toStdString();
  if (suffix == "png") {
    const QImage image(path);
    EXPECT_GT(image.width(), 100) << path.toStdString();
  } else if (suffix == "svg") {
    openXml(path);
  } else if (suffix == "pdf") {
    EXPECT_TRUE(bytes.startsWith("%PDF-")) << path.toStdString();
    EXPECT_TRUE(bytes.trimmed().endsWith("%%EOF")) << path.toStdString();
  } else if (suffix == "csv") {
    openCsv(path);
  } else if (suffix == "html") {
    EXPECT_GT(openHtml(path), 3) << path.toStdString();
  } else {
    EXPECT_TRUE(suffix == "yaml" || suffix == "md" || suffix == "tex")
        << "unknown kind: " << path.toStdString();
  }
}

TEST_F(FirstSession, IsPlayedByMouseAndKeyboard) {
  window_ = makeWindow();
  QApplication::setActiveWindow(window_.get());
  ASSERT_NO_FATAL_FAILURE(simulate());
  ASSERT_NO_FATAL_FAILURE(registerInSeveralPoses());
  ASSERT_NO_FATAL_FAILURE(identify());
  ASSERT_NO_FATAL_FAILURE(recordWithOcclusion());
  ASSERT_NO_FATAL_FAILURE(replayInALoop());
  ASSERT_NO_FATAL_FAILURE(analyse());
  const QString folder = exportEverything();
  QStringList kinds;
  int files = 0;
  for (QDirIterator all(folder, QDir::Files, QDirIterator::Subdirectories); all.hasNext(); ++files) {
    openFile(all.next());
    kinds << all.fileInfo().suffix();
  }
  for (const char* kind : {"png", "svg", "pdf", "csv", "html", "yaml"})
    EXPECT_TRUE(kinds.contains(kind)) << "no " << kind;
  EXPECT_GT(files, 20);
  RecordProperty("files", files);
}

}  // namespace
}  // namespace capstan::widgets
