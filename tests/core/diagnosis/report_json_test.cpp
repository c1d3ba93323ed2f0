// What scripts read of a diagnosis is what the report says, to the last bit, and JSON everywhere.
#include "core/diagnosis/report/report_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "tests/support/sample_diagnosis.h"

namespace capstan::diagnosis {
namespace {

using nlohmann::json;
using testing::sampleReport;

TEST(ReportJson, SaysWhatTheReportSays) {
  const Report report = sampleReport({.verdict = Verdict::kSeveral, .recordings = 2, .duration = 12.0});
  const json document = json::parse(jsonOf(report).dump());
  EXPECT_EQ(document.at("verdict"), "several");
  EXPECT_EQ(document.at("recordings"), json({"slow.csv", "fast1.csv"}));
  ASSERT_EQ(document.at("causes").size(), 2U);
  const json& cause = document.at("causes")[0];
  EXPECT_EQ(cause.at("effect"), "backlash");
  EXPECT_EQ(cause.at("joint"), 2);
  EXPECT_EQ(cause.at("parameters").at("half_width").at("value").get<double>(),
            report.causes[0].parameters[0].value);
  EXPECT_EQ(cause.at("parameters").at("half_width").at("unit"), "m");
  EXPECT_EQ(cause.at("parameters").at("half_width").at("at_bound"), false);
  EXPECT_EQ(cause.at("parameters").at("half_width").at("at_joint").at("unit"), "rad");
  EXPECT_NEAR(cause.at("parameters").at("half_width").at("at_joint").at("value").get<double>(), 0.015, 1e-12)
      << "0.93 mm on a radius of 62 mm";
  EXPECT_FALSE(document.at("also_measurable")[0].at("parameters").at("share").contains("at_joint"));
  EXPECT_EQ(cause.at("gain").at("rms_after").get<double>(), report.causes[0].gain.rms_after);
  EXPECT_EQ(cause.at("gain").at("interval")[1].get<double>(), report.causes[0].gain.interval.high);
  EXPECT_EQ(document.at("refit").at("cable_stiffness_2").at("value").get<double>(), report.refit[0].value);
  EXPECT_EQ(document.at("refit").at("cable_stiffness_2").at("moved"), true);
  ASSERT_EQ(document.at("channels").size(), report.channels.size());
  const json& channel = document.at("channels")[1];
  EXPECT_EQ(channel.at("name"), "q2");
  EXPECT_EQ(channel.at("refitted").at("rms").get<double>(), report.channels[1].refitted_statistics.rms);
  EXPECT_EQ(channel.at("before")[0].at("variable"), report.channels[1].before[0].variable);
  EXPECT_EQ(channel.at("before")[0].at("bins").size(), report.channels[1].before[0].bins.size());
  EXPECT_EQ(document.at("candidates").size(), report.candidates.size());
  EXPECT_EQ(document.at("filter")[1].at("extended").get<double>(), report.filter[1].extended);
  EXPECT_EQ(document.at("stages")[0].at("name"), "refit");
  EXPECT_EQ(document.at("notices"), json(report.notices));
  EXPECT_EQ(document.at("cancelled"), false);
}

/// A report with everything that a search over sets of effects says, made by hand.
Report searched() {
  Report report;
  Cause cause{.effect = "backlash", .joint = 2, .parameters = {}, .probability = 0.875, .loss = 31.5};
  cause.moves.joints = {{1e-4, 2e-4, false}, {3e-3, 7e-3, false}, {2e-5, 4e-5, true}};
  cause.moves.tip = {5e-4, 9e-4, true};
  report.causes = {cause};
  cause.effect = "asymmetric_friction", cause.joint = 1, cause.loss = 4.5;
  report.also_measurable = {cause};
  report.material = {7e-4, 3e-5};
  report.posterior = {
      {{{"asymmetric_friction", 1}, {"backlash", 2}}, 0.8125}, {{{"backlash", 2}}, 0.125}, {{}, 0.0625}};
  Explainable channel{"q2",
                      "rad",
                      1e-5,
                      4e-3,
                      2e-4,
                      6e-4,
                      std::numeric_limits<double>::quiet_NaN(),
                      0.96875,
                      "depends on q_m2"};
  report.explainable = {channel};
  return report;
}

TEST(ReportJson, HasCausesWithLossAndMovesAndWhatIsAlsoMeasurable) {
  const json document = json::parse(jsonOf(searched()).dump());
  const json& cause = document.at("causes")[0];
  EXPECT_EQ(cause.at("probability"), 0.875);
  EXPECT_EQ(cause.at("loss"), 31.5);
  ASSERT_EQ(cause.at("moves").at("joints").size(), 3U);
  EXPECT_EQ(cause.at("moves").at("joints")[1], json({{"rms", 3e-3}, {"largest", 7e-3}}));
  EXPECT_EQ(cause.at("moves").at("tip"), json({{"rms", 5e-4}, {"largest", 9e-4}}));
  ASSERT_EQ(document.at("also_measurable").size(), 1U);
  EXPECT_EQ(document.at("also_measurable")[0].at("effect"), "asymmetric_friction");
  EXPECT_EQ(document.at("also_measurable")[0].at("loss"), 4.5);
  EXPECT_EQ(document.at("material"), json({{"angle", 7e-4}, {"length", 3e-5}}));
  const json empty = jsonOf(Report{});
  EXPECT_EQ(empty.at("also_measurable"), json::array());
  EXPECT_EQ(empty.at("material").at("length").get<double>(), Tolerance{}.length);
}

TEST(ReportJson, HasThePosteriorAndTheExplainableShare) {
  const json document = json::parse(jsonOf(searched()).dump());
  const json& posterior = document.at("posterior");
  ASSERT_EQ(posterior.size(), 3U);
  EXPECT_EQ(posterior[0].at("probability"), 0.8125);
  ASSERT_EQ(posterior[0].at("effects").size(), 2U);
  EXPECT_EQ(posterior[0].at("effects")[1], json({{"effect", "backlash"}, {"joint", 2}}));
  EXPECT_EQ(posterior[2].at("effects"), json::array()) << "the nominal structure";
  ASSERT_EQ(document.at("explainable").size(), 1U);
  const json& channel = document.at("explainable")[0];
  EXPECT_EQ(channel.at("channel"), "q2");
  EXPECT_EQ(channel.at("unit"), "rad");
  EXPECT_EQ(channel.at("noise"), 1e-5);
  EXPECT_EQ(channel.at("refitted"), 4e-3);
  EXPECT_EQ(channel.at("named"), 2e-4);
  EXPECT_EQ(channel.at("linear"), 6e-4);
  EXPECT_TRUE(channel.at("flexible").is_null()) << "there was none";
  EXPECT_EQ(channel.at("share"), 0.96875);
  EXPECT_EQ(channel.at("leans_on"), "depends on q_m2");
}

/// Keys of a document but for the names of parameters and refitted numbers, which are the robot's.
void collectKeys(const json& document, std::set<std::string>& keys) {
  if (document.is_object())
    for (const auto& [key, value] : document.items()) {
      keys.insert(key);
      const bool named = key == "parameters" || key == "refit";
      if (!named) collectKeys(value, keys);
      for (const auto& one : named ? value : json::object()) collectKeys(one, keys);
    }
  if (document.is_array())
    for (const json& value : document) collectKeys(value, keys);
}

TEST(ReportJson, EveryKeyStandsInTheManual) {
  std::set<std::string> keys;
  collectKeys(jsonOf(searched()), keys);
  for (const Verdict verdict : {Verdict::kTie, Verdict::kUnexplained})
    collectKeys(jsonOf(sampleReport({.verdict = verdict, .duration = 12.0})), keys);
  for (const char* key : {"also_measurable", "leans_on", "loss", "moves", "sigma", "relevance", "separate"})
    EXPECT_TRUE(keys.contains(key)) << key << " is not in the documents that are compared";
  const std::string page = base::readTextFile(base::resource("manual/json.md"));
  const std::size_t begin = page.find("## diagnose");
  ASSERT_NE(begin, std::string::npos);
  const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
  for (const std::string& key : keys) EXPECT_NE(section.find(key), std::string::npos) << key;
}

TEST(ReportJson, NotANumberIsNull) {
  const json document = json::parse(jsonOf(sampleReport({.duration = 12.0})).dump());
  const json& tilt = document.at("candidates")[3];
  EXPECT_EQ(tilt.at("effect"), "gravity_tilt");
  EXPECT_TRUE(tilt.at("score").is_null());
  EXPECT_EQ(tilt.at("refitted"), false);
  Report infinite;
  infinite.causes.emplace_back().parameters = {{"mass", "kg", 1.0, std::numeric_limits<double>::infinity()}};
  EXPECT_TRUE(jsonOf(infinite).at("causes")[0].at("parameters").at("mass").at("sigma").is_null());
}

TEST(ReportJson, HasTiesLinesAndProcesses) {
  const json tie = jsonOf(sampleReport({.verdict = Verdict::kTie, .duration = 12.0}));
  EXPECT_EQ(tie.at("verdict"), "tie");
  ASSERT_EQ(tie.at("ties").size(), 1U);
  EXPECT_EQ(tie.at("ties")[0].at("causes")[1].at("effect"), "cable_hysteresis");
  EXPECT_FALSE(tie.at("ties")[0].at("separate").get<std::string>().empty());
  const Report report = sampleReport({.verdict = Verdict::kUnexplained, .duration = 12.0});
  const json unexplained = jsonOf(report);
  EXPECT_EQ(unexplained.at("causes"), json::array());
  EXPECT_EQ(unexplained.at("lines")[0].at("frequency").get<double>(), report.lines[0].frequency);
  EXPECT_EQ(unexplained.at("processes")[0].at("words"), report.processes[0].words);
  EXPECT_EQ(unexplained.at("processes")[0].at("variables").size(), report.processes[0].variables.size());
}

TEST(ReportJson, WhatWasCancelledHasNoVerdict) {
  Report report;
  report.verdict = Verdict::kUnexplained;
  report.cancelled = true;
  EXPECT_TRUE(jsonOf(report).at("verdict").is_null());
}

TEST(ReportJson, EveryVerdictIsSpelledAsTheCommandSaysItIs) {
  for (const char* name : {"found", "several", "tie", "nothing", "unexplained"}) {
    Report report;
    report.verdict = base::fromName<Verdict>(name).value();
    EXPECT_EQ(jsonOf(report).at("verdict"), name);
  }
}

}  // namespace
}  // namespace capstan::diagnosis
