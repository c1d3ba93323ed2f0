#pragma once

#include <QTreeWidgetItem>

namespace capstan::widgets {

/// Sets the text of a cell that wrapWords() wraps. Qt's views elide texts that are wider than their column.
void setWords(QTreeWidgetItem& item, int column, const QString& words);
/// The text as it was set, without line breaks; texts that setWords() did not set as they are.
QString wordsOf(const QTreeWidgetItem& item, int column);
/// Wraps all such texts of a column to its present width; those of spanned items to the width of the view.
void wrapWords(QTreeWidget& tree, int column);

}  // namespace capstan::widgets
