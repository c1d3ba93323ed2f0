#include "widgets/panels/health/health_text.h"

namespace capstan::widgets {

using tracking::HealthVerdict;

QString verdictText(HealthVerdict verdict) {
  constexpr const char* kSigns[] = {"–", "✓", "!", "✗"};
  const auto name = base::nameOf(verdict);
  return QStringLiteral("%1 %2").arg(QString::fromUtf8(kSigns[static_cast<int>(verdict)]),
                                     QString::fromUtf8(name.data(), static_cast<int>(name.size())));
}

QColor verdictColour(HealthVerdict verdict, const Theme& theme) {
  switch (verdict) {
    case HealthVerdict::kPass:
      return theme.text;
    case HealthVerdict::kCautious:
      return theme.inkOf(theme.warning);
    case HealthVerdict::kFail:
      return theme.inkOf(theme.fault);
    case HealthVerdict::kUnknown:
      break;
  }
  return theme.muted;
}

}  // namespace capstan::widgets
