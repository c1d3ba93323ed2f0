#pragma once

#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QString>
#include <string_view>

#include "core/base/field.h"

/// Rows of the form of a live set-up: one field of the file each, with its name and its meaning.
namespace capstan::widgets {

/// Meaning of a field, as its declaration states it.
template <class Setup>
QString meaningOf(std::string_view key) {
  QString meaning;
  Setup setup;
  Setup::visit(setup, [&](auto&, const base::FieldInfo& info) {
    if (info.key == key)
      meaning = QString::fromUtf8(info.meaning.data(), static_cast<int>(info.meaning.size()));
  });
  return meaning;
}

template <class Setup>
void nameField(QWidget* widget, const char* key) {
  widget->setObjectName(key);
  widget->setToolTip(meaningOf<Setup>(key));
}

template <class Setup>
void addField(QFormLayout* form, const QString& label, QWidget* widget, const char* key) {
  nameField<Setup>(widget, key);
  form->addRow(label, widget);
}

/// Two fields in one row.
template <class Setup>
void addFields(QFormLayout* form, const QString& label, QWidget* one, const char* key, QWidget* other,
               const char* other_key) {
  nameField<Setup>(one, key);
  nameField<Setup>(other, other_key);
  other->setAccessibleName(other_key);
  auto* line = new QHBoxLayout;
  line->addWidget(one, 1);
  line->addWidget(other, 1);
  form->addRow(label, line);
}

inline QDoubleSpinBox* numberBox(const QString& suffix, double most, int decimals) {
  auto* box = new QDoubleSpinBox;
  box->setRange(0.0, most);
  box->setDecimals(decimals);
  box->setSuffix(suffix);
  return box;
}

}  // namespace capstan::widgets
