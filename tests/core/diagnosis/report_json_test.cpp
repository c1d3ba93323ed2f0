// What scripts read of a diagnosis is what the report says, to the last bit, and JSON everywhere.
#include "core/diagnosis/report/report_json.h"

#include <gtest/gtest.h>

#include <limits>

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
