#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/joint_plot.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

/// One instant of a trajectory, joints as rad, rad, m; NaN: not known.
struct TrajectorySample {
  double t = 0.0;  ///< [s], rising
  Eigen::Vector3d q_true, q_kin, q_cam, q_ukf;
  Eigen::Vector3d sigma;  ///< of q_ukf
  bool occluded = false;
  std::optional<double> t_cam = {};  ///< exposure behind q_cam [s]; none: t
};

struct TrajectoryData {
  QString title = {}, note = {};
  std::array<QString, 3> joint_names = {QStringLiteral("shoulder"), QStringLiteral("elbow"),
                                        QStringLiteral("insertion")};
  std::vector<TrajectorySample> samples = {};
};

/// Three joints over time: true, kinematic, camera, UKF with its ±2σ, occluded time shaded (UKF paper,
/// figures 5 and 8), drawn by the same joint plots as on screen. Above each joint the RMS difference from the
/// true values over these samples.
class TrajectoryFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit TrajectoryFigure(TrajectoryData data, QWidget* parent = nullptr);
  ~TrajectoryFigure() override;

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const TrajectoryData& data() const { return data_; }
  JointPlot& plot(int joint) { return *plots_[static_cast<std::size_t>(joint)]; }

 protected:
  int columnsFor(QSize size) const override;
  bool sharesX() const override { return true; }
  void restyle() override;
  void laidOut() override;

 private:
  void fillHistory();
  QString words(int joint) const;
  void setEntries();

  TrajectoryData data_;
  JointHistory history_;
  std::array<std::unique_ptr<JointPlot>, 3> plots_;
};

}  // namespace capstan::widgets
