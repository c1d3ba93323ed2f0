// The time line in a real window: a time that was tracked is shown again with its images.
#include <QClipboard>

#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/replay/replay_bar.h"
#include "widgets/shell/plots_controller.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {
namespace {

TEST_F(Shell, ScrubbingShowsImagesAndValuesOfThatTime) {
  commandLine({"simulate", "--duration", "4", "--out", file("s.capstan")});
  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(SourceChoice::ofFile(file("s.capstan")));
  ASSERT_TRUE(waitFor([&] { return window->link().ended(); }));
  auto* replay = window->findChild<ReplayBar*>();
  auto* figure = window->findChild<JointFigure*>();
  auto* video = window->findChild<StereoView*>();
  ASSERT_TRUE(replay && figure && video);
  const QImage newest = video->left().grab().toImage();
  replay->review(1.5);
  ASSERT_TRUE(figure->cursorTime());
  EXPECT_NEAR(*figure->cursorTime(), 1.5, 1e-9);
  const QImage then = video->left().grab().toImage();
  EXPECT_NE(then, newest);
  replay->review(3.0);
  replay->review(1.5);
  EXPECT_EQ(video->left().grab().toImage(), then) << "the same time shows the same image";
  test::grab(*window, "shell_replay");
  replay->follow();
  EXPECT_FALSE(figure->cursorTime());
  EXPECT_EQ(video->left().grab().toImage(), newest) << "no other image comes after the end";
}

TEST_F(Shell, ANoteIsATickOfTheTimeLine) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  auto* replay = window->findChild<ReplayBar*>();
  window->findChild<NotesPanel*>()->addEvent(0.25, "note", "here");
  EXPECT_EQ(replay->line().eventAfter(0.1), 0.25);
}

TEST_F(Shell, ErrorsOfTheSessionAreInThePlots) {
  commandLine({"simulate", "--duration", "3", "--out", file("s.capstan")});
  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(SourceChoice::ofFile(file("s.capstan")));
  ASSERT_TRUE(waitFor([&] { return window->link().ended(); }));
  auto* figure = window->findChild<JointFigure*>();
  const double values = figure->plot(0).drawn()->size();
  figure->showErrors(true);
  figure->refresh(true);
  ASSERT_TRUE(figure->plot(0).drawn());
  EXPECT_LT(figure->plot(0).drawn()->size(), 0.3 * values);
  EXPECT_GT(figure->plot(0).graph(Quantity::kCamera)->dataCount(), 20);
  figure->showStatistics(true);
  QApplication::processEvents();
  test::grab(*window, "shell_errors");
  auto* plots = window->findChild<PlotsController*>();
  plots->copyNumbers();
  const QStringList lines = QApplication::clipboard()->text().split('\n');
  EXPECT_TRUE(lines[0].startsWith("t [s]\t")) << lines[0].toStdString();
  EXPECT_GT(lines.size(), 100);
  plots->copyPicture();
  EXPECT_EQ(QApplication::clipboard()->pixmap().size(), figure->size());
}

}  // namespace
}  // namespace capstan::widgets
