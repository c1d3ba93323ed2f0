// A figure of your own, drawn from a recording and exported like the figures of Capstan.
//   own_figure ROBOT.yaml TABLE.csv BASE        writes BASE.pdf, BASE.svg, BASE.png, BASE.csv
#include "own_figure.h"

#include <QApplication>
#include <cstdio>

#include "core/base/error.h"
#include "core/recording/table_source.h"
#include "core/robot/description.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"
#include "widgets/figures/save_plot.h"

using namespace capstan;

namespace {

QPen dotPen(const widgets::Theme& theme) { return QPen(theme.colour(widgets::Quantity::kCamera), 1.0); }
QPen linePen(const widgets::Theme& theme) { return QPen(theme.muted, 1.0); }

}  // namespace

NisFigure::NisFigure(NisData data) : PanelFigure(nullptr), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  const Panel& panel = addPanel({{QStringLiteral("normalised innovation squared"), true}},
                                QStringLiteral("time [s]"), QStringLiteral("NIS / 3 [1]"));
  panel.empty->setVisible(data_.t.empty());
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  dots_ = addGraph(x, y);
  dots_->setLineStyle(QCPGraph::lsNone);
  dots_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, 2.0));
  expected_ = addGraph(x, y);
  if (!data_.t.empty()) {
    dots_->setData(QVector<double>(data_.t.begin(), data_.t.end()),
                   QVector<double>(data_.nis.begin(), data_.nis.end()), true);
    expected_->setData({data_.t.front(), data_.t.back()}, {1.0, 1.0}, true);
    x->setRange(data_.t.front(), data_.t.back());
    y->setRange(0.0, 5.0);
  }
  fit();
}

std::unique_ptr<widgets::Figure> NisFigure::copy() const { return std::make_unique<NisFigure>(data_); }

void NisFigure::restyle() {
  dots_->setPen(dotPen(theme()));
  expected_->setPen(linePen(theme()));
  setLegend({widgets::lineEntry(QStringLiteral("each measurement"), dotPen(theme())),
             widgets::lineEntry(QStringLiteral("expected"), linePen(theme()))});
}

std::vector<widgets::FigureNumbers> NisFigure::numbers() const {
  std::string rows = "t,nis\n";
  for (std::size_t i = 0; i < data_.t.size(); ++i)
    rows += widgets::csvNumber(data_.t[i]) + "," + widgets::csvNumber(data_.nis[i]) + "\n";
  return {{"", rows}};
}

int main(int count, char** arguments) {
  if (count != 4) return std::fputs("usage: own_figure ROBOT.yaml TABLE.csv BASE\n", stderr), 2;
  qputenv("QT_QPA_PLATFORM", "offscreen");  // files need no display
  const QApplication application(count, arguments);
  try {
    const auto source = recording::openRecording(arguments[2], robot::readDescription(arguments[1]));
    tracking::TrackingPipeline pipeline = tracking::makePipeline(source->info());
    NisData data{QString::fromStdString(source->info().title), {}, {}, {}};
    tracking::trackAll(*source, pipeline, nullptr, 0.0,
                       [&](const tracking::Sample& sample, const tracking::Snapshot& now) {
                         if (!std::holds_alternative<tracking::TipSample>(sample)) return;
                         if (!now.camera_updated || now.gate != tracking::Gate::kOpen) return;
                         data.t.push_back(now.t);
                         data.nis.push_back(now.nis / 3.0);
                       });
    for (const auto& file : widgets::exportFigure(NisFigure(std::move(data)), arguments[3]))
      std::puts(file.c_str());
    return 0;
  } catch (const base::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
