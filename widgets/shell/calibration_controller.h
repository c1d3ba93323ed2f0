#pragma once

#include <QObject>

class QDockWidget;

namespace capstan::widgets {

class CalibrationPanel;
class SessionLink;

/// Gives the calibration the session's images while its panel is open.
class CalibrationController : public QObject {
  Q_OBJECT

 public:
  CalibrationController(CalibrationPanel& panel, QDockWidget& dock, SessionLink& link, QObject* parent);
};

}  // namespace capstan::widgets
