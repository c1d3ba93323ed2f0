#include "widgets/figures/theme.h"

#include <QApplication>
#include <QFile>
#include <QPalette>
#include <QStyleFactory>
#include <algorithm>
#include <cmath>

#include "core/base/resource.h"

namespace capstan::widgets {

namespace {

Theme makeDark() {
  Theme theme;
  theme.name = "dark";
  theme.window = QColor("#14171b");
  theme.surface = QColor("#1b1f24");
  theme.raised = QColor("#272d34");
  theme.border = QColor("#39414a");
  theme.grid = QColor("#2e353d");
  theme.text = QColor("#eef1f4");
  theme.muted = QColor("#a3adb8");
  theme.accent = QColor("#4c9be8");
  theme.on_accent = QColor("#0b0e11");
  theme.warning = QColor("#e69f00");
  theme.fault = QColor("#cc79a7");
  theme.occluded = QColor(230, 159, 0, 40);
  theme.truth = Qt::white;
  return theme;
}

Theme makeLight() {
  Theme theme;
  theme.name = "light";
  theme.window = QColor("#eceef1");
  theme.surface = QColor("#ffffff");
  theme.raised = QColor("#f4f5f7");
  theme.border = QColor("#c4cad1");
  theme.grid = QColor("#e2e5e9");
  theme.text = QColor("#15181c");
  theme.muted = QColor("#56606b");
  theme.accent = QColor("#1f6fc0");
  theme.on_accent = QColor("#ffffff");
  theme.warning = QColor("#e69f00");
  theme.fault = QColor("#cc79a7");
  theme.occluded = QColor(230, 159, 0, 46);
  theme.truth = Qt::black;
  return theme;
}

/// Relative luminance, 0…1 (WCAG 2.1).
double luminanceOf(const QColor& colour) {
  const auto linear = [](double share) {
    return share <= 0.03928 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

/// The style sheet of resources/style with @names replaced by the theme's colours.
QString styleSheet(const Theme& theme) {
  QFile file(QString::fromStdString(base::resource("style/capstan.qss").string()));
  if (!file.open(QIODevice::ReadOnly)) return {};
  QString text = QString::fromUtf8(file.readAll());
  const std::pair<const char*, QColor> names[] = {
      {"@on_accent", theme.on_accent}, {"@accent", theme.accent}, {"@window", theme.window},
      {"@surface", theme.surface},     {"@raised", theme.raised}, {"@border", theme.border},
      {"@text", theme.text},           {"@muted", theme.muted},   {"@warning", theme.warning},
      {"@fault", theme.fault}};
  for (const auto& [name, colour] : names) text.replace(QLatin1String(name), colour.name());
  return text;
}

}  // namespace

QString nameOf(Quantity quantity) {
  switch (quantity) {
    case Quantity::kTrue:
      return "true";
    case Quantity::kKinematic:
      return "kinematic";
    case Quantity::kCamera:
      return "camera";
    case Quantity::kUkf:
      return "UKF";
  }
  return {};
}

const Theme& Theme::dark() {
  static const Theme theme = makeDark();
  return theme;
}

const Theme& Theme::light() {
  static const Theme theme = makeLight();
  return theme;
}

const Theme& Theme::named(const QString& name) { return name == QLatin1String("light") ? light() : dark(); }

QColor Theme::colour(Quantity quantity) const {
  switch (quantity) {
    case Quantity::kTrue:
      return truth;
    case Quantity::kKinematic:
      return QColor("#D55E00");
    case Quantity::kCamera:
      return QColor("#56B4E9");
    case Quantity::kUkf:
      return QColor("#009E73");
  }
  return {};
}

QColor Theme::inkOf(const QColor& colour) const {
  constexpr double kStep = 0.02;
  const double way = isDark() ? kStep : -kStep;
  QColor ink = colour;
  const auto legible = [&](const QColor& ground) { return contrastOf(ink, ground) >= kLeastContrast; };
  while (!(legible(window) && legible(surface) && legible(raised))) {
    const double lightness = ink.lightnessF() + way;
    if (lightness < 0.0 || lightness > 1.0) break;
    ink = QColor::fromHslF(ink.hslHueF(), ink.hslSaturationF(), lightness).rgb();
  }
  return ink;
}

QPen Theme::pen(Quantity quantity) const {
  const QColor ink = colour(quantity);
  switch (quantity) {
    case Quantity::kTrue:
      return QPen(ink, 1.0);
    case Quantity::kKinematic:
      return QPen(ink, 2.2, Qt::DashLine);
    case Quantity::kCamera:
      return QPen(ink, 0.0, Qt::NoPen);
    case Quantity::kUkf:
      return QPen(ink, 3.6, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin);
  }
  return {};
}

QColor Theme::band() const {
  QColor fill = colour(Quantity::kUkf);
  fill.setAlpha(70);
  return fill;
}

double contrastOf(const QColor& a, const QColor& b) {
  const auto [darker, lighter] = std::minmax({luminanceOf(a), luminanceOf(b)});
  return (lighter + 0.05) / (darker + 0.05);
}

QFont textFont(double points, bool bold) {
  QFont font("DejaVu Sans");
  font.setStyleHint(QFont::SansSerif);
  font.setPointSizeF(points);
  font.setBold(bold);
  return font;
}

QFont numberFont(double points, bool bold) {
  QFont font("DejaVu Sans Mono");
  font.setStyleHint(QFont::Monospace);
  font.setFixedPitch(true);
  font.setPointSizeF(points);
  font.setBold(bold);
  return font;
}

QString noticeStyle(const Theme& theme, const QColor& edge) {
  return QStringLiteral("background:%1; border-left:4px solid %2; color:%3;")
      .arg(theme.raised.name(), edge.name(), theme.text.name());
}

void restyle(QWidget& widget, const QString& style_sheet) {
  if (widget.styleSheet() != style_sheet) widget.setStyleSheet(style_sheet);
}

void applyTheme(QApplication& application, const Theme& theme) {
  application.setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  palette.setColor(QPalette::Window, theme.window);
  palette.setColor(QPalette::WindowText, theme.text);
  palette.setColor(QPalette::Base, theme.surface);
  palette.setColor(QPalette::AlternateBase, theme.raised);
  palette.setColor(QPalette::Text, theme.text);
  palette.setColor(QPalette::Button, theme.raised);
  palette.setColor(QPalette::ButtonText, theme.text);
  palette.setColor(QPalette::BrightText, theme.fault);
  palette.setColor(QPalette::Highlight, theme.accent);
  palette.setColor(QPalette::HighlightedText, theme.on_accent);
  palette.setColor(QPalette::ToolTipBase, theme.raised);
  palette.setColor(QPalette::ToolTipText, theme.text);
  palette.setColor(QPalette::Link, theme.accent);
  palette.setColor(QPalette::Mid, theme.border);
  palette.setColor(QPalette::PlaceholderText, theme.muted);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, theme.muted);
  application.setPalette(palette);
  application.setFont(textFont(10.5));
  application.setStyleSheet(styleSheet(theme));
}

}  // namespace capstan::widgets
