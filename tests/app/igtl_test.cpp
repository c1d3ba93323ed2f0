// Tip and registration as OpenIGTLink messages, read by a client of the library that 3D Slicer uses.
#include <igtlClientSocket.h>
#include <igtlTransformMessage.h>

#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <thread>

#include "core/robot/arm_kinematics.h"
#include "core/vision/registration_file.h"
#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

using namespace std::chrono_literals;

struct Received {
  std::string device;
  double time = 0.0;                                       ///< since 1970 [s]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< [m]
};

/// 3D Slicer's side of the connection.
class Client {
 public:
  /// Connects as soon as somebody listens.
  explicit Client(int port) : socket_(igtl::ClientSocket::New()) {
    for (int k = 0; k < 1000 && !connected_; ++k) {
      connected_ = socket_->ConnectToServer("127.0.0.1", port) == 0;
      if (!connected_) std::this_thread::sleep_for(10ms);
    }
  }
  bool connected() const { return connected_; }

  /// The next message; nothing at the end of the connection, or for one that the library does not accept.
  std::optional<Received> next() {
    auto header = igtl::MessageHeader::New();
    header->InitPack();
    if (!receive(*header)) return {};
    EXPECT_TRUE(header->Unpack() & igtl::MessageHeader::UNPACK_HEADER);
    EXPECT_STREQ(header->GetDeviceType(), "TRANSFORM");
    auto message = igtl::TransformMessage::New();
    message->SetMessageHeader(header);
    message->AllocatePack();
    socket_->Receive(message->GetPackBodyPointer(), message->GetPackBodySize());
    constexpr int kCheckTheChecksum = 1;
    EXPECT_TRUE(message->Unpack(kCheckTheChecksum) & igtl::MessageHeader::UNPACK_BODY);
    igtl::Matrix4x4 matrix;
    message->GetMatrix(matrix);
    unsigned seconds = 0, fraction = 0;
    message->GetTimeStamp(&seconds, &fraction);
    Received received{header->GetDeviceName(), seconds + fraction / 0x1p32};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        received.pose.matrix()(row, column) = matrix[row][column] * (column == 3 ? 1e-3 : 1.0);
    return received;
  }

 private:
  bool receive(igtl::MessageHeader& header) {
    return socket_->Receive(header.GetPackPointer(), header.GetPackSize()) == header.GetPackSize();
  }

  igtl::ClientSocket::Pointer socket_;
  bool connected_ = false;
};

class Igtl : public Cli {
 protected:
  const int port_ = 20000 + getpid() % 20000;
  const std::string publish_ = " --publish igtl://127.0.0.1:" + std::to_string(port_);
};

/// The client is connected before the first row: its first message is that of the first estimate.
TEST_F(Igtl, TheTipIsThatOfTheEstimates) {
  ASSERT_EQ(run("simulate --no-images --duration 4 --out " + path("trial.capstan")).exit, 0);
  ASSERT_EQ(run("convert " + path("trial.capstan") + " " + path("trial.csv")).exit, 0);
  runShell("mkfifo " + path("rows.fifo"));
  std::thread program([&] {
    const Ran ran = run("track --live " + path("rows.fifo") + " --duration 3.9 --out " + path("live.csv") +
                        publish_ + " >/dev/null");
    EXPECT_EQ(ran.exit, 0) << ran.err;
  });
  Client slicer(port_);
  ASSERT_TRUE(slicer.connected());
  std::thread robot([&] { std::ofstream(path("rows.fifo")) << textOf("trial.csv") << std::flush; });
  std::vector<Received> tips;
  while (const auto received = slicer.next()) {
    EXPECT_EQ(received->device, "TipToBase") << "there are no cameras";
    tips.push_back(*received);
  }
  robot.join(), program.join();
  ASSERT_GT(tips.size(), 200U) << "60 a second";
  EXPECT_LT(tips.size(), 240U);
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_NEAR(tips.front().time, now, 60.0);

  std::map<long, Eigen::Vector3d> estimates;  // by the time since the first one [ms]
  std::istringstream rows(textOf("live.csv"));
  std::string line, cell;
  std::getline(rows, line);
  std::map<std::string, std::size_t> column;
  std::istringstream names(line);
  while (std::getline(names, cell, ',')) column.emplace(cell, column.size());
  double begin = std::nan("");
  while (std::getline(rows, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    while (std::getline(row, cell, ',')) cells.push_back(cell);
    const double t = std::stod(cells[column.at("t")]);
    if (std::isnan(begin)) begin = t;
    Eigen::Vector3d q;
    for (int k = 0; k < 3; ++k) q(k) = std::stod(cells[column.at("q_ukf" + std::to_string(k + 1))]);
    if (cells[column.at("camera")] == "0") estimates[std::lround(1e3 * (t - begin))] = q;
  }
  const robot::ArmKinematics arm(robot::readDescriptionOrDefault({}));
  for (const Received& tip : tips) {
    const auto found = estimates.find(std::lround(1e3 * (tip.time - tips.front().time)));
    ASSERT_NE(found, estimates.end());
    EXPECT_LT((tip.pose.translation() - arm.tip(found->second)).norm(), 1e-6) << "a micrometre";
    EXPECT_LT((tip.pose.linear() - arm.frame(3, found->second).linear()).norm(), 1e-5);
  }
}

TEST_F(Igtl, TheRegistrationComesToo) {
  std::thread program([&] {
    const Ran ran = run("track --simulate --duration 10 --save-registration " + path("registration.yaml") +
                        publish_ + " >/dev/null");
    EXPECT_EQ(ran.exit, 0) << ran.err;
  });
  Client slicer(port_);
  std::map<std::string, int> count;
  Received camera;
  while (const auto received = slicer.next()) {
    ++count[received->device];
    if (received->device == "CameraToBase") camera = *received;
  }
  program.join();
  EXPECT_GT(count["TipToBase"], 10);
  EXPECT_NEAR(count["CameraToBase"], count["TipToBase"], 1);
  const Eigen::Isometry3d registration = vision::readRegistration(path("registration.yaml"));
  EXPECT_LT((camera.pose.matrix() - registration.matrix()).norm(), 1e-6);
}

TEST_F(Igtl, BadAddressesAreRefused) {
  for (const char* wrong : {"igtl://slicer:18944", "igtl://127.0.0.1", "igtl://127.0.0.1:x"}) {
    const Ran ran = run(std::string("track --simulate --no-images --duration 1 --publish ") + wrong);
    EXPECT_EQ(ran.exit, 2) << wrong;
    EXPECT_NE(ran.err.find("--publish"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("igtl://127.0.0.1:18944"), std::string::npos) << ran.err;
  }
}

}  // namespace
}  // namespace capstan::testing
