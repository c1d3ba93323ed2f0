#include "widgets/shell/settings_undo.h"

#include <QAction>
#include <QScopedValueRollback>
#include <QUndoCommand>
#include <QUndoStack>
#include <utility>

namespace capstan::widgets {

namespace {

constexpr int kSameChange = 1000;  ///< longest time between steps of one change, as of a number field [ms]

}  // namespace

/// One change of one setting.
class SettingChange : public QUndoCommand {
 public:
  SettingChange(const QString& name, std::function<void()> before, std::function<void()> after, bool joins,
                bool& applying)
      : QUndoCommand(name),
        before_(std::move(before)),
        after_(std::move(after)),
        joins_(joins),
        applying_(applying) {}

  void undo() override { apply(before_); }
  void redo() override {
    if (!std::exchange(made_, true)) return;  // pushing a command calls redo(), but the change is made
    apply(after_);
  }
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* newer) override {
    const auto& change = static_cast<const SettingChange&>(*newer);
    if (!change.joins_ || change.text() != text()) return false;
    after_ = change.after_;
    return true;
  }

 private:
  void apply(const std::function<void()>& value) {
    const QScopedValueRollback<bool> now(applying_, true);
    value();
  }

  std::function<void()> before_, after_;
  bool joins_, made_ = false;
  bool& applying_;
};

SettingsUndo::SettingsUndo(QObject* parent)
    : QObject(parent),
      stack_(new QUndoStack(this)),
      undo_(stack_->createUndoAction(this, tr("Undo"))),
      redo_(stack_->createRedoAction(this, tr("Redo"))) {
  stack_->setUndoLimit(kMost);
  undo_->setObjectName("undo");
  undo_->setShortcut(QKeySequence(QStringLiteral("Ctrl+Z")));
  redo_->setObjectName("redo");
  redo_->setShortcut(QKeySequence(QStringLiteral("Ctrl+Shift+Z")));
}

void SettingsUndo::changed(const QString& name, std::function<void()> before, std::function<void()> after) {
  if (applying_) return;
  const bool joins = since_last_.isValid() && since_last_.elapsed() < kSameChange;
  since_last_.start();
  stack_->push(new SettingChange(name, std::move(before), std::move(after), joins, applying_));
}

void SettingsUndo::clear() { stack_->clear(); }

}  // namespace capstan::widgets
