#pragma once

#include <QImage>
#include <QString>

namespace capstan::widgets {

/// What a list shows of a recording: its first image, and date, duration and robot in words.
struct RecordingCard {
  QImage image;  ///< null: none
  QString details;
};

inline constexpr int kCardWidth = 96;  ///< width of the image [px]

/// The card of a recording in the user's cache; false: none is stored for the present state of the file.
bool readCard(const QString& recording, RecordingCard& card);
/// Reads the recording and stores its card. An unreadable recording has a card that reports it. Takes some
/// time.
void makeCard(const QString& recording);
/// Removes all stored cards but those of `recordings`.
void keepCards(const QStringList& recordings);

}  // namespace capstan::widgets
