#include "widgets/figures/signature_figure.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/report/shown.h"
#include "widgets/figures/channel_note.h"
#include "widgets/figures/figure_text.h"

namespace capstan::widgets {

namespace {

using diagnosis::ShownUnit;
using diagnosis::shownUnit;
using diagnosis::Signature;
using diagnosis::SignatureBin;
using diagnosis::VariableKind;

constexpr int kLeastSignatureWidth = 270;  ///< [px] of panels side by side
constexpr int kMostColumns = 3;
constexpr double kBarsBeyond = 0.25;    ///< limit to which the axis includes the bars, in ranges of the means
constexpr int kNoiseShade = 60;         ///< opacity of 255
constexpr double kWorthShowing = 0.02;  ///< share of the variance

QString fromUtf8(const std::string& text) { return QString::fromStdString(text); }

bool isDirection(const Signature& signature) { return signature.kind == VariableKind::kDirection; }

QString withUnit(const QString& name, const QString& unit) {
  return QStringLiteral("%1 [%2]").arg(name, unit.isEmpty() ? QStringLiteral("–") : unit);
}

QString percent(const Signature& signature) {
  QString text = QString::number(100.0 * signature.share, 'f', 0);
  if (const QString sigma = QString::number(100.0 * signature.share_sigma, 'f', 0);
      sigma != QLatin1String("0"))
    text += QStringLiteral(" ± ") + sigma;
  if (text == QLatin1String("-0")) text = QStringLiteral("0");
  return withMinus(text) + QStringLiteral(" %");
}

QString shareText(const Signature& signature) { return fromUtf8(diagnosis::shareWords(signature)); }

QString words(const SignaturePanel& panel) {
  QString text =
      QObject::tr("explains %1 (%2)")
          .arg(shareText(panel.before), unbroken(percent(panel.before) + QObject::tr(" of the variance")));
  if (panel.after)
    text += QObject::tr("; after: %1")
                .arg(unbroken(QStringLiteral("%1 (%2)").arg(shareText(*panel.after), percent(*panel.after))));
  return text;
}

std::vector<const Signature*> signaturesOf(const SignaturePanel& panel) {
  std::vector<const Signature*> all = {&panel.before};
  if (panel.after) all.push_back(&*panel.after);
  return all;
}

/// Range of the value axis that the panels of `channel` share, in units for people: zero, all means, the
/// sensor's noise, and the bars of the means within kBarsBeyond.
QCPRange valuesOf(const SignatureData& data, const std::string& channel) {
  QCPRange means(0.0, 0.0);
  const auto each = [&](const auto& take) {
    for (const SignaturePanel& panel : data.panels)
      if (panel.before.channel == channel)
        for (const Signature* signature : signaturesOf(panel))
          for (const SignatureBin& bin : signature->bins) take(shownUnit(panel.unit).scale, bin);
  };
  each([&](double scale, const SignatureBin& bin) { means.expand(scale * bin.mean); });
  const double reach = kBarsBeyond * means.size();
  QCPRange all = means;
  each([&](double scale, const SignatureBin& bin) {
    if (!std::isfinite(bin.interval.low) || !std::isfinite(bin.interval.high)) return;
    all.expand(std::clamp(scale * bin.interval.low, means.lower - reach, means.upper + reach));
    all.expand(std::clamp(scale * bin.interval.high, means.lower - reach, means.upper + reach));
  });
  for (const SignaturePanel& panel : data.panels)
    if (panel.before.channel == channel)
      for (const double sigma : {-panel.noise, panel.noise}) all.expand(shownUnit(panel.unit).scale * sigma);
  if (all.size() <= 0.0) return {-1.0, 1.0};
  return {all.lower - 0.06 * all.size(), all.upper + 0.06 * all.size()};
}

QCPRange variableOf(const SignaturePanel& panel) {
  if (isDirection(panel.before)) return {-1.5, 1.5};
  QCPRange range;
  bool first = true;
  for (const Signature* signature : signaturesOf(panel))
    for (const SignatureBin& bin : signature->bins)
      for (const double x : {bin.low, bin.high}) {
        if (first) range = {x, x};
        range.expand(x);
        first = false;
      }
  if (range.size() <= 0.0) return {range.lower - 1.0, range.lower + 1.0};
  const double scale = shownUnit(panel.before.unit).scale, margin = 0.02 * range.size();
  return {scale * (range.lower - margin), scale * (range.upper + margin)};
}

QSharedPointer<QCPAxisTicker> directionTicker() {
  const auto ticker = QSharedPointer<QCPAxisTickerText>::create();
  ticker->addTick(-1.0, QObject::tr("backwards"));
  ticker->addTick(0.0, QObject::tr("at rest"));
  ticker->addTick(1.0, QObject::tr("forwards"));
  return ticker;
}

QPen linePen(const Theme& theme, bool after, double line) {
  QPen pen(theme.colour(after ? Quantity::kUkf : Quantity::kKinematic), (after ? 1.6 : 1.3) * line);
  if (!after) pen.setDashPattern({4.0, 2.0});
  pen.setCapStyle(Qt::FlatCap);
  return pen;
}

/// A circle around a disc, so that both are visible at the same position.
QCPScatterStyle markStyle(const Theme& theme, bool after, double line) {
  const QColor ink = theme.colour(after ? Quantity::kUkf : Quantity::kKinematic);
  return {QCPScatterStyle::ssCircle, QPen(ink, 1.2 * line), QBrush(after ? ink : theme.surface),
          (after ? 4.0 : 7.0) * line};
}

/// Whether two signatures are correlated: torques of motor and joint, and the stretch between them.
bool muchTheSame(const Signature& a, const Signature& b) {
  const auto carries = [](VariableKind kind) {
    return kind == VariableKind::kMotorTorque || kind == VariableKind::kJointTorque ||
           kind == VariableKind::kStretch;
  };
  return a.joint == b.joint && carries(a.kind) && carries(b.kind);
}

LegendEntry entry(const QString& text, const Theme& theme, bool after, double line) {
  return {text, [&theme, after, line](QCPPainter* painter, const QRectF& box) {
            const QPen pen = linePen(theme, after, line);
            painter->setPen(pen);
            painter->drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()));
            painter->setPen(QPen(pen.color(), pen.widthF()));
            painter->drawLine(QPointF(box.center().x(), box.top()), QPointF(box.center().x(), box.bottom()));
            const QCPScatterStyle mark = markStyle(theme, after, line);
            mark.applyTo(painter, pen);
            mark.drawShape(painter, box.center());
          }};
}

}  // namespace

SignaturePanel signaturePanel(const diagnosis::ChannelReport& channel, std::size_t which, bool extended) {
  SignaturePanel panel{channel.before[which], {}, channel.refitted.unit, channel.refitted.noise};
  for (const Signature& after : channel.after)
    if (extended && after.variable == panel.before.variable) panel.after = after;
  return panel;
}

SignatureData strongestSignatures(const diagnosis::Report& report, const diagnosis::ChannelReport& channel,
                                  std::size_t most) {
  SignatureData data;
  data.title = QObject::tr("%1: dependence of its residual").arg(fromUtf8(channel.refitted.name));
  data.note = channelNote(report, channel);
  for (std::size_t i = 0; i < channel.before.size() && data.panels.size() < most; ++i) {
    const Signature& signature = channel.before[i];
    if (i > 0 && signature.share < std::max(kWorthShowing, 2.0 * signature.share_sigma)) break;
    const auto shown = [&](const SignaturePanel& panel) { return muchTheSame(panel.before, signature); };
    if (std::none_of(data.panels.begin(), data.panels.end(), shown))
      data.panels.push_back(signaturePanel(channel, i, !report.causes.empty()));
  }
  return data;
}

SignatureFigure::SignatureFigure(SignatureData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  for (const SignaturePanel& panel : data_.panels) build(panel);
  fit();
}

std::unique_ptr<Figure> SignatureFigure::copy() const { return std::make_unique<SignatureFigure>(data_); }

void SignatureFigure::build(const SignaturePanel& data) {
  const Signature& signature = data.before;
  const QString variable = fromUtf8(signature.variable), channel = fromUtf8(signature.channel);
  const Panel& panel = addPanel(
      {{tr("%1 against %2").arg(withUnit(channel, fromUtf8(shownUnit(data.unit).unit)), variable), true},
       {words(data), false}},
      withUnit(variable, fromUtf8(shownUnit(signature.unit).unit)),
      withUnit(tr("measured − simulated"), fromUtf8(shownUnit(data.unit).unit)));
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  x->setRange(variableOf(data));
  if (isDirection(signature)) x->setTicker(directionTicker());
  const QCPRange values = valuesOf(data_, signature.channel);
  y->setRange(values);
  Curves curves;
  if (data.noise > 0.0) {
    const double sigma = shownUnit(data.unit).scale * data.noise;
    curves.noise = new SigmaBand(panel.axes);
    curves.noise->begin();
    for (const double end : {x->range().lower, x->range().upper}) curves.noise->add(end, -sigma, sigma);
  }
  curves.before = addCurve(panel, signature, data.unit, values);
  if (data.after) curves.after = addCurve(panel, *data.after, data.unit, values);
  panel.empty->setVisible(signature.bins.empty());
  curves_.push_back(curves);
}

SignatureFigure::Curve SignatureFigure::addCurve(const Panel& panel, const Signature& signature,
                                                 const std::string& unit, const QCPRange& values) {
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  Curve curve{addGraph(x, y), new QCPErrorBars(x, y)};
  curve.bars->setDataPlottable(curve.means);
  curve.bars->setSymbolGap(0);
  curve.means->setAdaptiveSampling(false);
  const double x_scale = shownUnit(signature.unit).scale, y_scale = shownUnit(unit).scale;
  QVector<double> key, mean, below, above;
  for (const SignatureBin& bin : signature.bins) {
    key << x_scale * (isDirection(signature) ? std::round(bin.centre) : bin.centre);
    mean << y_scale * bin.mean;
    // SVG files have no clipping: bars are cut to the axis here.
    const auto reach = [&](double end) {
      const double cut = std::clamp(y_scale * end, values.lower, values.upper);
      return std::isfinite(cut) ? std::abs(cut - mean.back()) : 0.0;
    };
    below << reach(bin.interval.low);
    above << reach(bin.interval.high);
  }
  curve.means->setData(key, mean, true);
  curve.bars->setData(below, above);
  return curve;
}

int SignatureFigure::columnsFor(QSize size) const {
  const int panels = static_cast<int>(data_.panels.size());
  const int fitting = std::clamp(size.width() / kLeastSignatureWidth, 1, kMostColumns);
  return panels == 4 && fitting >= 2 ? 2 : std::min(panels, fitting);
}

void SignatureFigure::restyle() {
  const double line = scale().line;
  bool after = false, noise = false;
  QColor shade = theme().muted;
  shade.setAlpha(kNoiseShade);
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    if (curves_[i].noise) curves_[i].noise->setColour(shade);
    noise = noise || curves_[i].noise;
    panels()[i].axes->axis(QCPAxis::atLeft)->grid()->setZeroLinePen(QPen(theme().muted, 1.0 * line));
    for (const auto& [curve, is_after] : {std::pair{curves_[i].before, false}, {curves_[i].after, true}}) {
      if (!curve.means) continue;
      after = after || is_after;
      curve.means->setPen(linePen(theme(), is_after, line));
      curve.means->setScatterStyle(markStyle(theme(), is_after, line));
      curve.bars->setPen(QPen(linePen(theme(), is_after, line).color(), 1.0 * line));
      curve.bars->setWhiskerWidth(4.0 * line);
    }
  }
  std::vector<LegendEntry> entries = {
      entry(after ? tr("before: refitted model, mean ± 95 %") : tr("refitted model, mean ± 95 %"), theme(),
            false, line)};
  if (after) entries.push_back(entry(tr("after: with the causes in the model"), theme(), true, line));
  if (noise)
    entries.push_back({tr("sensor noise ± σ"),
                       [shade](QCPPainter* painter, const QRectF& box) { painter->fillRect(box, shade); }});
  setLegend(std::move(entries));
}

std::vector<FigureNumbers> SignatureFigure::numbers() const {
  std::string bins =
      "channel,unit,variable,variable_unit,model,bin_low,bin_high,centre,mean,low95,high95,samples\n";
  std::string summary = "channel,variable,model,share_of_variance,sigma\n";
  for (const SignaturePanel& panel : data_.panels)
    for (const Signature* signature : signaturesOf(panel)) {
      const ShownUnit x = shownUnit(signature->unit), y = shownUnit(panel.unit);
      const std::string model = signature == &panel.before ? "refitted" : "extended";
      const std::string channel = csvText(fromUtf8(signature->channel)),
                        variable = csvText(fromUtf8(signature->variable));
      summary += channel + "," + variable + "," + model + "," + csvNumber(signature->share) + "," +
                 csvNumber(signature->share_sigma) + "\n";
      for (const SignatureBin& bin : signature->bins) {
        bins += channel + "," + y.unit + "," + variable + "," + x.unit + "," + model;
        for (const double value : {bin.low, bin.high, bin.centre}) bins += "," + csvNumber(x.scale * value);
        for (const double value : {bin.mean, bin.interval.low, bin.interval.high})
          bins += "," + csvNumber(y.scale * value);
        bins += "," + std::to_string(bin.samples) + "\n";
      }
    }
  return {{"", bins}, {"_summary", summary}};
}

}  // namespace capstan::widgets
