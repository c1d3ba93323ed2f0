#include "widgets/shell/recording_card.h"

#include <QCryptographicHash>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QImageReader>
#include <QSet>
#include <QStandardPaths>
#include <QStringList>
#include <opencv2/core/mat.hpp>

#include "core/base/error.h"
#include "core/recording/recording_digest.h"

namespace capstan::widgets {

namespace {

// Texts in the image file of a card.
const QString kStamp = QStringLiteral("Stamp"), kDetails = QStringLiteral("Details"),
              kNoImage = QStringLiteral("NoImage");

QDir cache() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) +
              QStringLiteral("/capstan/recordings"));
}

QString nameOf(const QString& recording) {
  const QByteArray path = QFileInfo(recording).absoluteFilePath().toUtf8();
  return QString::fromLatin1(QCryptographicHash::hash(path, QCryptographicHash::Sha1).toHex()) + ".png";
}

/// Changes when the file does.
QString stampOf(const QString& recording) {
  const QFileInfo file(recording);
  return QStringLiteral("%1 %2").arg(file.lastModified().toMSecsSinceEpoch()).arg(file.size());
}

QString lengthWords(double seconds) {
  const int whole = qRound(seconds);
  return QStringLiteral("%1:%2").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
}

QString dateOf(const std::string& iso, const QFileInfo& file) {
  const QDateTime created = QDateTime::fromString(QString::fromStdString(iso), Qt::ISODate);
  return (created.isValid() ? created : file.lastModified()).toString(QStringLiteral("yyyy-MM-dd HH:mm"));
}

QImage imageOf(const cv::Mat& bgr) {
  if (bgr.empty()) return {};
  return QImage(bgr.data, bgr.cols, bgr.rows, static_cast<int>(bgr.step), QImage::Format_BGR888).copy();
}

RecordingCard cardOf(const QString& recording) {
  const QFileInfo file(recording);
  try {
    const auto digest = recording::digestOf(recording.toStdString(), kCardWidth);
    QStringList words{dateOf(digest.created, file)};
    if (digest.duration > 0.0) words << lengthWords(digest.duration);
    if (!digest.robot.empty()) words << QString::fromStdString(digest.robot);
    return {imageOf(digest.image), words.join(QStringLiteral(" · "))};
  } catch (const base::InputError&) {  // opening it says why
    return {{}, QObject::tr("%1 · not readable").arg(dateOf({}, file))};
  }
}

}  // namespace

bool readCard(const QString& recording, RecordingCard& card) {
  QImageReader reader(cache().filePath(nameOf(recording)));
  if (!reader.canRead() || reader.text(kStamp) != stampOf(recording)) return false;
  card.details = reader.text(kDetails);
  card.image = reader.text(kNoImage).isEmpty() ? reader.read() : QImage();
  return true;
}

void makeCard(const QString& recording) {
  const QString stamp = stampOf(recording);
  const RecordingCard card = cardOf(recording);
  QImage image = card.image;
  if (image.isNull()) {
    image = QImage(1, 1, QImage::Format_RGB32);
    image.fill(Qt::black);
    image.setText(kNoImage, QStringLiteral("yes"));
  }
  image.setText(kStamp, stamp);
  image.setText(kDetails, card.details);
  cache().mkpath(QStringLiteral("."));
  image.save(cache().filePath(nameOf(recording)));  // without a cache it is read again the next time
}

void keepCards(const QStringList& recordings) {
  QSet<QString> names;
  for (const QString& recording : recordings) names.insert(nameOf(recording));
  for (const QString& name : cache().entryList({QStringLiteral("*.png")}, QDir::Files))
    if (!names.contains(name)) cache().remove(name);
}

}  // namespace capstan::widgets
