#pragma once

#include <QString>
#include <memory>

#include "core/session/source.h"

class QSettings;

namespace capstan::widgets {

/// What the user asked to open; kept between starts.
struct SourceChoice {
  bool simulated = true;
  QString file;                ///< session or measured table, where not simulated
  QString trajectory = "fls";  ///< fls, sinusoid or hold
  QString truth = "default";   ///< default or matched
  unsigned seed = 1;
  double duration = 200.0;  ///< [s]

  void save(QSettings& settings) const;
  static SourceChoice restore(const QSettings& settings);
};

/// Opens it. Takes a moment (a simulation registers its cameras first). Throws base::InputError.
std::unique_ptr<session::Source> openSource(const SourceChoice& choice);

}  // namespace capstan::widgets
