// A program whose rows cannot be used, in a real window: the whole reason with the remedy is there.
#include "core/live/streams/tcp_sender.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"

namespace capstan::widgets {
namespace {

/// 60 rows of an arm at rest, in degrees or in radians.
std::string rowsIn(double unit) {
  std::string text = "t,q_m1,q_m2,q_m3\n";
  for (int k = 0; k < 60; ++k)
    text += std::to_string(1e-3 * k) + "," + std::to_string(80.0 / unit) + "," +
            std::to_string(-90.0 / unit) + "," + std::to_string(-480.0 / unit) + "\n";
  return text;
}

TEST_F(Shell, ARefusedProgramIsSaidWithItsRemedyUntilRowsCome) {
  const auto window = makeWindow();
  const std::string at =
      "tcp://127.0.0.1:" + std::to_string(20000 + QCoreApplication::applicationPid() % 20000);
  window->open(SourceChoice::ofLive(QString::fromStdString(at)));
  ASSERT_TRUE(opened(*window));
  const auto send = [&](const std::string& rows) {
    auto program = std::make_unique<live::TcpSender>(live::parseAddress(at, "to"));
    program->send(rows);
    return program;
  };
  constexpr double kDegree = 3.14159265358979 / 180.0;
  const auto wrong = send(rowsIn(kDegree));
  ASSERT_TRUE(waitFor([&] { return !window->message().isEmpty(); }));
  EXPECT_TRUE(window->message().contains("motors refused")) << window->message().toStdString();
  EXPECT_TRUE(window->message().contains("live set-up: read_as: q_m=deg")) << window->message().toStdString();
  test::grab(*window, "motors_refused");
  const auto right = send(rowsIn(1.0));
  int k = 60;
  EXPECT_TRUE(waitFor([&] {
    right->send(std::to_string(1e-3 * k++) + ",80,-90,-480\n");
    return window->message().isEmpty();
  })) << window->message().toStdString();
  QTest::qWait(700);  // the motors are silent: nothing more was refused
  EXPECT_EQ(window->message(), "");
}

}  // namespace
}  // namespace capstan::widgets
