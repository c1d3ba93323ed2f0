#pragma once

#include <QString>
#include <memory>
#include <string>
#include <vector>

#include "widgets/figures/theme.h"

class QCustomPlot;

namespace capstan::widgets {

/// A file of numbers beside a figure: `base` + suffix + ".csv".
struct FigureNumbers {
  std::string suffix;  ///< empty, or as "_summary"
  std::string csv;     ///< with a line of names; an empty cell where there is no value
};

/// A drawing that goes to screen and paper alike and knows its numbers. What is shown is a copy of plain data
/// given once, so that a figure can be drawn again at another size and in another theme.
class Figure {
 public:
  virtual ~Figure() = default;

  virtual QCustomPlot& canvas() = 0;
  virtual void setTheme(const Theme& theme) = 0;
  /// The same figure again, to be resized and coloured for paper.
  virtual std::unique_ptr<Figure> copy() const = 0;
  /// What it shows, in words: for captions and the files' titles.
  virtual QString caption() const = 0;
  virtual std::vector<FigureNumbers> numbers() const = 0;
};

}  // namespace capstan::widgets
