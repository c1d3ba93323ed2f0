#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <functional>
#include <map>

class QWidget;

namespace capstan::widgets {

/// Turns presses and releases into a toggle with a momentary side: a short press stays, a long one ends with
/// its release.
class HoldToggle {
 public:
  static constexpr qint64 kHoldMilliseconds = 350;

  void press() { pressed_.start(); }
  /// Whether the press that now ends was a hold.
  bool wasHeld() const { return pressed_.isValid() && pressed_.elapsed() >= kHoldMilliseconds; }

 private:
  QElapsedTimer pressed_;
};

/// Single keys for a whole window and its floating docks, with press and release and without auto-repeat;
/// silent while a text is being typed. No number holds them, so that number fields do not keep them.
class HoldKeys : public QObject {
  Q_OBJECT

 public:
  /// Listens in the window that holds `owner`.
  explicit HoldKeys(QWidget* owner);
  void bind(int key, std::function<void(bool pressed)> action) { actions_[key] = std::move(action); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool typing() const;

  QWidget* owner_;
  std::map<int, std::function<void(bool)>> actions_;
  std::map<int, bool> down_;
};

}  // namespace capstan::widgets
