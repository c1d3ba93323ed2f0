#include <QApplication>
#include <QDockWidget>
#include <QPainter>
#include <QScreen>
#include <QTemporaryDir>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "app/numbers.h"
#include "app/version.h"
#include "app/workstation/arguments.h"
#include "app/workstation/closing_signals.h"
#include "core/base/large_blocks.h"
#include "core/math/dense.h"
#include "widgets/scene/vtk_version.h"
#include "widgets/shell/estimate_publisher.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/monitor_controller.h"

namespace {

using capstan::workstation::Arguments;

/// Resizes the window to `size`, but not beyond the screen's free area; a picture always has `size`.
void fitToScreen(QWidget& window, const QSize& size, bool image) {
  const QScreen* screen = QGuiApplication::primaryScreen();
  window.resize(image || !screen ? size : size.boundedTo(screen->availableGeometry().size()));
}

/// Prints a failure to open on standard error and exits: for a screenshot nobody sees the message bar.
void failWithoutSource(capstan::widgets::MainWindow& window) {
  QObject::connect(&window.link(), &capstan::widgets::SessionLink::failed, &window,
                   [&window](const QString& message) {
                     if (window.link().runner()) return;
                     std::cerr << "capstan: " << message.toStdString() << '\n';
                     QApplication::exit(2);
                   });
}

/// Picture of the window with the docks that float over it.
QPixmap pictureOf(capstan::widgets::MainWindow& window) {
  QPixmap picture = window.grab();
  QPainter painter(&picture);
  for (auto* dock : window.findChildren<QDockWidget*>())
    if (dock->isFloating() && dock->isVisible()) painter.drawPixmap(dock->pos() - window.pos(), dock->grab());
  return picture;
}

/// Brings the window into the requested state, grabs it and quits.
void planScreenshot(capstan::widgets::MainWindow& window, const Arguments& arguments) {
  const int after = static_cast<int>(arguments.after * 1e3);
  if (arguments.state == "occluded")
    QTimer::singleShot(after * 3 / 4, Qt::PreciseTimer, &window, [&window] {
      if (window.link().runner()) window.link().runner()->block(true, false);
    });
  if (!arguments.show.empty())
    QTimer::singleShot(after / 2, Qt::PreciseTimer, &window,
                       [&window, name = QString::fromStdString(arguments.show)] {
                         QAction* action = window.action(name);
                         (action ? action : window.action("view_" + name))->trigger();
                       });
  if (arguments.state == "paused")
    QTimer::singleShot(after - 800, Qt::PreciseTimer, &window,
                       [&window] { window.link().setRunning(false); });
  QTimer::singleShot(after, Qt::PreciseTimer, &window, [&window, &arguments] {
    const bool saved = pictureOf(window).save(QString::fromStdString(arguments.image));
    if (!saved) std::cerr << "capstan: " << arguments.image << " cannot be written\n";
    QApplication::exit(saved ? 0 : 2);
  });
}

capstan::LibraryVersions libraries() {
  auto libraries = capstan::coreLibraries();
  libraries.emplace_back("Qt", qVersion());
  libraries.emplace_back("VTK", capstan::widgets::vtkVersionText());
  return libraries;
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App cli("Capstan: the workstation's window", "capstan");
  cli.set_version_flag("--version", capstan::versionText("capstan", libraries()));
  cli.get_formatter()->column_width(34);
  addOptions(cli, arguments);
  capstan::checkNumbers(cli);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : 2;
  }
  imply(cli, arguments);
  const QSize size = capstan::workstation::sizeOf(arguments.size);
  if (!std::getenv("DISPLAY")) {
    std::cerr << "capstan: no display (DISPLAY is not set). Use capstan-cli, or xvfb-run.\n";
    return 2;
  }
  QApplication application(argc, argv);
  capstan::workstation::closeOnSignals(application);
  const bool image = !arguments.image.empty();
  const QTemporaryDir own;  // a screenshot neither reads nor changes what the user chose
  capstan::widgets::MainWindow window(image ? own.filePath("settings.ini") : QString());
  if (!arguments.theme.empty()) window.setThemeNamed(QString::fromStdString(arguments.theme));
  if (!arguments.monitor_feed.empty())
    window.monitor().startFeed(QString::fromStdString(arguments.monitor_feed));
  if (!arguments.publish.empty())
    new capstan::widgets::EstimatePublisher(window.link(), arguments.publish, &window);
  const auto choice = choiceOf(arguments, window.lastSource());
  fitToScreen(window, size, image);
  if (image) failWithoutSource(window);
  window.show();
  window.open(choice);
  if (image) planScreenshot(window, arguments);
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  capstan::base::returnLargeBlocks();
  capstan::math::setDenseThreads(1);  // background work has threads of its own
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capstan: %s\n", error.what());
    return 2;
  }
}
