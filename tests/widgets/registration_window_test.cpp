// The history of registrations in the window: what is decided there is in the file that the command line
// reads.
#include <QAction>
#include <QDir>
#include <QFile>
#include <QMessageBox>
#include <QPushButton>
#include <QTabWidget>
#include <QTimer>
#include <QVariant>
#include <future>

#include "core/vision/registration_file.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/registration/history_page.h"
#include "widgets/panels/registration/poses_page.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/registration/result_page.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/unsaved_poses.h"

namespace capstan::widgets {
namespace {

class RegistrationWindow : public Shell {
 protected:
  void begin() {
    window_ = makeWindow();
    window_->bar().setSpeed(10.0);
    SourceChoice choice = atRest();
    choice.simulation.registered = false;
    window_->open(choice);
    ASSERT_TRUE(opened(*window_));
    window_->action("register")->trigger();
    panel_ = window_->findChild<RegistrationPanel*>();
  }
  /// Answers the next question of the window.
  void answer(QMessageBox::StandardButton button) {
    QTimer::singleShot(0, [this, button] {
      auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      ASSERT_TRUE(question);
      asked_ = question->text();
      test::grab(*question, "unsaved_poses_question");
      question->button(button)->click();
    });
  }
  void press(const QString& text) {
    for (auto* button : panel_->findChildren<QPushButton*>())
      if (button->text() == text && button->isVisible()) {
        EXPECT_TRUE(waitFor([&] { return button->isEnabled(); })) << text.toStdString();
        return button->click();
      }
    FAIL() << "no button " << text.toStdString();
  }
  /// An arm that still settles ends a collection with a reason; a person collects again.
  void registerAtTheStop() {
    using Step = registration::RegistrationStep;
    press("Drive to the hard stop");
    for (int attempt = 0; attempt < 5 && panel_->guide()->step() != Step::kReview; ++attempt) {
      press(attempt == 0 ? "Collect frames" : "Collect again");
      ASSERT_TRUE(waitFor([&] {
        const Step step = panel_->guide()->step();
        return step == Step::kReview || step == Step::kRefused;
      }));
    }
    ASSERT_EQ(panel_->guide()->step(), Step::kReview) << panel_->guide()->reason();
  }
  Eigen::Isometry3d inUse() {
    std::promise<Eigen::Isometry3d> promise;
    auto future = promise.get_future();
    window_->link().runner()->post([&](tracking::Source&, tracking::TrackingPipeline& pipeline) {
      promise.set_value(pipeline.registration().value_or(Eigen::Isometry3d::Identity()));
    });
    waitFor([&] { return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    return future.get();
  }

  std::unique_ptr<MainWindow> window_;
  RegistrationPanel* panel_ = nullptr;
  QString asked_;
};

TEST_F(RegistrationWindow, KeepsItsHistoryWhichTheCommandLineReads) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(registerAtTheStop());
  const Eigen::Isometry3d found = panel_->guide()->proposal()->registration.base_from_camera;
  press("Accept");
  HistoryPage& page = panel_->historyPage();
  ASSERT_EQ(page.entries().size(), 1u);
  EXPECT_EQ(page.entries()[0].used, registration::RegistrationGuide::kFrames);
  EXPECT_GT(*page.entries()[0].rms, 1e-5);
  press("Close");
  window_->action("register")->trigger();
  ASSERT_NO_FATAL_FAILURE(registerAtTheStop());
  Q_EMIT panel_->resultPage().rejectRequested("only a trial");
  ASSERT_EQ(page.entries().size(), 2u);
  EXPECT_EQ(page.entries()[1].reason, "only a trial");

  // A file of another rig is imported, and the first registration restored.
  Eigen::Isometry3d other = found;
  other.translation().x() += 0.004;
  vision::writeRegistration(other, file("other.yaml").toStdString());
  page.importFrom(file("other.yaml"));
  EXPECT_EQ(inUse().matrix(), other.matrix());
  page.select({0});
  EXPECT_TRUE(page.comparison().contains("translation 4.00 mm")) << page.comparison().toStdString();
  const std::string said = page.comparison().toStdString();
  test::grab(*panel_, "history_window");
  auto* restore = panel_->findChild<QPushButton*>("restore");
  ASSERT_TRUE(restore && restore->isEnabled());
  restore->click();
  EXPECT_EQ(inUse().matrix(), found.matrix());
  ASSERT_EQ(page.entries().size(), 4u);
  EXPECT_TRUE(window_->notes().row(window_->notes().rows() - 1).contains("restored"));

  const QByteArray list = commandLine({"registrations", file("registrations.yaml")});
  for (const char* word : {"accepted", "rejected", "only a trial", "imported", "restored"})
    EXPECT_TRUE(list.contains(word)) << list.toStdString();
  const std::string difference =
      commandLine({"registrations", file("registrations.yaml"), "--compare", "3", "1"})
          .trimmed()
          .toStdString();
  EXPECT_NE(said.find(difference), std::string::npos) << said << "\n" << difference;
  commandLine({"registrations", file("registrations.yaml"), "--export", "4", "--out", file("again.yaml")});
  EXPECT_EQ(vision::readRegistration(file("again.yaml").toStdString()).matrix(), found.matrix());
}

TEST_F(RegistrationWindow, LosesNoPosesWithoutAWord) {
  ASSERT_NO_FATAL_FAILURE(begin());
  PosesPage& page = panel_->posesPage();
  panel_->findChild<QTabWidget*>()->setCurrentWidget(&page);
  const auto poses = [&] { return page.collector()->poses().size(); };
  press("Collect poses");
  ASSERT_TRUE(waitFor([&] { return poses() > 0; })) << "one pose of an arm at rest";
  window_->action("register")->trigger();  // closes the panel
  window_->action("register")->trigger();
  EXPECT_EQ(poses(), 1u);
  press("Cancel");
  window_->action("register")->trigger();
  EXPECT_EQ(poses(), 1u);

  const SourceChoice first = window_->lastSource();
  SourceChoice other = first;
  other.simulation.seed = 7;
  const auto open = [&](const SourceChoice& choice) {
    bool began = false;
    const auto heard = QObject::connect(&window_->link(), &SessionLink::opened, [&began] { began = true; });
    window_->open(choice);
    EXPECT_TRUE(waitFor([&] { return began; }));
    QObject::disconnect(heard);
  };
  open(first);
  EXPECT_EQ(poses(), 1u) << "the same session again";
  EXPECT_FALSE(page.elsewhere());
  open(other);
  EXPECT_EQ(poses(), 1u);
  EXPECT_TRUE(page.elsewhere());
  test::grab(*panel_, "poses_of_the_session_before");

  answer(QMessageBox::Cancel);
  EXPECT_FALSE(window_->close());
  EXPECT_TRUE(asked_.contains("One pose of a registration is")) << asked_.toStdString();
  EXPECT_TRUE(window_->isVisible());
  press("Clear");
  EXPECT_FALSE(page.elsewhere());
  EXPECT_TRUE(window_->close()) << "nothing to lose";
}

TEST_F(RegistrationWindow, AWindowThatNobodyAttendsWritesItsPosesWhenItCloses) {
  ASSERT_NO_FATAL_FAILURE(begin());
  panel_->findChild<QTabWidget*>()->setCurrentWidget(&panel_->posesPage());
  press("Collect poses");
  ASSERT_TRUE(waitFor([&] { return panel_->posesPage().unsaved(); }));
  qApp->setProperty(kUnattended, true);
  EXPECT_TRUE(window_->close());
  qApp->setProperty(kUnattended, false);
  const QStringList files = QDir(window_->bar().recordingFolder()).entryList({"unsaved-poses_*.csv"});
  ASSERT_EQ(files.size(), 1);
  QFile table(QDir(window_->bar().recordingFolder()).filePath(files[0]));
  ASSERT_TRUE(table.open(QIODevice::ReadOnly));
  EXPECT_EQ(table.readAll().trimmed().count('\n'), 1) << "a header and a pose";
}

TEST_F(RegistrationWindow, SaysWhenTheHistoryCannotBeKept) {
  const QByteArray broken = "registrations: 3\n";
  QFile history(file("registrations.yaml"));
  ASSERT_TRUE(history.open(QIODevice::WriteOnly) && history.write(broken) == broken.size());
  history.close();
  ASSERT_NO_FATAL_FAILURE(begin());
  HistoryPage& page = panel_->historyPage();
  EXPECT_TRUE(page.fault().contains("registrations.yaml")) << page.fault().toStdString();
  ASSERT_NO_FATAL_FAILURE(registerAtTheStop());
  press("Accept");
  EXPECT_TRUE(page.fault().contains("registrations.yaml")) << page.fault().toStdString();
  bool said = false;
  for (auto* bar : window_->findChildren<MessageBar*>())
    said = said || bar->message().contains("was not added to the history");
  EXPECT_TRUE(said);
  ASSERT_TRUE(history.open(QIODevice::ReadOnly));
  EXPECT_EQ(history.readAll(), broken) << "a file that cannot be read is left as it is";
}

}  // namespace
}  // namespace capstan::widgets
