#pragma once

#include <qcustomplot.h>

#include <QElapsedTimer>
#include <QTimer>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/figures/joint_plot.h"
#include "widgets/figures/note_flags.h"

class QMenu;
class QPushButton;
class QRubberBand;

namespace capstan::widgets {

/// The three joint plots over one time axis, with one legend and the values under the cursor (else the
/// newest). Wheel: zoom in time; wheel on a value axis: zoom that axis; drag: move in time; Shift and drag:
/// zoom to the box; double click, End or the button at the top right: back to the newest sample. Click on a
/// name in the legend: hide or show that curve. D: errors in place of positions; S: statistics of the visible
/// range; M: mark at the cursor, Esc: no mark. The same figure is drawn on screen and into PNG, PDF and SVG
/// files (save_figure.h).
class JointFigure : public QCustomPlot {
  Q_OBJECT
 public:
  enum class Medium { kScreen, kPaper };
  /// Longest time for which a change of less than half a pixel waits [ms].
  static constexpr int kRest = 200;
  static constexpr double kShortest = 0.05;  ///< least time shown [s]
  /// `history` must outlive the figure.
  explicit JointFigure(const JointHistory& history, Medium medium = Medium::kScreen,
                       QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Sets the names of the three joints, as in the robot file.
  void setJointNames(const std::array<QString, 3>& names);
  /// Sets one remark per joint about a fault in its values, shown beside its title in the colour of faults;
  /// empty: none.
  void setRemarks(const std::array<QString, 3>& remarks);

  /// Shows the plot of one joint alone.
  void showOnly(int joint);
  /// Whether every plot has its least height (PanelFigure::kLeastAxesHeight) at the present size.
  bool fits() const;

  /// Gives the errors of the same session (appendErrors()); they must outlive the figure.
  void setErrors(const JointHistory& errors);
  /// Draws the UKF of a second run of the same session over the first: its positions, and its errors while
  /// errors are shown. They must outlive the figure, or be taken away by clearSecond() before.
  void setSecond(const JointHistory& values, const JointHistory& errors);
  void clearSecond();
  /// Shows errors in place of positions. Needs setErrors().
  void showErrors(bool on);
  bool errorsShown() const { return history_ == errors_; }
  /// Shows below each title the statistics of the errors in the visible range. Needs setErrors().
  void showStatistics(bool on);
  bool statisticsShown() const { return statistics_on_; }
  void setShown(Quantity quantity, bool on);
  void showAll();
  /// Notes of the session, drawn as flags.
  void setFlags(std::vector<NoteFlag> flags);

  /// Draws the present content of the history. `at_once`: inside this call; otherwise when the event loop is
  /// next idle, and only if anything in view has changed.
  void refresh(bool at_once = false);

  /// Sets whether the newest sample is of now, so that the button goes back to live; else it goes back to the
  /// newest sample, as of a recording that is tracked.
  void setLive(bool live);

  /// Whether the right edge stays at the newest sample. Otherwise the view stands still while data arrive.
  bool following() const { return following_; }
  void setFollowing(bool on);
  /// Length of the time axis [s], 0.05 s to the whole history.
  double span() const { return span_; }
  void setSpan(double seconds);
  /// Stops following and shows [begin, end].
  void setTimeRange(double begin, double end);
  QCPRange timeRange() const;

  /// Sets the time of the values in the headers; none: the newest sample. The mouse sets it too, to the time
  /// under it, also while the time axis moves below a mouse at rest.
  void setCursor(std::optional<double> t);
  std::optional<double> cursorTime() const { return cursor_; }
  /// Sets a mark. The headers then show the differences of the values from those at the mark.
  void setMark(std::optional<double> t);
  std::optional<double> mark() const { return mark_; }

  FigureHeader& legend() { return *legend_; }
  JointPlot& plot(int joint) { return *plots_[static_cast<std::size_t>(joint)]; }
  /// Positions, also while errors are shown.
  const JointHistory& history() const { return values_; }

 signals:
  void followingChanged(bool following);
  void spanChanged(double seconds);
  /// Another time range is shown, or the cursor is at another time; none: no cursor.
  void timeRangeShown(double begin, double end);
  void cursorMoved(std::optional<double> t);
  void errorsShownChanged(bool on);
  void statisticsShownChanged(bool on);
  /// The context menu is about to open at `position`; receivers add actions.
  void menuAboutToShow(QMenu* menu);

 protected:
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  bool event(QEvent* event) override;

 private:
  /// Everything that a drawing depends on, except names and remarks, whose setters draw again.
  struct View {
    QCPRange time;
    std::array<QCPRange, 3> values;
    QSize size;
    const Theme* theme = nullptr;
    std::optional<double> cursor, pointer;          ///< at most one of them
    double begin = 0.0, detail = 0.0, block = 0.0;  ///< times of the history, as far as in view
    std::uint64_t revision = 0;                     ///< revision of the history, where its end is in view
    double newest = 0.0;                            ///< its last time, where that is in view
    bool operator==(const View&) const = default;
  };
  View viewOf(const QCPRange& time) const;
  bool barelyMoved(const View& view) const;
  void layOut();
  QCPItemStraightLine* addLine(const JointPlot& plot);
  void showStatisticsOf(int joint, const QCPRange& time);
  void place(const std::vector<QCPItemStraightLine*>& lines, std::optional<double> t);
  void showReadout(double t);
  void showSecond();
  void setTitles();
  void drawAnew();
  void noticeReference();
  void fitHeaders();
  QString noteText(const QCPRange& time, double shown) const;
  void placeLiveButton();
  QCPRange limits() const;
  void zoomTime(double factor, double about);
  void zoomTo(const QRectF& box);
  void moveTo(const QPointF& position);
  void clickLegend(const QPointF& position);
  std::optional<double> timeAt(double x) const;
  JointPlot* valueAxisAt(const QPointF& position) const;

  const JointHistory& values_;
  const JointHistory* errors_ = nullptr;
  const JointHistory *second_values_ = nullptr, *second_errors_ = nullptr;
  const JointHistory* history_;  ///< the one of the two that is shown
  Medium medium_;
  const Theme* theme_;
  FigureHeader* note_ = nullptr;  ///< on paper: description of the figure
  FigureHeader* legend_;
  QPushButton* live_;  ///< goes back to the newest sample; visible while not following
  std::array<std::unique_ptr<JointPlot>, 3> plots_;
  std::array<QString, 3> names_, remarks_;
  std::vector<QCPItemStraightLine*> cursor_lines_, mark_lines_;
  /// Mean and RMS of the errors in view, by joint.
  std::array<std::array<FigureHeader*, 2>, 3> statistics_{};
  bool statistics_on_ = false;
  bool unknown_ = false;         ///< errors are shown, and there is no reference
  bool own_kinematics_ = false;  ///< the reference is the robot's own kinematics
  std::vector<NoteFlag> note_flags_;
  std::array<NoteFlags*, 3> flags_{};
  bool following_ = true;
  double span_ = 20.0;
  double end_ = 0.0;
  std::optional<double> cursor_, mark_;
  std::optional<double> pointer_;  ///< x of the mouse that sets the cursor [px]; none: no mouse sets it
  View drawn_;                     ///< the view drawn last
  QElapsedTimer since_drawn_;
  QTimer later_;  ///< draws what was not worth drawing at once
  std::optional<QPointF> drag_from_;
  double drag_end_ = 0.0;
  bool dragged_ = false;
  QRubberBand* box_ = nullptr;  ///< while a box is drawn
};

}  // namespace capstan::widgets
