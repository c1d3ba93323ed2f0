/// Runs the real capstan-monitor under Xvfb with Mesa's software renderer.
#pragma once

#include <opencv2/imgcodecs.hpp>

#include "tests/app/cli_fixture.h"

namespace capstan::testing {

class MonitorProgram : public Cli {
 protected:
  const std::string monitor_ = test::monitorProgram();
  const std::string feed_ = "monitor-" + std::to_string(getpid());

  /// Runs lines of a shell script on a display of its own: $monitor, $session and $feed are set.
  Ran onDisplay(const std::string& script) const {
    write("script.sh", "monitor='" + monitor_ + "'\nsession='" + test::monitorSession() + "'\ncli='" +
                           test::commandLineProgram() + "'\nfeed='" + feed_ + "'\n" + script + "\n");
    return runShell("cd " + folder_.string() +
                    " && xvfb-run -a -s '-screen 0 1280x720x24 -noreset' sh script.sh");
  }
  json report(const std::string& name) const {
    EXPECT_TRUE(fs::exists(path(name))) << name << ": " << textOf("stderr.txt");
    return fs::exists(path(name)) ? json::parse(textOf(name)) : json::object();
  }
  cv::Mat picture(const std::string& name) const {
    const cv::Mat picture = cv::imread(path(name), cv::IMREAD_COLOR);
    EXPECT_EQ(picture.size(), cv::Size(1280, 720)) << name;
    return picture;
  }
};

}  // namespace capstan::testing
