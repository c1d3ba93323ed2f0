#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <functional>

namespace capstan::widgets {

/// Base class of exports that draw figures. Figures are widgets, so the export runs on the window's thread,
/// one step each time that the thread is idle.
class StepExport : public QObject {
  Q_OBJECT

 public:
  virtual bool busy() const = 0;

 signals:
  void progressed(double fraction, const QString& doing);
  /// The export has ended. `result`: path of what was written, empty if it is not complete; `words`: what was
  /// written, or the error.
  void ended(const QString& result, const QString& words);

 protected:
  explicit StepExport(QObject* parent);

  /// Calls step() until end().
  void begin() { timer_.start(0); }
  /// An exception ends the export with its text.
  virtual void step() = 0;
  /// Calls `part`; an exception ends the export with its text.
  void attempt(const std::function<void()>& part);
  /// Stops the steps, calls drop(), and emits ended().
  void end(const QString& result, const QString& words);
  /// If busy(), ends the export as cancelled by the user; `folder` is not complete.
  void endCancelled(const QString& folder);
  /// Drops the data of the export; it is not busy() afterwards.
  virtual void drop() = 0;

 private:
  QTimer timer_;
};

}  // namespace capstan::widgets
