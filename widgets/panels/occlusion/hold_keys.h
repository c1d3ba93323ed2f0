#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <functional>
#include <map>

class QWidget;

namespace capstan::widgets {

/// Distinguishes short presses, which toggle, from long ones, which are undone at their release.
class HoldToggle {
 public:
  static constexpr qint64 kHoldMilliseconds = 350;

  void press() { pressed_.start(); }
  /// Whether the press that ends now was a long one.
  bool wasHeld() const { return pressed_.isValid() && pressed_.elapsed() >= kHoldMilliseconds; }

 private:
  QElapsedTimer pressed_;
};

/// Single keys for a whole window and its floating docks, with press and release, without auto-repeat.
/// Ignored while the user types text. The keys do not occur in numbers, so they also work while a number
/// field has the focus.
class HoldKeys : public QObject {
  Q_OBJECT

 public:
  /// Handles keys in the window that contains `owner`.
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
