// A Source of your own: reads lines from standard input, for example from a robot's logger through a pipe.
//   logger | own_source ROBOT.yaml
// A line is "m t q1 q2 q3" (motor positions; s, rad) or "c t x y z" (tip from the cameras in frame 0; s, m).
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

#include "core/base/error.h"
#include "core/robot/description.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

using namespace capstan;

class LineSource : public tracking::Source {
 public:
  LineSource(std::istream& lines, robot::Description robot) : lines_(lines) {
    info_.title = "standard input";
    info_.robot = std::move(robot);
  }
  const tracking::SourceInfo& info() const override { return info_; }

  bool next(tracking::Sample& out) override {
    std::string line;
    if (!std::getline(lines_, line)) return false;
    ++number_;
    std::istringstream words(line);
    char kind = 0;
    double t = 0.0;
    Eigen::Vector3d value;
    if (!(words >> kind >> t >> value[0] >> value[1] >> value[2]) || (kind != 'm' && kind != 'c'))
      throw base::InputError({"standard input", number_, "line", line, "is no sample",
                              "Write \"m t q1 q2 q3\" or \"c t x y z\""});
    const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    if (kind == 'm')
      out = tracking::MotorSample{t, value, none, none};  // without velocity and torque
    else
      out = tracking::TipSample{t, t, blocked_ ? none : value};  // the sample arrives at its exposure
    return true;
  }
  void block(bool left, bool right) override { blocked_ = left || right; }

 private:
  std::istream& lines_;
  tracking::SourceInfo info_;
  std::size_t number_ = 0;
  bool blocked_ = false;
};

int main(int count, char** arguments) {
  if (count != 2) return std::cerr << "usage: own_source ROBOT.yaml\n", 2;
  try {
    LineSource source(std::cin, robot::readDescription(arguments[1]));
    tracking::TrackingPipeline pipeline = tracking::makePipeline(source.info());
    Eigen::Vector3d newest = Eigen::Vector3d::Zero();
    const auto report = tracking::trackAll(
        source, pipeline, nullptr, 0.0,
        [&](const tracking::Sample&, const tracking::Snapshot& now) { newest = now.q_link_ukf; });
    std::cout << report.motor_samples << " motor samples, " << report.camera_samples
              << " tips, at the end q = " << newest.transpose() << '\n';
    return 0;
  } catch (const base::InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
