#include "core/session/export.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/session/recorder.h"
#include "core/session/session_source.h"
#include "core/session/table_source.h"
#include "tests/core/session/session_samples.h"

namespace capstan::session {
namespace {

using namespace testing;

MeasuredTable someTable() {
  base::Random random(1);
  MeasuredTable table;
  table.file = "made.csv";
  const auto fill = [&](TableColumns& columns, int every) {
    columns.assign(3, std::vector<double>(300, kNaN));
    for (auto& column : columns)
      for (std::size_t row = 0; row < 300; row += static_cast<std::size_t>(every))
        column[row] = random.normal();
  };
  for (int row = 0; row < 300; ++row) table.t.push_back(row * 1e-3);
  fill(table.q_m, 1);
  fill(table.dq_m, 1);
  fill(table.tau_m, 1);
  fill(table.q, 2);
  fill(table.p_c, 66);
  return table;
}

TEST(Export, TableToSessionAndBackIsTheSameTable) {
  const TemporaryFolder folder;
  const MeasuredTable table = someTable();
  TableSource source(table, raven());
  importRecording(source, folder / "a.capstan", headerOf(source.info(), "2026-11-21"));
  EXPECT_EQ(formatMeasuredTable(sessionTable(folder / "a.capstan")), formatMeasuredTable(table));
  EXPECT_THROW(importRecording(source, folder / "a.capstan", header()), base::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.capstan.part"));
}

TEST(Export, CsvHasEveryTableAndEveryRow) {
  const TemporaryFolder folder;
  TableSource source(someTable(), raven());
  importRecording(source, folder / "a.capstan", headerOf(source.info(), "2026-11-21"));
  const auto files = exportCsv(folder / "a.capstan", folder / "csv");
  EXPECT_EQ(files.size(), 9U);
  const std::string motor = base::readTextFile(folder / "csv/motor.csv");
  EXPECT_EQ(std::count(motor.begin(), motor.end(), '\n'), 301);
  EXPECT_EQ(motor.substr(0, motor.find('\n')), "seq,t,q_m1,q_m2,q_m3,dq_m1,dq_m2,dq_m3,tau_m1,tau_m2,tau_m3");
  EXPECT_NE(base::readTextFile(folder / "csv/dictionary.csv").find("motor,q_m1,rad,"), std::string::npos);
}

TEST(Export, PicturesAreThePixelsAndVideoHasEveryFrame) {
  const TemporaryFolder folder;
  base::Random random(1);
  std::vector<cv::Mat> left;
  {
    RecorderOptions options;
    options.width = 64;
    options.height = 48;
    Recorder recorder(folder / "a.capstan", header(), options);
    for (int i = 0; i < 10; ++i) {
      left.push_back(noisyImage(random));
      const cv::Mat right = i == 3 ? cv::Mat() : noisyImage(random);
      ASSERT_TRUE(
          recorder.offer(tracking::Sample(tracking::StereoFrame{i / 15.0, i / 15.0, left.back(), right})));
    }
  }
  EXPECT_EQ(exportPng(folder / "a.capstan", folder / "png"), 19);
  EXPECT_TRUE(sameBits(cv::imread(folder / "png/left_000004.png"), left[3]));
  EXPECT_FALSE(std::filesystem::exists(folder / "png/right_000004.png"));

  EXPECT_EQ(exportVideo(folder / "a.capstan", folder / "a.mkv"), 10);
  cv::VideoCapture video(folder / "a.mkv");
  cv::Mat frame;
  int frames = 0;
  for (; video.read(frame); ++frames) EXPECT_EQ(frame.cols, 128);
  EXPECT_EQ(frames, 10);
  EXPECT_THROW(exportVideo(folder / "a.capstan", folder / "a.xyz"), base::InputError);
}

TEST(Export, CancelledLeavesNothing) {
  const TemporaryFolder folder;
  TableSource source(someTable(), raven());
  base::Progress progress;
  progress.cancel();
  importRecording(source, folder / "a.capstan", headerOf(source.info(), "2026-11-21"), &progress);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace capstan::session
