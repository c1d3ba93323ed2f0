#pragma once

#include <QString>
#include <memory>
#include <string>
#include <vector>

#include "widgets/figures/theme.h"

class QCustomPlot;

namespace capstan::widgets {

/// A file with the numbers of a figure: `base` + suffix + ".csv".
struct FigureNumbers {
  std::string suffix;  ///< empty, or for example "_summary"
  std::string csv;     ///< with a header line; cells without a value are empty
};

/// A drawing for screen and paper that can also return its numbers. It holds a copy of its data, so that it
/// can be drawn again at another size and in another theme.
class Figure {
 public:
  virtual ~Figure() = default;

  virtual QCustomPlot& canvas() = 0;
  virtual void setTheme(const Theme& theme) = 0;
  /// A copy of the figure, to be resized and coloured for paper.
  virtual std::unique_ptr<Figure> copy() const = 0;
  /// Description of the figure in words, for captions and titles of files.
  virtual QString caption() const = 0;
  virtual std::vector<FigureNumbers> numbers() const = 0;
};

}  // namespace capstan::widgets
