#include "widgets/panels/diagnosis/signature_view.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QShortcut>
#include <QSplitter>
#include <QTreeWidget>

#include "core/diagnosis/report/shown.h"
#include "widgets/figures/channel_note.h"
#include "widgets/figures/number_text.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

namespace {

using diagnosis::ChannelReport;
using diagnosis::Signature;

enum Column { kVariable, kBefore, kAfter, kColumns };
constexpr double kSignatureFont = 9.5;
constexpr int kNarrow = 720, kList = 250, kLeastList = 236;  ///< widths [px]

/// Finds the signature; null: none.
const Signature* against(const std::vector<Signature>& signatures, const std::string& variable) {
  for (const Signature& signature : signatures)
    if (signature.variable == variable) return &signature;
  return nullptr;
}

QString shareText(const Signature& signature) {
  return QString::fromStdString(diagnosis::shareWords(signature));
}

/// Sentence about the whole residual. Signatures describe its variation, so a constant part is named
/// separately.
QString wrongIn(const ChannelReport& channel, const QString& name) {
  const diagnosis::ChannelStatistics& s = channel.refitted_statistics;
  const double constant = s.rms > 0.0 ? s.mean * s.mean / (s.rms * s.rms) : 0.0;
  if (constant < 0.5) return QObject::tr("Residual of %1: ").arg(name);
  return QObject::tr("Residual of %1: %2 is constant, %3; of the rest ")
      .arg(name, QString::fromStdString(diagnosis::shareWords(constant)),
           QString::fromStdString(diagnosis::shownNumber(s.mean, 0.0, s.unit)));
}

/// Name of a variable: "velocity" for the channel's own joint, "velocity, joint 1" for another.
QString shortName(const Signature& signature, const diagnosis::Channel& channel) {
  const QString name = QString::fromStdString(signature.variable);
  const int of = name.lastIndexOf(QStringLiteral(" of joint "));
  if (of < 0) return name;
  return signature.joint == channel.joint ? name.left(of)
                                          : name.left(of) + QStringLiteral(", ") + name.mid(of + 4);
}

QTreeWidget* variableList() {
  auto* list = new QTreeWidget;
  list->setObjectName("variables");
  list->setColumnCount(kColumns);
  list->setHeaderLabels({QObject::tr("share of residual by"), QObject::tr("before"), QObject::tr("after")});
  list->headerItem()->setToolTip(
      kBefore,
      QObject::tr("Share of the refitted model's residual variance that this variable alone explains"));
  list->headerItem()->setToolTip(kAfter, QObject::tr("The same share for the extended model"));
  list->setRootIsDecorated(false);
  list->setUniformRowHeights(true);
  list->setFrameShape(QFrame::NoFrame);
  list->setAllColumnsShowFocus(true);
  list->setMinimumWidth(kLeastList);
  list->setAccessibleName(QObject::tr("variables, the strongest first"));
  list->header()->setStretchLastSection(false);
  list->header()->setMinimumSectionSize(10);
  list->header()->setFont(textFont(9.0));
  list->header()->setSectionResizeMode(kVariable, QHeaderView::Stretch);
  for (const int column : {kBefore, kAfter}) {
    list->setItemDelegateForColumn(column, new ShareBar(list));
    list->header()->setSectionResizeMode(column, QHeaderView::Fixed);
    list->header()->resizeSection(column, 58);
    list->headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  return list;
}

}  // namespace

SignatureView::SignatureView(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  channels_ = new QComboBox;
  channels_->setObjectName("signature_channel");
  channels_->setToolTip(tr("Which sensor's residual (Alt+C: the next)"));
  channels_->setAccessibleName(tr("channel of the signatures"));
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setFont(textFont(10.0, true));
  words_->setAccessibleName(tr("description of the signature"));
  row->addWidget(channels_, 0, Qt::AlignTop);
  row->addWidget(words_, 1);
  column->addLayout(row);
  split_ = new QSplitter(Qt::Horizontal);
  split_->setChildrenCollapsible(false);
  split_->addWidget(variables_ = variableList());
  auto* sheet = new QWidget;
  sheet_ = new QVBoxLayout(sheet);
  sheet_->setContentsMargins(0, 0, 0, 0);
  split_->addWidget(sheet);
  split_->setStretchFactor(0, 0);
  split_->setStretchFactor(1, 1);
  split_->setSizes({kList, 400});
  column->addWidget(split_, 1);
  connect(channels_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          &SignatureView::fillVariables);
  connect(variables_, &QTreeWidget::currentItemChanged, this, &SignatureView::draw);
  connect(new QShortcut(QKeySequence(QStringLiteral("Alt+C")), this), &QShortcut::activated, this, [this] {
    if (channels_->count() > 0)
      channels_->setCurrentIndex((channels_->currentIndex() + 1) % channels_->count());
  });
}

void SignatureView::setTheme(const Theme& theme) {
  theme_ = theme.isDark() ? &Theme::dark() : &Theme::light();  // figures keep a reference
  variables_->setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 2px; } "
                                           "QTreeWidget::item:selected { background: %1; color: %2; }")
                                .arg(theme.raised.name(), theme.text.name()));
  if (figure_) figure_->setTheme(*theme_);
}

void SignatureView::showReport(std::shared_ptr<const diagnosis::Report> report) {
  const QString shown = channels_->currentText();
  report_ = std::move(report);
  {
    const QSignalBlocker quiet(channels_);
    channels_->clear();
    for (const ChannelReport& channel : report_->channels)
      channels_->addItem(channelTitle(*report_, channel));
    channels_->setCurrentIndex(std::max(0, channels_->findText(shown)));
  }
  fillVariables();
}

void SignatureView::showChannel(const std::string& name) {
  if (!report_) return;
  for (std::size_t i = 0; i < report_->channels.size(); ++i) {
    if (report_->channels[i].refitted.name != name) continue;
    channels_->setCurrentIndex(static_cast<int>(i));
    variables_->setCurrentItem(variables_->topLevelItem(0));
    return;
  }
}

const ChannelReport* SignatureView::channel() const {
  const int index = channels_->currentIndex();
  return report_ && index >= 0 ? &report_->channels[static_cast<std::size_t>(index)] : nullptr;
}

void SignatureView::fillVariables() {
  {
    const QSignalBlocker quiet(variables_);
    variables_->clear();
    if (const ChannelReport* shown = channel())
      for (const Signature& signature : shown->before) {
        auto* item = new QTreeWidgetItem(
            {shortName(signature, shown->refitted), percentText(std::max(signature.share, 0.0))});
        ShareBar::set(*item, kBefore, signature.share, theme_->colour(Quantity::kKinematic));
        if (const Signature* after = against(shown->after, signature.variable); after && extended()) {
          item->setText(kAfter, percentText(std::max(after->share, 0.0)));
          ShareBar::set(*item, kAfter, after->share, theme_->colour(Quantity::kUkf));
        }
        item->setFont(kVariable, textFont(kSignatureFont));
        item->setToolTip(kVariable, QString::fromStdString(signature.variable));
        for (const int column : {kBefore, kAfter}) {
          item->setFont(column, numberFont(kSignatureFont - 0.5));
          item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
        }
        variables_->addTopLevelItem(item);
      }
    variables_->setCurrentItem(variables_->topLevelItem(0));
  }
  fitList();
  draw();
}

void SignatureView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fitList();
}

/// Fits the list to the width; a narrow view hides the column of the extended model, which the figure shows
/// too.
void SignatureView::fitList() {
  const bool narrow = width() < kNarrow;
  variables_->setColumnHidden(kAfter, narrow || !extended());
  if (narrow != narrow_) split_->setSizes({narrow ? kLeastList : kList, width()});
  narrow_ = narrow;
}

/// Draws the selected signature in a new figure, because the data of a figure cannot be changed.
void SignatureView::draw() {
  delete figure_;
  figure_ = nullptr;
  words_->clear();
  const int which = variables_->indexOfTopLevelItem(variables_->currentItem());
  const ChannelReport* shown = channel();
  if (!shown || which < 0) return;
  const Signature& before = shown->before[static_cast<std::size_t>(which)];
  const Signature* after = extended() ? against(shown->after, before.variable) : nullptr;
  const QString variable = QString::fromStdString(before.variable);
  const QString name = QString::fromStdString(before.channel);
  QString words = wrongIn(*shown, name) + tr("%1 correlates with %2").arg(shareText(before), variable);
  if (after) words += tr("; with the causes in the model %1").arg(shareText(*after));
  words_->setText(words + QLatin1Char('.'));
  SignatureData drawn;
  drawn.note = explainedNote(*report_, *shown);
  drawn.panels = {signaturePanel(*shown, static_cast<std::size_t>(which), extended())};
  figure_ = new SignatureFigure(std::move(drawn));
  figure_->setAccessibleName(words_->text());
  figure_->setTheme(*theme_);
  sheet_->addWidget(figure_);
}

QString SignatureView::words() const { return words_->text(); }

}  // namespace capstan::widgets
