#include <QAction>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QToolButton>

#include "core/base/resource.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/recover_controller.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {
namespace {

/// The button of a message that is shown.
QToolButton* buttonNamed(MainWindow& window, const QString& text) {
  for (auto* button : window.findChildren<QToolButton*>())
    if (button->isVisible() && button->text() == text) return button;
  return nullptr;
}

bool says(MainWindow& window, const QString& words) {
  for (auto* bar : window.findChildren<MessageBar*>())
    if (bar->isVisible() && bar->message().contains(words)) return true;
  return false;
}

QFileDialog* dialogTitled(MainWindow& window, const QString& title) {
  for (auto* dialog : window.findChildren<QFileDialog*>())
    if (dialog->isVisible() && dialog->windowTitle() == title) return dialog;
  return nullptr;
}

TEST_F(Shell, ADamagedSessionIsRecoveredAndOpened) {
  commandLine({"simulate", "--duration", "2", "--out", file("a.capstan")});
  QFile damaged(file("a.capstan"));
  ASSERT_TRUE(damaged.resize(damaged.size() / 2));
  const auto window = makeWindow();
  window->link().open(SourceChoice::ofFile(file("a.capstan")));
  ASSERT_TRUE(waitFor([&] { return buttonNamed(*window, "Recover…") != nullptr; }));
  EXPECT_TRUE(says(*window, "is damaged"));
  test::grab(*window, "recover-offered");
  buttonNamed(*window, "Recover…")->click();
  ASSERT_TRUE(waitFor([&] { return dialogTitled(*window, "Save what is readable as") != nullptr; }));
  QFileDialog* dialog = dialogTitled(*window, "Save what is readable as");
  EXPECT_EQ(dialog->selectedFiles(), QStringList{file("a-recovered.capstan")});
  dialog->selectFile(file("b.capstan"));
  QTest::keyClick(dialog->findChild<QLineEdit*>(), Qt::Key_Return);
  ASSERT_TRUE(opened(*window));
  EXPECT_TRUE(QFile::exists(file("b.capstan")));
  EXPECT_TRUE(waitFor([&] { return says(*window, "Recovered into"); }));
  test::grab(*window, "recover-done");
}

/// Overwrites 64 bytes of a file in place.
void overwrite(const QString& name, qint64 at) {
  QFile file(name);
  ASSERT_TRUE(file.open(QIODevice::ReadWrite) && file.seek(at));
  EXPECT_EQ(file.write(QByteArray(64, 'x')), 64);
}

TEST_F(Shell, DamageThatIsMetWhileReplayingCanBeRecovered) {
  commandLine({"simulate", "--duration", "3", "--out", file("a.capstan")});
  overwrite(file("a.capstan"), QFileInfo(file("a.capstan")).size() * 3 / 4);
  const auto window = makeWindow();
  window->link().open(SourceChoice::ofFile(file("a.capstan")));
  ASSERT_TRUE(opened(*window));
  EXPECT_EQ(buttonNamed(*window, "Recover…"), nullptr) << "it was to be met later";
  window->link().setRunning(true);
  ASSERT_TRUE(waitFor([&] { return buttonNamed(*window, "Recover…") != nullptr; }));
  EXPECT_TRUE(says(*window, "is damaged"));
}

TEST_F(Shell, ALostRobotIsAskedForAndGiven) {
  commandLine({"simulate", "--duration", "2", "--out", file("a.capstan")});
  QFile session(file("a.capstan"));
  ASSERT_TRUE(session.open(QIODevice::ReadOnly));
  const qint64 robot = session.readAll().indexOf("cable_stiffness");
  ASSERT_GT(robot, 0);
  session.close();
  overwrite(file("a.capstan"), robot);
  const auto window = makeWindow();
  RecoverController* recover = window->findChild<RecoverController*>();
  ASSERT_NE(recover, nullptr);
  recover->recover(file("a.capstan"), file("b.capstan"));
  ASSERT_TRUE(waitFor([&] { return buttonNamed(*window, "Robot file…") != nullptr; }));
  EXPECT_TRUE(says(*window, "is lost"));
  EXPECT_FALSE(QFile::exists(file("b.capstan")));
  buttonNamed(*window, "Robot file…")->click();
  ASSERT_TRUE(waitFor([&] { return dialogTitled(*window, "Robot of the session") != nullptr; }));
  QFileDialog* dialog = dialogTitled(*window, "Robot of the session");
  dialog->selectFile(QString::fromStdString(base::resource("robots/raven2_left.yaml")));
  QTest::keyClick(dialog->findChild<QLineEdit*>(), Qt::Key_Return);
  ASSERT_TRUE(opened(*window));
  EXPECT_TRUE(QFile::exists(file("b.capstan")));
}

TEST_F(Shell, AMenuRecoversASessionThatWasNotOpened) {
  const auto window = makeWindow();
  auto* recover = window->findChild<QAction*>("recover");
  ASSERT_NE(recover, nullptr);
  recover->trigger();
  EXPECT_TRUE(waitFor([&] { return dialogTitled(*window, "Damaged session") != nullptr; }));
}

}  // namespace
}  // namespace capstan::widgets
