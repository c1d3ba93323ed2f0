#include "widgets/figures/pose_source.h"

#include <QObject>

namespace capstan::widgets {

QString nameOf(PoseSource source) {
  switch (source) {
    case PoseSource::kTold:
      return QObject::tr("told");
    case PoseSource::kSeen:
      return QObject::tr("as seen");
    case PoseSource::kOffset:
      return QObject::tr("rigid offset");
    case PoseSource::kCorrected:
      return QObject::tr("corrected");
  }
  return {};
}

Quantity quantityOf(PoseSource source) {
  switch (source) {
    case PoseSource::kTold:
      return Quantity::kTrue;
    case PoseSource::kSeen:
      return Quantity::kCamera;
    case PoseSource::kOffset:
      return Quantity::kKinematic;
    case PoseSource::kCorrected:
      return Quantity::kUkf;
  }
  return Quantity::kTrue;
}

}  // namespace capstan::widgets
