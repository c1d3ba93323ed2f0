#pragma once

#include "core/learning/model/confidence_slice.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

struct ConfidenceData {
  QString title = {}, note = {};
  learning::ConfidenceSlice slice = {};
};

/// Map of the confidence of a correction, 0 to 1, over a plane of the workspace, with the training positions
/// near that plane. Both axes have the same scale.
class ConfidenceFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit ConfidenceFigure(ConfidenceData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const ConfidenceData& data() const { return data_; }

 protected:
  int columnsFor(QSize) const override { return 1; }
  void restyle() override;
  void laidOut() override;

 private:
  ConfidenceData data_;
  QCPColorMap* map_;
  QCPGraph* learned_;
};

}  // namespace capstan::widgets
