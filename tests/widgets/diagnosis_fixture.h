#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QPushButton>
#include <QtTest/QTest>
#include <map>
#include <memory>

#include "tests/support/sample_diagnosis.h"
#include "widgets/panels/diagnosis/cause_tree.h"
#include "widgets/panels/diagnosis/diagnosis_panel.h"
#include "widgets/panels/diagnosis/hypothesis_card.h"
#include "widgets/panels/diagnosis/report_pages.h"

/// The diagnosis panel without a window around it: reports handed in or made by a job of the test's own.
namespace capstan::widgets {

using diagnosis::Report;
using diagnosis::Verdict;

/// Each made once: they take a moment.
inline const Report& sample(Verdict verdict) {
  static std::map<Verdict, Report> made;
  if (!made.contains(verdict))
    made[verdict] = testing::sampleReport({.verdict = verdict, .cameras = verdict == Verdict::kSeveral});
  return made.at(verdict);
}

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, 60000);
}

class Diagnosis : public ::testing::Test {
 protected:
  void SetUp() override { show(nullptr); }
  /// A panel whose job is `run`.
  void show(DiagnosisRun run) {
    panel = std::make_unique<DiagnosisPanel>(std::move(run));
    panel->resize(1000, 860);
    panel->show();
    QApplication::setActiveWindow(panel.get());  // for its keys
  }
  QPushButton* button(const char* name) { return panel->findChild<QPushButton*>(name); }
  std::string headline() { return panel->headline().toStdString(); }
  std::string causes() { return panel->causes().text().toStdString(); }
  QString card() { return panel->findChild<HypothesisCard*>()->toPlainText(); }

  std::unique_ptr<DiagnosisPanel> panel;
};

}  // namespace capstan::widgets
