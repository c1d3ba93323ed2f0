#include "core/recording/export.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/recording/recorder.h"
#include "core/recording/session_source.h"
#include "core/recording/sqlite.h"
#include "core/recording/table_source.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
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

TEST(Export, TheRobotsOwnKinematicsStaySuchInASession) {
  const TemporaryFolder folder;
  for (const bool own : {false, true}) {
    MeasuredTable table = someTable();
    table.own_kinematics = own;
    TableSource source(table, raven());
    importRecording(source, folder / "a.capstan", headerOf(source.info(), "2026-11-21"), nullptr,
                    Existing::kReplace);
    EXPECT_EQ(SessionSource(folder / "a.capstan").info().own_kinematics, own);
    EXPECT_TRUE(SessionSource(folder / "a.capstan").info().reference);
  }
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

  EXPECT_EQ(exportVideo(folder / "a.capstan", folder / "a.mkv").frames, 10);
  cv::VideoCapture video(folder / "a.mkv");
  cv::Mat frame;
  int frames = 0;
  for (; video.read(frame); ++frames) {
    ASSERT_EQ(frame.cols, 128);
    EXPECT_TRUE(sameBits(frame.colRange(0, 64).clone(), left[static_cast<std::size_t>(frames)])) << frames;
  }
  EXPECT_EQ(frames, 10);
  EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 15.0, 1e-3) << "9 intervals between 10 frames";
  for (const char* other : {"a.avi", "a.mp4"})
    EXPECT_EQ(exportVideo(folder / "a.capstan", folder / other).frames, 10) << other;
  EXPECT_THROW(exportVideo(folder / "a.capstan", folder / "a.xyz"), base::InputError);
}

/// While it lives, no file grows beyond `bytes`, as on a disk that is full.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit less{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, before_);
  }

 private:
  void (*before_)(int);
  rlimit limit_{};
};

TEST(Export, AFullDiskIsNoVideo) {
  const TemporaryFolder folder;
  base::Random random(3);
  {
    Recorder recorder(folder / "a.capstan", header());
    for (int i = 0; i < 20; ++i)
      recorder.offer(tracking::Sample(
          tracking::StereoFrame{i / 15.0, i / 15.0, noisyImage(random), noisyImage(random)}));
  }
  for (const char* name : {"a.mkv", "a.avi", "a.mp4"}) {
    base::writeTextFile(folder / name, "former");
    {
      const FileLimit limit(16 << 10);
      EXPECT_THROW(exportVideo(folder / "a.capstan", folder / name), base::InputError) << name;
    }
    EXPECT_EQ(std::filesystem::file_size(folder / name), 6U) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / ("a.part" + std::string(name + 1))));
  }
}

TEST(Export, JointsReadBetweenTwoRowsStandInTheNext) {
  const TemporaryFolder folder;
  const auto path = folder / "a.capstan";
  {
    Recorder recorder(path, header());
    for (int i = 0; i < 100; ++i) {
      const double t = i * 1e-3;
      recorder.offer(tracking::Sample(tracking::MotorSample{t, {double(i), 0, 0}, {0, 0, 0}, {0, 0, 0}}));
      if (i % 2 == 0)
        recorder.offer(tracking::Sample(tracking::JointSample{t + 0.4e-3, {double(i), 1.0, 2.0}}));
    }
  }
  const MeasuredTable table = sessionTable(path);
  ASSERT_EQ(table.rows(), 100U);
  ASSERT_EQ(table.q.size(), 3U);
  for (std::size_t row = 0; row < 100; ++row) {
    if (row % 2 == 1)
      EXPECT_EQ(table.q[0][row], static_cast<double>(row - 1)) << row;
    else
      EXPECT_TRUE(std::isnan(table.q[0][row])) << row << ": the same reading a second time";
  }
}

/// Frames of 64 × 48 px, then as many of 32 × 24.
std::filesystem::path twoSizes(const TemporaryFolder& folder) {
  base::Random random(2);
  Recorder recorder(folder / "a.capstan", header());
  for (int i = 0; i < 10; ++i) {
    const int width = i < 5 ? 64 : 32, height = i < 5 ? 48 : 24;
    EXPECT_TRUE(recorder.offer(tracking::Sample(tracking::StereoFrame{
        i / 15.0, i / 15.0, noisyImage(random, width, height), noisyImage(random, width, height)})));
  }
  return folder / "a.capstan";
}

TEST(Export, FramesOfAnotherSizeAreCounted) {
  const TemporaryFolder folder;
  const VideoReport report = exportVideo(twoSizes(folder), folder / "a.mkv");
  EXPECT_EQ(report.frames, 5);
  EXPECT_EQ(report.other_size, 5);
}

TEST(Export, ADamagedImageLeavesNoHalfVideo) {
  const TemporaryFolder folder;
  const auto path = twoSizes(folder);
  Database(path, Database::Mode::kReadWrite)
      .run("UPDATE frame SET \"left\" = x'00' WHERE seq = (SELECT max(seq) FROM frame)");
  try {
    exportVideo(path, folder / "a.mkv");
    ADD_FAILURE() << "a damaged image was taken";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().reason, "is damaged: row 10 of table frame is not as it was written");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.part.mkv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mkv"));
}

TEST(Export, AFolderInTheWayIsAnInputError) {
  const TemporaryFolder folder;
  const auto path = twoSizes(folder);
  std::filesystem::create_directory(folder / "taken.mkv");
  EXPECT_THROW(exportVideo(path, folder / "taken.mkv"), base::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "taken.part.mkv"));

  std::filesystem::create_directory(folder / "taken.capstan");
  TableSource source(someTable(), raven());
  const SessionHeader about = headerOf(source.info(), "2026-11-21");
  EXPECT_THROW(importRecording(source, folder / "taken.capstan", about, nullptr, Existing::kReplace),
               base::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "taken.capstan.part"));
}

/// Fails in the middle.
class BrokenSource : public tracking::Source {
 public:
  const tracking::SourceInfo& info() const override { return table_.info(); }
  bool next(tracking::Sample& out) override {
    if (++given_ > 100) throw base::InputError({"made", 0, {}, {}, "broke", "Mend it"});
    return table_.next(out);
  }
  void block(bool, bool) override {}

 private:
  TableSource table_{someTable(), raven()};
  int given_ = 0;
};

TEST(Export, AFormerSessionStaysUntilTheNewOneIsWhole) {
  const TemporaryFolder folder;
  const auto path = twoSizes(folder);
  BrokenSource broken;
  const SessionHeader about = headerOf(broken.info(), "2026-11-21");
  EXPECT_THROW(importRecording(broken, path, about, nullptr, Existing::kReplace), base::InputError);
  EXPECT_EQ(readSessionSummary(path).frames, 10);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));

  TableSource source(someTable(), raven());
  importRecording(source, path, about, nullptr, Existing::kReplace);
  EXPECT_EQ(readSessionSummary(path).motor, 300);
  EXPECT_EQ(readSessionSummary(path).frames, 0);
}

TEST(Export, TheLogOfAFormerSessionIsNotTakenForTheNewOnes) {
  const TemporaryFolder folder;
  const auto path = folder / "a.capstan";
  const auto killed = folder / "killed.capstan";
  Recorder recorder(path, header());
  recorder.offer(tracking::Sample(tracking::JointSample{1.0, {0, 0, 0}}));
  while (recorder.stats().written == 0) ASSERT_EQ(recorder.stats().state, RecorderState::kRecording);
  for (const char* suffix : {"", "-wal"})  // as a recorder that was killed leaves them
    std::filesystem::copy_file(path.string() + suffix, killed.string() + suffix);
  TableSource source(someTable(), raven());
  importRecording(source, killed, headerOf(source.info(), "2026-11-21"), nullptr, Existing::kReplace);
  EXPECT_FALSE(std::filesystem::exists(killed.string() + "-wal"));
  EXPECT_EQ(readSessionSummary(killed).motor, 300);
  EXPECT_EQ(formatMeasuredTable(sessionTable(killed)), formatMeasuredTable(someTable()));

  EXPECT_THROW(importRecording(source, path, header(), nullptr, Existing::kReplace), base::InputError)
      << "replaced a session that is being recorded";
}

TEST(Export, ProgressCountsFromTheFirstSample) {
  const TemporaryFolder folder;
  MeasuredTable table = someTable();
  table.q_m = TableColumns{std::vector<double>(300, 80.0), std::vector<double>(300, -86.0),
                           std::vector<double>(300, -480.0)};
  table.tau_m.clear();
  table.dq_m.clear();
  table.p_c.clear();
  for (double& t : table.t) t += 300.0;
  TableSource source(table, raven());
  EXPECT_EQ(source.info().begin, 300.0);
  EXPECT_NEAR(source.info().duration, 0.299, 1e-9);

  base::Progress importing;
  importRecording(source, folder / "a.capstan", headerOf(source.info(), "2026-11-21"), &importing);
  EXPECT_GT(importing.fraction(), 0.1);
  EXPECT_LT(importing.fraction(), 0.9) << "at the 256th of 450 samples";

  SessionSource back(folder / "a.capstan");
  EXPECT_EQ(back.info().begin, 300.0);
  EXPECT_NEAR(back.info().duration, 0.299, 1e-9);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(back.info());
  base::Progress tracking;
  tracking::trackAll(back, pipeline, &tracking, back.info().duration);
  EXPECT_NEAR(tracking.fraction(), importing.fraction(), 0.01);
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
}  // namespace capstan::recording
