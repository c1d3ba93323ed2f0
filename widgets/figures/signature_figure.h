#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"

namespace capstan::widgets {

/// One signature, in SI; drawn in units for people.
struct SignaturePanel {
  diagnosis::Signature before;                     ///< of the refitted model
  std::optional<diagnosis::Signature> after = {};  ///< of the extended one, against the same variable
  std::string unit;                                ///< of the residual: "rad" or "m"
  double noise = 0.0;                              ///< standard deviation of the sensor; 0: not shown
};

struct SignatureData {
  QString title = {}, note = {};
  std::vector<SignaturePanel> panels = {};
};

/// Signature `which` of channel.before beside the one in channel.after against the same variable; `extended`:
/// there are causes, so that there is an after.
SignaturePanel signaturePanel(const diagnosis::ChannelReport& channel, std::size_t which, bool extended);
/// The strongest of one channel, `most` of them; beyond the first only what explains something, and of the
/// torques and the stretch of one joint, which go together, only the strongest.
SignatureData strongestSignatures(const diagnosis::Report& report, const diagnosis::ChannelReport& channel,
                                  std::size_t most = 4);

/// What a simulation gets wrong against what it may depend on: the residual's mean in bins of a variable
/// with its 95 % interval, before and after causes were added to the model. Above each panel the share of the
/// residual's variance that the variable explains, in words and numbers. Panels of one channel have one
/// value axis, so that a strong signature looks strong beside a weak one, and the sensor's noise, ± σ, is
/// shaded and always within it, so that nothing does not look like something.
///     SignatureFigure figure({"q2", {}, {signaturePanel(channel, 0, !report.causes.empty())}});
///     SignatureFigure sheet(strongestSignatures(report, channel));
class SignatureFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit SignatureFigure(SignatureData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const SignatureData& data() const { return data_; }
  /// "before" and "after" of a panel; the latter null where there is none.
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
