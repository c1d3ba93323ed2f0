#include "widgets/panels/diagnosis/tolerance_edit.h"

#include <QBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>

#include "core/base/error.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"

namespace capstan::widgets {

ToleranceEdit::ToleranceEdit(QWidget* parent)
    : QWidget(parent), edit_(new QLineEdit), name_(new QLabel(tr("Tolerance"))), words_(new QLabel) {
  constexpr int kEditWidth = 150;  // of "0.02deg,0.02mm" and a little more [px]
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  edit_->setObjectName("tolerance");
  edit_->setFixedWidth(kEditWidth);
  edit_->setAccessibleName(tr("tolerance of a cause"));
  edit_->setToolTip(
      tr("Smallest displacement of a joint that makes an effect a cause: an angle, a length, or both. "
         "Units: deg, rad, mm, um, m. Smaller effects are listed as also measurable."));
  name_->setBuddy(edit_);
  words_->setObjectName("tolerance_words");
  words_->setWordWrap(true);
  words_->setAccessibleName(tr("error of the tolerance"));
  row->addWidget(name_);
  row->addWidget(edit_);
  row->addWidget(words_, 1);
  setText(DiagnosisChoice().material);
  connect(edit_, &QLineEdit::textChanged, this, [this] {
    check();
    Q_EMIT changed();
  });
}

void ToleranceEdit::setTheme(const Theme& theme) {
  theme_ = theme;
  check();
}

QString ToleranceEdit::text() const { return edit_->text().trimmed(); }

void ToleranceEdit::setText(const QString& text) {
  if (text == this->text()) return check();  // the cursor stays
  const QSignalBlocker quiet(edit_);
  edit_->setText(text);
  check();
}

void ToleranceEdit::check() {
  error_.clear();
  try {
    toleranceOf(text());
  } catch (const base::InputError& error) {
    error_ = QString::fromStdString(error.what());
  }
  words_->setText(error_.isEmpty() ? tr("joint motion, RMS") : error_);
  QPalette palette = words_->palette();
  palette.setColor(QPalette::WindowText, error_.isEmpty() ? theme_.muted : theme_.inkOf(theme_.fault));
  words_->setPalette(palette);
}

}  // namespace capstan::widgets
