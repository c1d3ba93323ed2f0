#pragma once

#include <QString>
#include <QStringList>

#include "core/learning/poses/pose_motion.h"

class QSettings;

namespace capstan::widgets {

/// Input of learning; saved in the settings.
struct LearningChoice {
  QStringList tables = {};                                        ///< tip poses: absolute paths, each once
  learning::StreamKind towards = learning::StreamKind::kCommand;  ///< stream to correct towards

  bool operator==(const LearningChoice&) const = default;
  void save(QSettings& settings) const;
  static LearningChoice restore(const QSettings& settings);
};

/// Name of a stream: "command", "robot's kinematics".
QString nameOf(learning::StreamKind stream);

}  // namespace capstan::widgets
