#pragma once

#include <QWidget>
#include <memory>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/signature_figure.h"

class QComboBox;
class QLabel;
class QSplitter;
class QTreeWidget;
class QVBoxLayout;

namespace capstan::widgets {

/// Dependence of one channel's residual on variables: a list of variables, the strongest first, with the
/// share of variance that each explains before and after the causes were added, as bars; beside it the figure
/// of the selected variable and a sentence about it.
class SignatureView : public QWidget {
  Q_OBJECT

 public:
  explicit SignatureView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showReport(std::shared_ptr<const diagnosis::Report> report);
  /// Shows the channel of this name in the first recording, with its strongest signature; does nothing
  /// without one.
  void showChannel(const std::string& name);
  QComboBox& channels() { return *channels_; }
  QTreeWidget& variables() { return *variables_; }
  const SignatureFigure* figure() const { return figure_; }
  QString words() const;
  QSize minimumSizeHint() const override { return {300, 160}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  const diagnosis::ChannelReport* channel() const;
  bool extended() const { return report_ && !report_->causes.empty(); }
  void fillVariables();
  void draw();
  void fitList();

  const Theme* theme_ = &Theme::dark();
  std::shared_ptr<const diagnosis::Report> report_;
  QComboBox* channels_;
  QSplitter* split_;
  QTreeWidget* variables_;
  QLabel* words_;
  QVBoxLayout* sheet_;
  SignatureFigure* figure_ = nullptr;
  bool narrow_ = false;
};

}  // namespace capstan::widgets
