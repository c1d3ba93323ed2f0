#pragma once

#include <QString>
#include <QStringList>

#include "core/learning/poses/pose_motion.h"

class QSettings;

namespace capstan::widgets {

/// What the user wants learned; kept between starts.
struct LearningChoice {
  QStringList tables = {};                                        ///< of tip poses: absolute paths, each once
  learning::StreamKind towards = learning::StreamKind::kCommand;  ///< to correct towards

  bool operator==(const LearningChoice&) const = default;
  /// Adds those of `files` that are not there yet.
  void add(const QStringList& files);
  void save(QSettings& settings) const;
  static LearningChoice restore(const QSettings& settings);
};

/// "command", "robot's kinematics"
QString nameOf(learning::StreamKind stream);

}  // namespace capstan::widgets
