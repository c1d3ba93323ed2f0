#pragma once

#include <gtest/gtest.h>

#include <QtTest/QTest>

#include "tests/widgets/analysis_recordings.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/analysis/analysis_table.h"

namespace capstan::widgets {

inline constexpr int kPatience = 60000;  // [ms] after which a wait has failed

/// A shown analysis panel and its recordings.
class Analysed : public testing::Test {
 protected:
  void SetUp() override {
    panel.resize(700, 640);
    panel.show();
  }
  static QString path(const QString& name) { return Recordings::get().path(name); }
  static RunChoice recording(const QString& robot = {}) {
    return {.kind = RunChoice::Kind::kRecording, .path = path("trial.capstan"), .robot = robot};
  }
  bool settled() {
    return QTest::qWaitFor([&] { return panel.settled(); }, kPatience);
  }
  QString cell(analysis::Measure measure, int joint, experiments::Estimator estimator, int column) {
    const auto* line = panel.table().line(measure, joint, estimator);
    return line ? line->text(column) : QStringLiteral("no such line");
  }

  AnalysisPanel panel;
};

}  // namespace capstan::widgets
