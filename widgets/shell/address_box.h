#pragma once

#include <QComboBox>
#include <string>

namespace capstan::widgets {

/// A list of addresses, each with a value beside its text, in which another one can be written.
QComboBox* editableBox();
/// Value of what was chosen in the list, or what was written.
std::string valueOf(const QComboBox& box);
/// Chooses the entry with this value, or writes it.
void setValue(QComboBox& box, const std::string& value);

}  // namespace capstan::widgets
