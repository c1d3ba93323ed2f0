// What the user chose to open: kept between starts, requested by dialog, menu of recent files.
#include <gtest/gtest.h>

#include <QDir>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>

#include "core/base/error.h"
#include "widgets/shell/recent_menu.h"
#include "widgets/shell/simulation_dialog.h"
#include "widgets/shell/source_menu.h"

namespace capstan::widgets {
namespace {

simulation::SimulationRequest unusualRequest() {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = 77.0;
  request.truth = "/somewhere/truth.yaml";
  request.seed = 12345;
  request.robot = "/somewhere/robot.yaml";
  request.registered = false;
  request.distractors = true;
  request.uneven_light = true;
  return request;
}

TEST(SourceChoice, SurvivesTheSettings) {
  const QTemporaryDir folder;
  SourceChoice choice = SourceChoice::ofSimulation(unusualRequest());
  choice.robot = "/r.yaml";
  {
    QSettings settings(folder.filePath("s.ini"), QSettings::IniFormat);
    choice.save(settings);
  }
  const QSettings settings(folder.filePath("s.ini"), QSettings::IniFormat);
  const SourceChoice back = SourceChoice::restore(settings);
  EXPECT_TRUE(back.simulated);
  EXPECT_EQ(back.robot, "/r.yaml");
  EXPECT_EQ(back.simulation, unusualRequest());
}

TEST(SourceChoice, KeepsFilesByTheirAbsolutePath) {
  const QTemporaryDir folder;
  const QDir here;
  SourceChoice choice = SourceChoice::ofFile("trial.capstan");
  EXPECT_EQ(choice.file, here.absoluteFilePath("trial.capstan"));
  choice.robot = "arm.yaml";
  choice.simulation.robot = "arm.yaml";
  choice.simulation.truth = "truth.yaml";
  choice.simulation.trajectory = "hold";
  QSettings settings(folder.filePath("s.ini"), QSettings::IniFormat);
  choice.save(settings);
  const SourceChoice back = SourceChoice::restore(settings);
  EXPECT_EQ(back.robot, here.absoluteFilePath("arm.yaml"));
  EXPECT_EQ(QString::fromStdString(back.simulation.robot.string()), here.absoluteFilePath("arm.yaml"));
  EXPECT_EQ(QString::fromStdString(back.simulation.truth), here.absoluteFilePath("truth.yaml"));
  EXPECT_EQ(back.simulation.trajectory, "hold") << "a name is no file";
}

TEST(SourceChoice, WithoutSettingsIsTheDefaultSimulation) {
  const QTemporaryDir folder;
  const QSettings settings(folder.filePath("none.ini"), QSettings::IniFormat);
  const SourceChoice choice = SourceChoice::restore(settings);
  EXPECT_TRUE(choice.simulated);
  EXPECT_EQ(choice.simulation, simulation::SimulationRequest{});
}

TEST(SourceChoice, RefusesAnUnknownMovement) {
  SourceChoice choice;
  choice.simulation.trajectory = "somersault";
  try {
    openSource(choice);
    FAIL() << "opened";
  } catch (const base::InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("somersault"), std::string::npos) << text;
    EXPECT_NE(text.find("hard-stop"), std::string::npos) << text;
  }
}

TEST(SimulationDialog, GivesBackWhatItWasGiven) {
  SimulationDialog dialog;
  EXPECT_EQ(dialog.request(), simulation::SimulationRequest{});
  dialog.setRequest(unusualRequest());
  EXPECT_EQ(dialog.request(), unusualRequest());
  dialog.setRequest({});
  EXPECT_EQ(dialog.request(), simulation::SimulationRequest{});
}

TEST(SourceMenu, ListsTheNewestFileFirstAndOnce) {
  SourceMenu menu;
  for (int i = 0; i < 12; ++i) menu.remember(SourceChoice::ofFile(QString("/data/%1.capstan").arg(i)));
  menu.remember(SourceChoice::ofFile("/data/7.capstan"));
  ASSERT_EQ(menu.recent().files().size(), RecentMenu::kMost);
  EXPECT_EQ(menu.recent().files().front(), "/data/7.capstan");
  EXPECT_EQ(menu.recent().files().count("/data/7.capstan"), 1);
  menu.remember(SourceChoice::ofSimulation(unusualRequest()));
  EXPECT_EQ(menu.recent().files().front(), "/data/7.capstan");
  EXPECT_EQ(menu.dialog().request(), unusualRequest());
}

}  // namespace
}  // namespace capstan::widgets
