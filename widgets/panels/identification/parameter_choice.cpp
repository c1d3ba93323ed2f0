#include "widgets/panels/identification/parameter_choice.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>

namespace capstan::widgets {

namespace {

constexpr int kJoints = 3;
constexpr std::array<const char*, identification::kQuantities> kWords = {"radius", "stiffness", "damping",
                                                                         "friction"};

std::string nameOf(int quantity, int joint) {
  return std::string(base::nameOf(static_cast<identification::Quantity>(quantity))) +
         std::to_string(joint + 1);
}

}  // namespace

ParameterChoice::ParameterChoice(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(2);
  grid->setHorizontalSpacing(3);
  const auto head = [&](const QString& text, int row, int column) {
    auto* label = new QLabel(text);
    label->setFont(textFont(9.0));
    heads_.push_back(label);
    grid->addWidget(label, row, column, Qt::AlignLeft);
  };
  for (int quantity = 0; quantity < identification::kQuantities; ++quantity) {
    const QString words = kWords[static_cast<std::size_t>(quantity)];
    head(words, quantity, 0);
    for (int joint = 0; joint < kJoints; ++joint) {
      auto* box = new QCheckBox(QString::fromStdString(nameOf(quantity, joint)));
      box->setObjectName(box->text());
      box->setAccessibleName(
          tr("%1 of joint %2").arg(quantity == 0 ? tr("pulley radius") : words).arg(joint + 1));
      box->setToolTip(box->accessibleName());
      boxes_.push_back(box);
      grid->addWidget(box, quantity, joint + 1, Qt::AlignLeft);
      connect(box, &QCheckBox::toggled, this, &ParameterChoice::changed);
    }
  }
  grid->setColumnStretch(0, 1);
  grid->setRowStretch(identification::kQuantities, 1);
  setNames(identification::kDefaultParameters);
}

void ParameterChoice::setTheme(const Theme& theme) {
  for (auto* label : heads_) {
    QPalette palette = label->palette();
    palette.setColor(QPalette::WindowText, theme.muted);
    label->setPalette(palette);
  }
}

QCheckBox& ParameterChoice::box(identification::Quantity quantity, int joint) const {
  return *boxes_[static_cast<std::size_t>(kJoints * static_cast<int>(quantity) + joint)];
}

std::string ParameterChoice::names() const {
  QStringList ticked;
  for (const auto* box : boxes_)
    if (box->isChecked()) ticked << box->objectName();
  return ticked.join(',').toStdString();
}

void ParameterChoice::setNames(const std::string& names) {
  const QStringList wanted = QString::fromStdString(names).split(',', Qt::SkipEmptyParts);
  for (auto* box : boxes_) {
    const QString name = box->objectName();
    box->setChecked(wanted.contains(name) || wanted.contains(name.chopped(1)) || wanted.contains("all"));
  }
}

}  // namespace capstan::widgets
