#include "widgets/shell/help_window.h"

#include <QAbstractTextDocumentLayout>
#include <QFileInfo>
#include <QLineEdit>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextTable>
#include <QVBoxLayout>

#include "core/base/error.h"
#include "core/base/resource.h"

namespace capstan::widgets {

namespace {

/// Style: thin lines between rows and padding in cells, where Qt would draw double frames.
void drawTablesQuietly(QTextDocument& document) {
  for (QTextFrame* frame : document.rootFrame()->childFrames()) {
    auto* table = qobject_cast<QTextTable*>(frame);
    if (!table) continue;
    QTextTableFormat format = table->format();
    format.setBorderCollapse(true);
    format.setBorder(1.0);
    format.setBorderBrush(QColor(128, 128, 128, 90));
    format.setCellPadding(5.0);
    table->setFormat(format);
  }
}

/// The heading with this text; an invalid block: there is none.
QTextBlock headingOf(const QTextDocument& document, const QString& text) {
  QTextBlock block = document.begin();
  while (block.isValid() && (block.blockFormat().headingLevel() == 0 || block.text() != text))
    block = block.next();
  return block;
}

}  // namespace

/// Shrinks images to the width of the page.
class HelpWindow::Pages : public QTextBrowser {
 public:
  QVariant loadResource(int type, const QUrl& name) override {
    const QVariant found = QTextBrowser::loadResource(type, name);
    if (type != QTextDocument::ImageResource) return found;
    const QImage image =
        found.userType() == QMetaType::QImage ? found.value<QImage>() : QImage::fromData(found.toByteArray());
    const int width = viewport()->width() - 40;
    return image.width() > width ? image.scaledToWidth(width, Qt::SmoothTransformation) : image;
  }
};

HelpWindow::HelpWindow(QWidget* parent) : QDialog(parent), pages_(new Pages) {
  setWindowTitle(tr("Capstan manual"));
  resize(860, 760);
  auto* column = new QVBoxLayout(this);
  auto* words = new QLineEdit;
  words->setPlaceholderText(tr("Find in the manual: type and press Enter"));
  words->setClearButtonEnabled(true);
  connect(words, &QLineEdit::returnPressed, this, [this, words] { find(words->text()); });
  column->addWidget(words);
  column->addWidget(pages_, 1);
  pages_->setOpenExternalLinks(true);
  pages_->setFrameShape(QFrame::NoFrame);
  pages_->resize(820, 700);
  connect(pages_, &QTextBrowser::sourceChanged, this, [this] { drawTablesQuietly(*pages_->document()); });
  open(QStringLiteral("manual.md"));
}

/// With a source, links lead to the other pages and back.
void HelpWindow::open(const QString& page) {
  try {
    const QString path = QString::fromStdString(base::resource("manual/" + page.toStdString()).string());
    pages_->setSearchPaths({QFileInfo(path).absolutePath()});
    pages_->setSource(QUrl::fromLocalFile(path));
  } catch (const base::InputError& error) {
    pages_->setPlainText(QString::fromStdString(error.what()));
  }
}

void HelpWindow::show(const HelpTopic& topic) {
  show();
  raise();
  if (QFileInfo(pages_->source().path()).fileName() != topic.page) open(topic.page);
  const QTextBlock heading = headingOf(*pages_->document(), topic.section);
  QTextCursor begin(pages_->document());
  if (heading.isValid()) begin.setPosition(heading.position());
  pages_->setTextCursor(begin);
  const double top =
      heading.isValid() ? pages_->document()->documentLayout()->blockBoundingRect(heading).top() : 0.0;
  pages_->verticalScrollBar()->setValue(static_cast<int>(top));
}

QString HelpWindow::section() const {
  QTextBlock block = pages_->cursorForPosition(QPoint(2, 2)).block();
  while (block.isValid() && block.blockFormat().headingLevel() == 0) block = block.previous();
  return block.text();
}

QString HelpWindow::text() const { return pages_->toPlainText(); }

void HelpWindow::find(const QString& words) {
  if (words.isEmpty() || pages_->find(words)) return;
  pages_->moveCursor(QTextCursor::Start);
  pages_->find(words);
}

}  // namespace capstan::widgets
