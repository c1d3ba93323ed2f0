#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/joint_plot.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

/// One instant of a trajectory, joints in rad, rad, m; NaN: unknown.
struct TrajectorySample {
  double t = 0.0;  ///< [s], rising
  Eigen::Vector3d q_true, q_kin, q_cam, q_ukf;
  Eigen::Vector3d sigma;  ///< standard deviation of q_ukf
  bool occluded = false;
  std::optional<double> t_cam = {};  ///< time of exposure of q_cam [s]; none: t
};

/// RMS differences from the true joints over every sample of a run, in rad, rad, m, and the numbers of
/// samples.
struct TrajectoryRms {
  Eigen::Vector3d kinematic, ukf;
  std::uint64_t kinematic_n = 0, ukf_n = 0;
};

struct TrajectoryData {
  QString title = {}, note = {};
  bool own_kinematics = false;  ///< q_true is the robot's own kinematics: differences from it are no errors
  std::array<QString, 3> joint_names = {QStringLiteral("shoulder"), QStringLiteral("elbow"),
                                        QStringLiteral("insertion")};
  std::vector<TrajectorySample> samples = {};
  /// RMS differences of the run from which `samples` were thinned, as in the tables; none: computed from
  /// `samples`.
  std::optional<TrajectoryRms> rms = {};
};

/// Three joints over time: true, kinematic, camera, UKF with its ±2σ, occluded time shaded (UKF paper,
/// figures 5 and 8), drawn by the same joint plots as on screen. Below each plot, where the true values are
/// known, are the differences of the kinematic and UKF estimates from them, in a scale of their own; above it
/// the RMS differences.
class TrajectoryFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit TrajectoryFigure(TrajectoryData data, QWidget* parent = nullptr);
  ~TrajectoryFigure() override;

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const TrajectoryData& data() const { return data_; }
  JointPlot& plot(int joint) { return *plots_[static_cast<std::size_t>(joint)]; }
  /// The plot of estimates − true; null where the true values are unknown.
  JointPlot* errorPlot(int joint) { return error_plots_[static_cast<std::size_t>(joint)].get(); }
  const TrajectoryRms& rms() const { return rms_; }

 protected:
  int columnsFor(QSize size) const override;
  bool sharesX() const override { return true; }
  void restyle() override;
  void laidOut() override;

 private:
  void fillHistories();
  void addJoint(int joint);
  QString words(int joint) const;
  QString errorWord() const;
  std::string rmsCsv() const;
  void setEntries();
  void endOnTicks(JointPlot& plot) const;
  std::vector<JointPlot*> all() const;

  TrajectoryData data_;
  TrajectoryRms rms_;
  JointHistory history_, errors_;
  std::array<std::unique_ptr<JointPlot>, 3> plots_, error_plots_;
};

}  // namespace capstan::widgets
