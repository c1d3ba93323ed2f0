#include "widgets/shell/help_topics.h"

#include <QWidget>

namespace capstan::widgets {

namespace {

constexpr const char* kManual = "manual.md";

}  // namespace

const std::vector<std::pair<QString, HelpTopic>>& helpTopics() {
  static const std::vector<std::pair<QString, HelpTopic>> topics = {
      {"JointFigure", {kManual, "The four curves"}},
      {"ReplayBar", {kManual, "Replay: the time line"}},
      {"StereoView", {kManual, "Cameras"}},
      {"SceneView", {kManual, "Scene"}},
      {"OcclusionPanel", {kManual, "Occlusion"}},
      {"IdentificationPanel", {kManual, "Identification"}},
      {"CalibrationPanel", {kManual, "Camera calibration"}},
      {"ErrorsPanel", {kManual, "Errors"}},
      {"FilterPanel", {kManual, "Filter options"}},
      {"HealthPanel", {kManual, "Estimator health"}},
      {"NotesPanel", {kManual, "Notes"}},
      {"MarkerPanel", {kManual, "The marker"}},
      {"RegistrationPanel", {kManual, "Registration at the hard stop"}},
      {"AnalysisPages", {kManual, "Analysis"}},
      {"DiagnosisPanel", {kManual, "Diagnosis"}},
      {"LearningPanel", {"learning.md", {}}},
      {"StatusLine", {kManual, "The status line"}},
      {"SessionBar", {kManual, "Keys"}},
      {"SimulationDialog", {kManual, "Sources"}},
      {"RerunDialog", {kManual, "Re-run and comparison"}},
      {"LiveDialog", {"connect-your-robot.md", {}}},
      {"UnitsDialog", {"measured-table.md", {}}},
  };
  return topics;
}

HelpTopic topicOf(const QWidget* widget) {
  for (; widget; widget = widget->parentWidget()) {
    const QString name = QString(widget->metaObject()->className()).section("::", -1);
    for (const auto& [panel, topic] : helpTopics())
      if (panel == name) return topic;
  }
  return {kManual, {}};
}

}  // namespace capstan::widgets
