#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <fstream>
#include <regex>
#include <set>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "tests/widgets/figures/figure_samples.h"
#include "widgets/figures/export_all.h"
#include "widgets/figures/index_page.h"

namespace capstan::widgets {
namespace {

namespace fs = std::filesystem;

experiments::TrialResult trialSample(const std::string& name, double occlusion) {
  experiments::TrialResult trial;
  trial.name = name;
  trial.reference = true;
  trial.occlusion.percentage = occlusion;
  for (const TrajectorySample& s : trajectorySample(40.0).samples) {
    experiments::TrajectoryPoint point;
    point.t = s.t;
    point.q_true = s.q_true;
    point.q_kin = s.q_kin;
    point.q_cam = s.q_cam;
    point.q_ukf = s.q_ukf;
    point.sigma = s.sigma;
    point.occluded = s.occluded;
    trial.trajectory.push_back(point);
    experiments::ErrorPoint error;
    error.t = s.t;
    error.kinematic = s.q_kin - s.q_true;
    error.identified = error.kinematic;
    error.ukf = s.q_ukf - s.q_true;
    trial.errors.push_back(error);
  }
  trial.end = trial.trajectory.back().t;
  for (auto& rms : trial.rms) rms.setConstant(0.01);
  trial.counts.fill(trial.errors.size());
  return trial;
}

experiments::Results trialsSample(const std::string& name, std::vector<double> occlusion) {
  experiments::Results results;
  results.name = name;
  results.title = "Errors <of> some & trials";
  results.work = experiments::Work::kTrack;
  for (std::size_t i = 0; i < occlusion.size(); ++i)
    results.trials.push_back(trialSample("trial " + std::to_string(i + 1), occlusion[i]));
  return results;
}

std::vector<std::string> namesIn(const experiments::Results& results) {
  std::vector<std::string> names;
  for (const ExperimentFigure& figure : figuresOf(results)) names.push_back(figure.name);
  return names;
}

class ExportAll : public testing::Test {
 protected:
  fs::path at(const char* name) const { return folder_.filePath(name).toStdString(); }
  QTemporaryDir folder_;
  const std::vector<experiments::Results> results_ = {trialsSample("C", {0.0, 0.0})};
  const ExportOptions small_ = {.size = {60.0, 60.0}};
};

TEST_F(ExportAll, ResultsHaveThePapersFigures) {
  EXPECT_EQ(namesIn(results_[0]),
            (std::vector<std::string>{"C-trajectory-trial-1", "C-detail-trial-1", "C-histogram-trial-1",
                                      "C-trajectory-trial-2", "C-histogram-trial-2", "C-boxplot-joint-1",
                                      "C-boxplot-joint-2", "C-boxplot-joint-3"}));
  const auto occluded = namesIn(trialsSample("D", {10.0, 80.0}));
  EXPECT_EQ(occluded.back(), "D-boxplot-occlusion");
  const auto results = trialsSample("D", {10.0, 80.0});
  const auto boxes = figuresOf(results).back().make();
  const auto& group = dynamic_cast<BoxplotFigure&>(*boxes).data().panels[2].groups[1];
  EXPECT_EQ(group.label, "80");
  ASSERT_EQ(group.boxes.size(), 1U) << "the UKF alone, as in the paper";
  EXPECT_GE(group.boxes[0].statistics.lower_whisker, 0.0);
  experiments::Results identified;
  identified.name = "B";
  identified.identification.emplace();
  for (const char* name : {"k_e1", "k_e2", "b_e1", "b_e2", "f_c1"}) {
    identified.identification->parameters.emplace_back();
    identified.identification->parameters.back().name = name;
  }
  for (const double t : {0.0, 1.0})
    identified.identification->trace.push_back({t, {1, 2, 3, 4, 5}, {1, 1, 1, 1, 1}});
  EXPECT_EQ(namesIn(identified), (std::vector<std::string>{"B-parameters-cables", "B-parameters-f_c"}));
  identified.identification->motions = {trialSample("sinusoid", 0.0), trialSample("more", 0.0)};
  EXPECT_EQ(namesIn(identified),
            (std::vector<std::string>{"B-trajectory-sinusoid", "B-detail-sinusoid", "B-trajectory-more",
                                      "B-parameters-cables", "B-parameters-f_c"}));
  const auto motion = figuresOf(identified)[0].make();
  const TrajectoryData& drawn = dynamic_cast<TrajectoryFigure&>(*motion).data();
  EXPECT_TRUE(drawn.title.contains("Experiment B, sinusoid")) << drawn.title.toStdString();
  EXPECT_TRUE(drawn.note.contains("robot from before the identification")) << drawn.note.toStdString();
  ASSERT_EQ(drawn.samples.size(), identified.identification->motions[0].trajectory.size());
  EXPECT_EQ(drawn.samples[7].q_true, identified.identification->motions[0].trajectory[7].q_true);
  identified.identification->motions.clear();
  const auto cables = figuresOf(identified)[0].make();
  const auto& panels = dynamic_cast<ConvergenceFigure&>(*cables).data().panels;
  ASSERT_EQ(panels.size(), 4U);
  EXPECT_TRUE(panels[1].title.contains("b_e1")) << "stiffness beside damping, a row a joint";
  EXPECT_EQ(panels[1].value, (std::vector<double>{3, 3}));
  EXPECT_FALSE(panels[1].seen);
  identified.identification->parameters[2].dual_ukf.seen = true;  // b_e1
  const auto seen = figuresOf(identified)[0].make();
  EXPECT_TRUE(dynamic_cast<ConvergenceFigure&>(*seen).data().panels[1].seen);
}

TEST_F(ExportAll, ConvergenceIsHeadedByNameOrTitle) {
  experiments::Results results;
  results.identification.emplace().parameters.emplace_back().name = "r_l1";
  results.identification->trace = {{0.0, {1}, {1}}, {1.0, {1}, {1}}};
  const auto heading = [&](const std::string& name, const std::string& title, const std::string& text) {
    results.name = name;
    results.title = title;
    results.specification = text;
    const auto figure = figuresOf(results)[0].make();
    return dynamic_cast<ConvergenceFigure&>(*figure).data().title.toStdString();
  };
  EXPECT_EQ(heading("ident", "", ""), "ident: identified parameters");
  EXPECT_EQ(heading("ident", "Pulley day", ""), "Pulley day: identified parameters");
  EXPECT_EQ(heading("A", "Pulley day", ""), "Experiment A: identified parameters");
  const auto paper = experiments::findSpecification("A");
  EXPECT_EQ(heading("A", paper.title, paper.text), "Experiment A: " + paper.title);
}

TEST_F(ExportAll, EveryLinkOfTheIndexPageLeadsToAFileAndEveryFileIsLinked) {
  const ExportReport report = exportAll(results_, at("out"), small_);
  EXPECT_EQ(report.figures, 8U);
  EXPECT_GT(report.tables, 0U);
  EXPECT_EQ(report.files.back(), at("out") / "index.html");
  const std::string html = base::readTextFile(at("out") / "index.html");
  EXPECT_NE(html.find(kFiguresMark), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "opens without a network";
  EXPECT_NE(html.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_NE(html.find("simulated"), std::string::npos);
  EXPECT_NE(html.find("Errors &lt;of&gt; some &amp; trials"), std::string::npos);
  std::set<std::string> linked;
  const std::regex link("(?:href|src)=\"([^\"]*)\"");
  for (std::sregex_iterator it(html.begin(), html.end(), link), end; it != end; ++it) linked.insert((*it)[1]);
  for (const std::string& name : linked) EXPECT_TRUE(fs::exists(at("out") / name)) << name;
  for (const auto& entry : fs::directory_iterator(at("out"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "index.html" || linked.contains(name)) << name;
  }
  EXPECT_EQ(linked.size() + 1, report.files.size());
}

TEST_F(ExportAll, CameraObservationsStandAtTheirTimesOfExposure) {
  auto results = trialsSample("C", {0.0});
  const Eigen::Vector3d seen(0.8, 1.5, 0.4);
  results.trials[0].camera = {{1.02, seen, Eigen::Vector3d::Zero()}};
  const auto figure = figuresOf(results)[0].make();
  const auto& samples = dynamic_cast<TrajectoryFigure&>(*figure).data().samples;
  for (const TrajectorySample& s : samples) {
    EXPECT_EQ(s.q_cam.allFinite(), s.t == 0.05 * 21) << s.t;
    EXPECT_EQ(s.t_cam.has_value(), s.q_cam.allFinite());
    EXPECT_EQ(s.t_cam.value_or(1.02), 1.02);
  }
}

// The series are thinned, the tables' numbers are not: figures say the same as the tables.
TEST_F(ExportAll, TrajectoriesTellTheTablesRms) {
  experiments::Results results = trialsSample("C", {0.0});
  results.trials[0].rms[0] = Eigen::Vector3d(0.1, 0.2, 0.03);
  results.trials[0].counts[0] = 40'000;
  for (experiments::ErrorPoint& point : results.trials[0].errors)
    point.ukf = Eigen::Vector3d::Constant(point.t < 20.0 ? 0.5 : 0.001);
  const auto rmsOf = [&](std::size_t i) {
    const auto figure = figuresOf(results)[i].make();
    return dynamic_cast<TrajectoryFigure&>(*figure).rms();
  };
  EXPECT_EQ(rmsOf(0).kinematic, results.trials[0].rms[0]);
  EXPECT_EQ(rmsOf(0).kinematic_n, 40'000U);
  EXPECT_EQ(rmsOf(0).ukf, results.trials[0].rmsOf(experiments::Estimator::kUkf));
  ASSERT_EQ(namesIn(results)[1], "C-detail-trial-1");
  EXPECT_EQ(rmsOf(1).ukf_n, 401U) << "a part of 20 s";
  EXPECT_LT(rmsOf(1).ukf[0], 0.5);
}

TEST_F(ExportAll, BoxPlotsSayWhetherErrorsAreSigned) {
  const auto boxes = [](const experiments::Results& results) {
    const auto figure = figuresOf(results).back().make();
    return dynamic_cast<BoxplotFigure&>(*figure).data();
  };
  EXPECT_EQ(boxes(results_[0]).quantity, "signed error");
  EXPECT_TRUE(boxes(results_[0]).title.contains("signed error of joint 3"));
  const BoxplotData absolute = boxes(trialsSample("D", {10.0, 80.0}));
  EXPECT_EQ(absolute.quantity, "|error|");
  EXPECT_TRUE(absolute.title.contains("absolute error"));
}

TEST_F(ExportAll, NoFileOfASingleTrialIsWrittenTwice) {
  const ExportReport report = exportAll({trialsSample("C", {0.0})}, at("out"), small_);
  EXPECT_EQ(std::set<fs::path>(report.files.begin(), report.files.end()).size(), report.files.size());
  EXPECT_NE(base::readTextFile(at("out") / "C-boxplot.csv").find("lower_whisker"), std::string::npos);
}

TEST_F(ExportAll, WritesOverItselfAndLeavesWhatOthersPutThere) {
  exportAll(results_, at("out"), small_);
  base::writeTextFile(at("out") / "mine.txt", "mine");
  const auto before = fs::last_write_time(at("out") / "C-boxplot-joint-1.csv");
  ExportOptions boxes = small_;
  boxes.kinds = {FigureKind::kBoxplot};
  boxes.tables = false;
  const ExportReport again = exportAll(results_, at("out"), boxes);
  EXPECT_EQ(again.figures, 3U);
  EXPECT_EQ(again.tables, 0U);
  EXPECT_GE(fs::last_write_time(at("out") / "C-boxplot-joint-1.csv"), before);
  EXPECT_EQ(base::readTextFile(at("out") / "mine.txt"), "mine");
  EXPECT_TRUE(fs::exists(at("out") / "C-histogram-trial-1-page-1.pdf"));
}

TEST_F(ExportAll, RefusesFoldersThatAreNotItsOwn) {
  fs::create_directories(at("full"));
  base::writeTextFile(at("full") / "index.html", "somebody's page");
  base::writeTextFile(at("file"), "a file");
  for (const fs::path& folder : {at("full"), at("file"), at("file") / "below"})
    EXPECT_THROW(exportAll(results_, folder, small_), base::InputError) << folder;
  EXPECT_EQ(base::readTextFile(at("full") / "index.html"), "somebody's page");
  EXPECT_EQ(std::distance(fs::directory_iterator(at("full")), fs::directory_iterator()), 1);
}

TEST_F(ExportAll, RefusesResultsWithNothingToDraw) {
  experiments::Results empty;
  empty.name = "empty";
  ExportOptions figures = small_;
  figures.tables = false;
  EXPECT_THROW(exportAll({empty}, at("out"), figures), base::InputError);
  EXPECT_FALSE(fs::exists(at("out"))) << "nothing is made";
}

TEST_F(ExportAll, SaysWhatIsMissing) {
  auto results = results_;
  results[0].trials[1].errors.clear();
  const ExportReport report = exportAll(results, at("out"), small_);
  ASSERT_EQ(report.missing.size(), 1U);
  EXPECT_NE(report.missing[0].find("trial 2"), std::string::npos);
  EXPECT_NE(base::readTextFile(at("out") / "index.html").find("no reference"), std::string::npos);
}

TEST_F(ExportAll, CanBeCancelledAndTakenUpAgain) {
  base::Progress progress;
  progress.cancel();
  const ExportReport report = exportAll(results_, at("out"), small_, &progress);
  EXPECT_TRUE(report.cancelled);
  EXPECT_EQ(report.figures, 1U);
  EXPECT_NE(base::readTextFile(at("out") / "index.html").find("Cancelled"), std::string::npos);
  EXPECT_EQ(exportAll(results_, at("out"), small_).figures, 8U);
}

}  // namespace
}  // namespace capstan::widgets
