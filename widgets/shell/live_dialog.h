#pragma once

#include <QDialog>
#include <QTimer>
#include <array>
#include <functional>
#include <optional>

#include "core/live/live_setup.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QGroupBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace capstan::widgets {

class LivePreviewView;
class LiveTopics;

/// Non-modal dialog that connects to a live robot: writes and reads a live set-up file, lists the cameras of
/// this computer, and shows what comes before a session is begun.
class LiveDialog : public QDialog {
  Q_OBJECT

 public:
  explicit LiveDialog(QWidget* parent = nullptr);

  void setSetup(const live::LiveSetup& setup);
  live::LiveSetup setup() const;
  /// Reads a live set-up file into the form; a fault is shown in the dialog.
  void openFile(const QString& file);
  /// Shows the robot of a session: `live` as chosen() gives it.
  void showLive(const QString& live);
  /// Writes the form to `file`. False: a fault is shown in the dialog.
  bool saveFile(const QString& file);

 signals:
  /// `live`: an address, or the path of the saved set-up file.
  void chosen(const QString& live);

 protected:
  void hideEvent(QHideEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  struct Motor {
    QSpinBox* from;
    QCheckBox* reversed;
  };

  QGroupBox* makeMotors();
  QGroupBox* makeCameras();
  QWidget* makeButtons();
  QLineEdit* addPath(QFormLayout* form, const QString& label, const QString& tip, const QString& name);
  void fillDevices();
  void fitLayout();
  void togglePreview(bool on);
  void beginPreview();
  /// Previews what the form says now, when it has rested for a moment.
  void followForm();
  /// Shows what `work` throws. False: there was a fault.
  bool showingFaults(const std::function<void()>& work);
  void askOpen();
  void askSave(bool then_connect);
  void connectRobot();
  /// setup(), whose relative paths are paths from the folder of the set-up file.
  live::LiveSetup besideFile() const;
  /// An address alone says the same.
  bool isAddressOnly() const;

  QString file_;  ///< set-up file that the form equals; empty: none
  QLineEdit *title_, *robot_, *read_as_, *calibration_, *registration_, *marker_;
  QComboBox *from_, *left_, *right_, *layout_, *size_;
  std::array<Motor, 3> motors_;
  QCheckBox* reference_;
  QGroupBox* cameras_;
  QDoubleSpinBox *rate_, *latency_, *pairing_;
  live::CamerasSetup other_;                     ///< fields of the file that the form does not show
  live::RowsSetup other_motors_;                 ///< the same of the motors
  std::optional<live::CommandsSetup> commands_;  ///< of the file; the form does not show them
  QPushButton* preview_button_;
  LivePreviewView* preview_;
  live::LiveSetup previewed_, seen_;  ///< what preview_ shows; the form at the last look
  QTimer watch_;
  LiveTopics* topics_;
  QLabel* message_;
};

}  // namespace capstan::widgets
