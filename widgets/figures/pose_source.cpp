#include "widgets/figures/pose_source.h"

#include <QObject>

namespace capstan::widgets {

QString nameOf(PoseSource source) {
  switch (source) {
    case PoseSource::kCommanded:
      return QObject::tr("commanded");
    case PoseSource::kVisible:
      return QObject::tr("observed");
    case PoseSource::kOffset:
      return QObject::tr("rigid offset");
    case PoseSource::kCorrected:
      return QObject::tr("corrected");
  }
  return {};
}

Quantity quantityOf(PoseSource source) {
  switch (source) {
    case PoseSource::kCommanded:
      return Quantity::kTrue;
    case PoseSource::kVisible:
      return Quantity::kCamera;
    case PoseSource::kOffset:
      return Quantity::kKinematic;
    case PoseSource::kCorrected:
      return Quantity::kUkf;
  }
  return Quantity::kTrue;
}

}  // namespace capstan::widgets
