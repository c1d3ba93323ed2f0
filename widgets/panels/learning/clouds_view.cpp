#include "widgets/panels/learning/clouds_view.h"

#include <QBoxLayout>
#include <QCheckBox>

#include "widgets/figures/pose_source.h"
#include "widgets/scene/cloud_view.h"

namespace capstan::widgets {

using learning::Reason;

namespace {

constexpr std::array kSources = {PoseSource::kCommanded, PoseSource::kVisible, PoseSource::kOffset,
                                 PoseSource::kCorrected};

QString nameOfLayer(int layer) {
  return layer == CloudsView::kRejected ? QObject::tr("rejected, with the offset")
                                        : nameOf(kSources[static_cast<std::size_t>(layer)]);
}

}  // namespace

CloudsView::CloudsView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 6, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->setSpacing(14);
  for (int k = 0; k < kLayers; ++k) {
    auto* box = layers_[static_cast<std::size_t>(k)] = new QCheckBox(nameOfLayer(k));
    box->setChecked(k != kVisible);
    connect(box, &QCheckBox::toggled, this, &CloudsView::draw);
    row->addWidget(box);
  }
  layers_[kVisible]->setToolTip(
      tr("In the frame of the cameras: it differs from that of the commands by the rigid offset"));
  row->addStretch();
  column->addLayout(row);
  column->addWidget(view_ = new CloudView, 1);
  view_->setEmptyWords(tr("Commanded and observed positions, once tables are read"));
}

QColor CloudsView::colourOf(Layer layer) const {
  return layer == kRejected ? theme_.warning
                            : theme_.colour(quantityOf(kSources[static_cast<std::size_t>(layer)]));
}

void CloudsView::setTheme(const Theme& theme) {
  theme_ = theme;
  view_->setTheme(theme);
  draw();
}

void CloudsView::showResults(const LearningResults& results) {
  results_ = results;
  gather();
  draw();
}

void CloudsView::gather() {
  points_ = {};
  if (!results_.stages) return;
  const auto& stages = *results_.stages;
  const bool corrected = results_.evaluation && !results_.evaluation->corrected.empty();
  for (std::size_t k = 0; k < stages.states.size(); ++k) {
    const learning::PosePair& pair = stages.states[k].pair;
    const Eigen::Vector3d moved = (stages.offset * pair.observed).translation();
    if (stages.cleaning.reason[k] != Reason::kNone) {
      points_[kRejected].push_back(moved);
      continue;
    }
    points_[kCommanded].emplace_back(pair.commanded.translation());
    points_[kVisible].emplace_back(pair.observed.translation());
    points_[kOffset].push_back(moved);
    if (corrected) points_[kCorrected].emplace_back(results_.evaluation->corrected[k].translation());
  }
}

void CloudsView::draw() {
  std::vector<PointCloud> clouds;
  for (int k = 0; k < kLayers; ++k) {
    const auto at = static_cast<std::size_t>(k);
    layers_[at]->setEnabled(!points_[at].empty());
    const bool shown = layers_[at]->isChecked();
    const bool framed = k == kCommanded || k == kOffset || (k == kVisible && shown);
    clouds.push_back({nameOfLayer(k), colourOf(static_cast<Layer>(k)), k == kRejected ? 3.0 : 2.0, shown,
                      framed, points_[at]});
  }
  view_->setClouds(std::move(clouds));
}

}  // namespace capstan::widgets
