// The dialog that connects to a live robot: what it writes, reads back, previews and connects to.
#include "widgets/shell/live_dialog.h"

#include <httplib.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <opencv2/videoio.hpp>
#include <thread>

#include "core/live/cameras/image_server.h"
#include "core/live/streams/tcp_sender.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/figures/theme.h"
#include "widgets/panels/notes/notes_panel.h"

namespace capstan::widgets {
namespace {

class LiveDialogTest : public Shell {
 protected:
  template <class Widget>
  Widget& of(const char* name) {
    auto* found = dialog_.findChild<Widget*>(name);
    EXPECT_TRUE(found) << name;
    return *found;
  }
  QString textOf(const char* name) { return of<QLabel>(name).text(); }
  /// A port that was free a moment ago.
  static std::string freePort() { return std::to_string(live::ImageServer("127.0.0.1", 0).port()); }

  /// Sends a row, with a new connection where there is none: the preview may have begun again.
  static void sendRow(std::unique_ptr<live::TcpSender>& sender, const std::string& to, const QString& row) {
    try {
      if (!sender) {
        sender = std::make_unique<live::TcpSender>(live::parseAddress(to, "from"));
        sender->send("t,q_m1,q_m2,q_m3\n");
      }
      if (!sender->send(row.toStdString())) sender.reset();
    } catch (const base::InputError&) {  // it does not listen yet
    }
  }

  static live::LiveSetup everyField() {
    live::LiveSetup setup{
        .title = "our robot", .robot = {}, .motors = {}, .cameras = live::CamerasSetup{}, .commands = {}};
    setup.motors = {.from = "tcp://127.0.0.1:5556",
                    .read_as = "q_m=deg",
                    .encoders = "/arm/encoders",
                    .names = {"a", "b", "c"},
                    .zero = {0.1, 0.0, -0.2},
                    .arm = 2,
                    .motors = {2, 1, 3},
                    .signs = {1.0, -1.0, 1.0},
                    .reference = false};
    setup.cameras->left = "/dev/video8", setup.cameras->right = "/dev/video9";
    setup.cameras->calibration = "/somewhere", setup.cameras->registration = "/somewhere/registration.yaml";
    setup.cameras->marker = "/somewhere/marker.yaml";
    setup.cameras->latency = 0.03, setup.cameras->pairing = 0.005, setup.cameras->rate = 30.0;
    setup.cameras->width = 1280, setup.cameras->height = 720;
    setup.cameras->exposure = 150.0;
    return setup;
  }

  LiveDialog dialog_;
};

TEST_F(LiveDialogTest, ShowsAndSavesEveryField) {
  dialog_.setSetup(everyField());
  EXPECT_EQ(dialog_.setup(), everyField()) << "fields without a widget are kept, too";
  ASSERT_TRUE(dialog_.saveFile(file("robot.yaml")));
  EXPECT_EQ(live::readLiveSetup(file("robot.yaml").toStdString()), everyField());
  LiveDialog other;
  other.openFile(file("robot.yaml"));
  EXPECT_EQ(other.setup(), everyField());
}

TEST_F(LiveDialogTest, RefusesASetupWithItsFieldAndRemedy) {
  auto setup = everyField();
  setup.motors.motors = {1, 1, 3};
  dialog_.setSetup(setup);
  dialog_.show();
  EXPECT_FALSE(dialog_.saveFile(file("robot.yaml")));
  EXPECT_TRUE(textOf("message").contains("motors.motors")) << textOf("message").toStdString();
  EXPECT_FALSE(QFile::exists(file("robot.yaml")));
  dialog_.openFile(file("missing.yaml"));
  EXPECT_TRUE(textOf("message").contains("missing.yaml")) << textOf("message").toStdString();
}

TEST_F(LiveDialogTest, AnAddressAloneNeedsNoFile) {
  QSignalSpy chosen(&dialog_, &LiveDialog::chosen);
  dialog_.show();
  of<QComboBox>("from").setEditText("tcp://127.0.0.1:5559");
  of<QPushButton>("connect").click();
  ASSERT_EQ(chosen.size(), 1);
  EXPECT_EQ(chosen[0][0].toString(), "tcp://127.0.0.1:5559");
  EXPECT_FALSE(dialog_.isVisible());
}

TEST_F(LiveDialogTest, AFileThatIsUnchangedIsConnectedTo) {
  dialog_.setSetup(everyField());
  ASSERT_TRUE(dialog_.saveFile(file("robot.yaml")));
  QSignalSpy chosen(&dialog_, &LiveDialog::chosen);
  of<QPushButton>("connect").click();
  ASSERT_EQ(chosen.size(), 1);
  EXPECT_EQ(chosen[0][0].toString(), file("robot.yaml"));
}

/// Rows of a robot whose second motor moves, and two cameras that are served over HTTP.
TEST_F(LiveDialogTest, PreviewsImagesAndMotorsThatMove) {
  live::ImageServer cameras("127.0.0.1", 0);
  const std::string video = "http://127.0.0.1:" + std::to_string(cameras.port());
  live::LiveSetup setup{
      .title = "robot", .robot = {}, .motors = {}, .cameras = live::CamerasSetup{}, .commands = {}};
  setup.motors.from = "tcp://127.0.0.1:" + freePort();
  setup.motors.motors = {2, 1, 3};
  setup.cameras->left = video + "/left", setup.cameras->right = video + "/right";
  applyTheme(*qApp, Theme::dark());
  dialog_.setSetup(setup);
  dialog_.show();
  std::atomic<bool> quit = false;
  std::thread robot([&] {
    std::unique_ptr<live::TcpSender> sender;
    for (int k = 0; !quit; ++k) {
      const int noise = k % 40;  // without it the cameras are frozen
      cameras.publish({480, 640, CV_8UC3, cv::Scalar(noise, 0, 200)},
                      {480, 640, CV_8UC3, cv::Scalar(200, 0, noise)});
      sendRow(sender, setup.motors.from, QString("%1,0.5,%2,0.1\n").arg(k * 0.01).arg(std::sin(k * 0.05)));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  of<QPushButton>("preview").click();
  EXPECT_TRUE(waitFor([&] {
    return textOf("preview_motor_1").contains("is moving") &&
           of<QLabel>("preview_left").pixmap(Qt::ReturnByValue).width() > 0;
  })) << textOf("preview_motor_1").toStdString()
      << textOf("preview_sides").toStdString();
  EXPECT_TRUE(textOf("preview_motor_2").contains("is at rest")) << textOf("preview_motor_2").toStdString();
  EXPECT_TRUE(textOf("preview_motor_2").contains("28.65"))
      << "0.5 rad: " << textOf("preview_motor_2").toStdString();
  EXPECT_TRUE(textOf("preview_motor_3").contains(" mm, motor at 5.73°"))
      << "the third joint is linear: " << textOf("preview_motor_3").toStdString();
  const QColor left = of<QLabel>("preview_left").pixmap(Qt::ReturnByValue).toImage().pixelColor(100, 100),
               right = of<QLabel>("preview_right").pixmap(Qt::ReturnByValue).toImage().pixelColor(100, 100);
  EXPECT_GT(left.red(), left.blue() + 100);
  EXPECT_GT(right.blue(), right.red() + 100);
  test::grab(dialog_, "live_dialog");
  of<QPushButton>("preview").click();
  EXPECT_TRUE(textOf("preview_sides").isEmpty());
  quit = true;
  robot.join();
}

/// A path that is written in the form means the same in the preview, in the file and in the session.
TEST_F(LiveDialogTest, RelativePathsAreThoseBesideTheFile) {
  ASSERT_TRUE(QDir(folder_.path()).mkdir("cameras"));
  for (const char* eye : {"left.yaml", "right.yaml"})
    ASSERT_TRUE(QFile::copy(QString::fromStdString(test::resourceFile("cameras").string()) + "/" + eye,
                            file("cameras/") + eye));
  live::LiveSetup setup{
      .title = "robot", .robot = {}, .motors = {}, .cameras = live::CamerasSetup{}, .commands = {}};
  setup.motors.from = "tcp://127.0.0.1:" + freePort();
  setup.cameras->left = "both.mkv", setup.cameras->layout = live::CameraLayout::kSideBySide;
  setup.cameras->calibration = "cameras";
  cv::VideoWriter video(file("both.mkv").toStdString(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0,
                        cv::Size(1280, 480));
  for (int k = 0; k < 100; ++k) video.write(cv::Mat(480, 1280, CV_8UC3, cv::Scalar(2 * k, 0, 200)));
  video.release();
  dialog_.setSetup(setup);
  ASSERT_TRUE(dialog_.saveFile(file("robot.yaml")));
  dialog_.show();
  of<QPushButton>("preview").click();
  EXPECT_TRUE(waitFor([&] { return of<QLabel>("preview_left").pixmap(Qt::ReturnByValue).width() > 0; }))
      << textOf("preview_sides").toStdString();
  QSignalSpy chosen(&dialog_, &LiveDialog::chosen);
  of<QPushButton>("connect").click();
  ASSERT_EQ(chosen.size(), 1) << "the file says the same: it need not be saved again";
  EXPECT_EQ(chosen[0][0].toString(), file("robot.yaml"));
}

/// A master that answers as that of ROS, on this computer's own port.
TEST_F(LiveDialogTest, TopicsOfARosMasterAreOffered) {
  httplib::Server master;
  std::atomic<bool> slow = false, motors_ended = false;
  master.Post("/RPC2", [&](const httplib::Request& request, httplib::Response& response) {
    if (slow) std::this_thread::sleep_for(std::chrono::seconds(2));
    const std::string motors = motors_ended ? "/rosout_agg" : "/arm/actuators/measured_js";
    EXPECT_NE(request.body.find("getPublishedTopics"), std::string::npos);
    response.set_content(
        "<?xml version='1.0'?>\n<methodResponse>\n<params>\n<param>\n<value><array><data>\n"
        "<value><int>1</int></value>\n<value><string>current topics</string></value>\n<value><array><data>\n"
        "<value><array><data>\n<value><string>" +
            motors +
            "</string></value>\n"
            "<value><string>sensor_msgs/JointState</string></value>\n</data></array></value>\n"
            "<value><array><data>\n<value>/stereo/left/image_raw</value>\n<value>sensor_msgs/Image</value>\n"
            "</data></array></value>\n<value><array><data>\n<value><string>/rosout</string></value>\n"
            "<value><string>rosgraph_msgs/Log</string></value>\n</data></array></value>\n"
            "</data></array></value>\n</data></array></value>\n</param>\n</params>\n</methodResponse>\n",
        "text/xml");
  });
  const int port = master.bind_to_any_port("127.0.0.1");
  std::thread serving([&] { master.listen_after_bind(); });
  qputenv("ROS_MASTER_URI", QString("http://127.0.0.1:%1/").arg(port).toUtf8());
  dialog_.setSetup(everyField());
  dialog_.show();
  EXPECT_TRUE(waitFor([&] { return textOf("ros_master").contains("3 topic"); }))
      << textOf("ros_master").toStdString();
  const auto offers = [&](const char* list, const char* topic) {
    return of<QComboBox>(list).findData(QString("ros:") + topic) >= 0;
  };
  EXPECT_TRUE(offers("from", "/arm/actuators/measured_js"));
  EXPECT_FALSE(offers("from", "/stereo/left/image_raw"));
  EXPECT_FALSE(offers("from", "/rosout"));
  for (const char* eye : {"left", "right"}) {
    EXPECT_TRUE(offers(eye, "/stereo/left/image_raw"));
    EXPECT_FALSE(offers(eye, "/arm/actuators/measured_js"));
  }
  EXPECT_EQ(dialog_.setup(), everyField()) << "what was written is still there";
  auto& from = of<QComboBox>("from");
  from.setCurrentIndex(from.findData("ros:/arm/actuators/measured_js"));
  EXPECT_EQ(dialog_.setup().motors.from, "ros:/arm/actuators/measured_js");

  motors_ended = true;
  EXPECT_TRUE(waitFor([&] { return !offers("from", "/arm/actuators/measured_js"); }));
  EXPECT_EQ(dialog_.setup().motors.from, "ros:/arm/actuators/measured_js") << "it may come back";

  // A master that does not answer, and none at all: the window goes on meanwhile.
  slow = true;
  dialog_.hide();
  QElapsedTimer spent;
  spent.start();
  dialog_.show();
  EXPECT_LT(spent.elapsed(), 500);
  EXPECT_TRUE(waitFor([&] { return textOf("ros_master").contains("no ROS master"); }));
  master.stop();
  serving.join();
  qunsetenv("ROS_MASTER_URI");
}

/// The preview is where a wrong sign is to be seen, so it shows what it cannot be.
TEST_F(LiveDialogTest, PreviewShowsMotorsThatCountTheOtherWayAndFollowsTheForm) {
  live::LiveSetup setup{.title = "robot", .robot = {}, .motors = {}, .cameras = {}, .commands = {}};
  setup.motors.from = "tcp://127.0.0.1:" + freePort();
  setup.motors.signs = {-1.0, 1.0, 1.0};
  dialog_.setSetup(setup);
  dialog_.show();
  std::atomic<bool> quit = false;
  std::thread robot([&] {
    std::unique_ptr<live::TcpSender> sender;
    for (int k = 0; !quit; ++k) {
      sendRow(sender, setup.motors.from, QString("%1,80,-90,-480\n").arg(k * 0.01));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  of<QPushButton>("preview").click();
  EXPECT_TRUE(waitFor([&] { return textOf("preview_motor_1").contains("motor at -4583.66°"); }))
      << textOf("preview_motor_1").toStdString();
  EXPECT_TRUE(waitFor([&] { return textOf("preview_sides").contains("has left its limits"); }))
      << textOf("preview_sides").toStdString();
  of<QCheckBox>("reversed_1").setChecked(false);
  EXPECT_TRUE(waitFor([&] { return textOf("preview_motor_1").contains("motor at 4583.66°"); }))
      << textOf("preview_motor_1").toStdString() << textOf("preview_sides").toStdString();
  EXPECT_FALSE(textOf("preview_sides").contains("has left its limits"));
  of<QSpinBox>("motor_1").setValue(2);
  EXPECT_TRUE(waitFor([&] { return textOf("preview_sides").contains("motors.motors"); }))
      << "motor 2 twice: " << textOf("preview_sides").toStdString();
  of<QSpinBox>("motor_1").setValue(1);
  EXPECT_TRUE(waitFor([&] { return textOf("preview_motor_1").contains("motor at 4583.66°"); }));
  of<QLineEdit>("title").setText("another name");
  QTest::qWait(1500);
  EXPECT_TRUE(textOf("preview_motor_1").contains("motor at 4583.66°")) << "a title changes nothing in it";
  EXPECT_TRUE(textOf("preview_sides").contains("1 connection;")) << textOf("preview_sides").toStdString();
  quit = true;
  robot.join();
}

TEST_F(LiveDialogTest, PreviewSaysWhyASideCannotBeOpened) {
  live::LiveSetup setup{
      .title = "robot", .robot = {}, .motors = {}, .cameras = live::CamerasSetup{}, .commands = {}};
  setup.motors.from = "tcp://127.0.0.1:" + freePort();
  setup.cameras->left = "/dev/video97", setup.cameras->right = "/dev/video98";
  dialog_.setSetup(setup);
  dialog_.show();
  of<QPushButton>("preview").click();
  EXPECT_TRUE(waitFor([&] { return textOf("preview_sides").contains("/dev/video97: cannot be opened"); }));
  EXPECT_TRUE(textOf("preview_sides").contains("motors waiting"))
      << "the other side is open: " << textOf("preview_sides").toStdString();
}

TEST_F(Shell, TheDialogConnectsTheWindow) {
  auto window = makeWindow();
  auto* dialog = window->findChild<LiveDialog*>();
  ASSERT_TRUE(dialog);
  window->findChild<QAction*>("live")->trigger();
  EXPECT_TRUE(dialog->isVisible());
  const std::string port = std::to_string(live::ImageServer("127.0.0.1", 0).port());
  dialog->findChild<QComboBox*>("from")->setEditText(QString::fromStdString("tcp://127.0.0.1:" + port));
  dialog->findChild<QPushButton*>("connect")->click();
  EXPECT_TRUE(waitFor([&] { return window->windowTitle().contains("live"); }))
      << window->windowTitle().toStdString();
}

TEST_F(Shell, ALiveSessionIsInTheDialogAndItsChangesAreInTheNotes) {
  auto window = makeWindow();
  const std::string address = "tcp://127.0.0.1:" + std::to_string(live::ImageServer("127.0.0.1", 0).port());
  window->open(SourceChoice::ofLive(QString::fromStdString(address)));
  ASSERT_TRUE(opened(*window));
  auto* dialog = window->findChild<LiveDialog*>();
  EXPECT_EQ(dialog->setup().motors.from, address);
  auto& notes = *window->findChild<NotesPanel*>();
  const auto noted = [&](const char* what) {
    return waitFor([&] {
      for (int k = 0; k < notes.rows(); ++k)
        if (notes.row(k).contains(what)) return true;
      return false;
    });
  };
  {
    live::TcpSender robot(live::parseAddress(address, "from"));
    robot.send("t,q_m1,q_m2,q_m3\n");
    for (int k = 0; k < 500; ++k) robot.send(QString("%1,0.5,0.2,0.1\n").arg(k * 0.01).toStdString());
    EXPECT_TRUE(noted("motors receiving")) << statusOf(*window).toStdString();
  }
  EXPECT_TRUE(noted("motors: waiting at")) << notes.row(notes.rows() - 1).toStdString();
}

}  // namespace
}  // namespace capstan::widgets
