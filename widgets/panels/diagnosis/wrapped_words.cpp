#include "widgets/panels/diagnosis/wrapped_words.h"

#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <algorithm>

#include "widgets/figures/text_row.h"

namespace capstan::widgets {

namespace {

constexpr int kWordsRole = Qt::UserRole + 20;
constexpr int kMargins = 20;  ///< of an item, with its padding [px]
constexpr int kLeast = 60;    ///< narrowest text [px]

int depthOf(const QTreeWidgetItem& item) {
  int depth = 0;
  for (const QTreeWidgetItem* up = item.parent(); up; up = up->parent()) ++depth;
  return depth;
}

}  // namespace

void setWords(QTreeWidgetItem& item, int column, const QString& words) {
  item.setData(column, kWordsRole, words);
  item.setText(column, words);
}

QString wordsOf(const QTreeWidgetItem& item, int column) {
  const QVariant words = item.data(column, kWordsRole);
  return words.isValid() ? words.toString() : item.text(column);
}

void wrapWords(QTreeWidget& tree, int column) {
  for (QTreeWidgetItemIterator it(&tree); *it; ++it) {
    QTreeWidgetItem& item = **it;
    if (!item.data(column, kWordsRole).isValid()) continue;
    const int width = item.isFirstColumnSpanned() ? tree.viewport()->width() : tree.columnWidth(column);
    const int levels = depthOf(item) + (tree.rootIsDecorated() ? 1 : 0);
    const int room = std::max(kLeast, width - levels * tree.indentation() - kMargins);
    const QString wrapped = wrapText(wordsOf(item, column), item.font(column), room).join(QLatin1Char('\n'));
    if (wrapped != item.text(column)) item.setText(column, wrapped);
  }
}

}  // namespace capstan::widgets
