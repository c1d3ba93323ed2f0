#include "widgets/panels/notes/notes_panel.h"

#include <QFileInfo>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace capstan::widgets {

namespace {

enum Column { kTime, kText, kColumns };
constexpr int kTimeRole = Qt::UserRole, kKindRole = Qt::UserRole + 1, kPathRole = Qt::UserRole + 2;

/// Rows as high as their text, wrapped at the width of its column. Long words break after slashes and
/// underscores.
class WrappedRows : public QStyledItemDelegate {
 public:
  explicit WrappedRows(QTreeWidget& list) : QStyledItemDelegate(&list), list_(list) {}
  QString displayText(const QVariant& value, const QLocale&) const override {
    QString text = value.toString();
    for (const char* end : {"/", "_"}) text.replace(QLatin1String(end), QLatin1String(end) + QChar(0x200B));
    return text;
  }
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QSize size = QStyledItemDelegate::sizeHint(option, index);
    if (index.column() != kText) return size;
    QStyleOptionViewItem own = option;
    initStyleOption(&own, index);
    const int margin = 2 * (list_.style()->pixelMetric(QStyle::PM_FocusFrameHMargin, &own, &list_) + 1);
    const QRect room(0, 0, list_.columnWidth(kText) - 2 * margin, QWIDGETSIZE_MAX);
    const int text = own.fontMetrics.boundingRect(room, Qt::TextWordWrap, own.text).height();
    // The lines of the style are as high as a row of one line, which is more than the font's line spacing.
    size.setHeight(size.height() * std::max(1, qRound(1.0 * text / own.fontMetrics.lineSpacing())));
    return size;
  }

 private:
  QTreeWidget& list_;
};

/// A tool tip of several lines: Qt wraps only rich text. Long words, such as paths, break after slashes.
QString wrappedTip(const QString& text) {
  QString rich = text.toHtmlEscaped();
  rich.replace('/', QStringLiteral("/&#8203;")).replace('\n', QStringLiteral("<br>"));
  return QStringLiteral("<qt>%1</qt>").arg(rich);
}

}  // namespace

NotesPanel::NotesPanel(QWidget* parent) : QWidget(parent), list_(new QTreeWidget), line_(new QLineEdit) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 4, 8, 8);
  column->setSpacing(6);
  list_->setColumnCount(kColumns);
  list_->setHeaderHidden(true);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(false);
  list_->setWordWrap(true);
  list_->setItemDelegate(new WrappedRows(*list_));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setFocusPolicy(Qt::StrongFocus);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->header()->setSectionResizeMode(kTime, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(kText, QHeaderView::Stretch);
  list_->setToolTip(tr("Double click: show this time in the plots"));
  list_->setAccessibleName(tr("events of the session"));
  line_->setAccessibleName(tr("note"));
  line_->setMaxLength(500);
  line_->installEventFilter(this);
  column->addWidget(list_, 1);
  column->addWidget(line_);
  connect(list_, &QTreeWidget::itemActivated, this,
          [this](QTreeWidgetItem* item) { Q_EMIT timeChosen(item->data(kTime, kTimeRole).toDouble()); });
  connect(line_, &QLineEdit::returnPressed, this, [this] {
    const QString text = line_->text().trimmed();
    line_->clear();
    line_->clearFocus();
    if (!text.isEmpty()) Q_EMIT noteWritten(text);
  });
  list_->viewport()->installEventFilter(this);
  connect(list_->header(), &QHeaderView::sectionResized, &naming_, qOverload<>(&QTimer::start));
  naming_.setSingleShot(true);
  connect(&naming_, &QTimer::timeout, this, [this] {
    for (int i = 0; i < list_->topLevelItemCount(); ++i) nameFile(list_->topLevelItem(i));
    list_->doItemsLayout();  // rows are as high as their texts at this width
  });
  scroll_.setSingleShot(true);
  connect(&scroll_, &QTimer::timeout, list_, &QTreeWidget::scrollToBottom);
  setRecording(false);
  setTheme(theme_);
}

void NotesPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  for (int i = 0; i < list_->topLevelItemCount(); ++i) paintRow(list_->topLevelItem(i));
}

void NotesPanel::paintRow(QTreeWidgetItem* item) const {
  const QString kind = item->data(kTime, kKindRole).toString();
  item->setFont(kTime, numberFont(9.5));
  item->setForeground(kTime, theme_.muted);
  item->setFont(kText, textFont(10.0, kind == "note"));
  item->setForeground(kText, kind == "note" || kind == "fault" ? theme_.text : theme_.muted);
  item->setTextAlignment(kTime, Qt::AlignRight | Qt::AlignTop);
}

void NotesPanel::clear() { list_->clear(); }

void NotesPanel::addEvent(double t, const QString& kind, const QString& text) {
  const bool at_end =
      scroll_.isActive() || list_->verticalScrollBar()->value() == list_->verticalScrollBar()->maximum();
  auto* item = new QTreeWidgetItem;
  item->setText(kTime, tr("%1 s").arg(t, 0, 'f', 1));
  item->setText(kText, kind == "note" ? text : tr("%1: %2").arg(kind, text));
  item->setToolTip(kText, wrappedTip(text));
  item->setData(kTime, kTimeRole, t);
  item->setData(kTime, kKindRole, kind);
  paintRow(item);
  list_->addTopLevelItem(item);
  while (list_->topLevelItemCount() > kMostRows) delete list_->takeTopLevelItem(0);
  if (at_end) scroll_.start();
  Q_EMIT eventAdded(t, kind, text);
}

void NotesPanel::addFile(double t, const QString& kind, const QString& path) {
  addEvent(t, kind, QFileInfo(path).fileName());
  auto* item = list_->topLevelItem(list_->topLevelItemCount() - 1);
  item->setData(kTime, kPathRole, path);
  item->setToolTip(kText, path);
  nameFile(item);
}

/// Shortens a file name, which is one word and cannot be wrapped.
void NotesPanel::nameFile(QTreeWidgetItem* item) const {
  const QString path = item->data(kTime, kPathRole).toString();
  if (path.isEmpty()) return;
  const int margin = 2 * (list_->style()->pixelMetric(QStyle::PM_FocusFrameHMargin) + 1);
  const QString name =
      QFontMetrics(item->font(kText))
          .elidedText(QFileInfo(path).fileName(), Qt::ElideMiddle, list_->columnWidth(kText) - 2 * margin);
  item->setText(kText, tr("%1: %2").arg(item->data(kTime, kKindRole).toString(), name));
}

void NotesPanel::setRecording(bool recording) {
  line_->setPlaceholderText(recording ? tr("Note into the recording (N)")
                                      : tr("Note (N), filed while recording"));
}

void NotesPanel::beginNote() { line_->setFocus(Qt::ShortcutFocusReason); }

int NotesPanel::rows() const { return list_->topLevelItemCount(); }

QString NotesPanel::row(int index) const {
  const auto* item = list_->topLevelItem(index);
  return item ? item->text(kTime) + " " + item->text(kText) : QString();
}

bool NotesPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == list_->viewport() && event->type() == QEvent::Resize) naming_.start();
  if (watched == line_ && event->type() == QEvent::KeyPress &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    line_->clear();
    line_->clearFocus();
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace capstan::widgets
