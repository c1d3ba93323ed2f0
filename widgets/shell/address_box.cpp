#include "widgets/shell/address_box.h"

namespace capstan::widgets {

QComboBox* editableBox() {
  auto* box = new QComboBox;
  box->setEditable(true);
  box->setInsertPolicy(QComboBox::NoInsert);
  box->setMinimumContentsLength(28);
  return box;
}

std::string valueOf(const QComboBox& box) {
  const int known = box.findText(box.currentText());
  return (known >= 0 && box.itemData(known).isValid() ? box.itemData(known).toString() : box.currentText())
      .trimmed()
      .toStdString();
}

void setValue(QComboBox& box, const std::string& value) {
  const QString text = QString::fromStdString(value);
  const int known = box.findData(text);
  known >= 0 ? box.setCurrentIndex(known) : box.setEditText(text);
}

}  // namespace capstan::widgets
