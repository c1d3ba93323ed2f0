#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"

namespace capstan::widgets {

/// One signature, in SI; the figure converts it to units for people.
struct SignaturePanel {
  diagnosis::Signature before;                     ///< signature of the refitted model's residual
  std::optional<diagnosis::Signature> after = {};  ///< of the extended model, against the same variable
  std::string unit;                                ///< unit of the residual: "rad" or "m"
  double noise = 0.0;                              ///< standard deviation of the sensor; 0: not shown
};

struct SignatureData {
  QString title = {}, note = {};
  std::vector<SignaturePanel> panels = {};
};

/// Signature `which` of channel.before, beside the one in channel.after against the same variable.
/// `extended`: causes were added, so that channel.after is valid.
SignaturePanel signaturePanel(const diagnosis::ChannelReport& channel, std::size_t which, bool extended);
/// The strongest signatures of one channel, at most `most`. After the first, only signatures that explain
/// variance are included. Torques and stretch of one joint are correlated; only the strongest of them is
/// included.
SignatureData strongestSignatures(const diagnosis::Report& report, const diagnosis::ChannelReport& channel,
                                  std::size_t most = 4);

/// Residual of a simulation against variables that it may depend on: the mean in bins of a variable with its
/// 95 % interval, before and after causes were added to the model. Above each panel is the share of the
/// residual's variance that the variable explains, in words and numbers. Panels of one channel share one
/// value axis, so that strong and weak signatures can be compared. The sensor's noise, ± σ, is shaded and
/// always within the axis, so that values within the noise are not mistaken for a signature.
///     SignatureFigure figure({"q2", {}, {signaturePanel(channel, 0, !report.causes.empty())}});
///     SignatureFigure sheet(strongestSignatures(report, channel));
class SignatureFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit SignatureFigure(SignatureData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const SignatureData& data() const { return data_; }
  /// Graphs "before" and "after" of a panel; after() is null where there is none.
  QCPGraph* before(std::size_t panel) const { return curves_[panel].before.means; }
  QCPGraph* after(std::size_t panel) const { return curves_[panel].after.means; }

 protected:
  int columnsFor(QSize size) const override;
  void restyle() override;

 private:
  struct Curve {
    QCPGraph* means = nullptr;
    QCPErrorBars* bars = nullptr;
  };
  struct Curves {
    Curve before, after;
    SigmaBand* noise = nullptr;
  };
  void build(const SignaturePanel& data);
  Curve addCurve(const Panel& panel, const diagnosis::Signature& signature, const std::string& unit,
                 const QCPRange& values);

  SignatureData data_;
  std::vector<Curves> curves_;
};

}  // namespace capstan::widgets
