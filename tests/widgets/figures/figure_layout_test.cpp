#include <gtest/gtest.h>

#include "tests/widgets/figures/every_figure.h"
#include "tests/widgets/figures/layout_check.h"
#include "tests/widgets/picture.h"
#include "widgets/figures/page_layout.h"

namespace capstan::widgets {
namespace {

const PaperSize kSizes[] = {{88.0, 60.0}, {88.0, 90.0}, {180.0, 120.0}, {180.0, 240.0}};

class FigureLayout : public ::testing::TestWithParam<int> {};

TEST_P(FigureLayout, EveryPanelHasRoomAndNothingStandsUponAnything) {
  const EveryFigure it = everyFigure()[static_cast<std::size_t>(GetParam())];
  const auto figure = it.make();
  for (const PaperSize& size : kSizes)
    for (const bool titles : {true, false}) {
      const auto pages = pagesOf(*figure, {size, titles});
      for (std::size_t i = 0; i < pages.size(); ++i) {
        auto& page = dynamic_cast<PanelFigure&>(pages[i]->canvas());
        page.replot(QCustomPlot::rpImmediateRefresh);
        EXPECT_EQ(page.viewport().size(), size.dots());
        const QStringList faults = test::layoutFaults(page);
        EXPECT_TRUE(faults.isEmpty())
            << it.name << " at " << size.width_mm << " x " << size.height_mm << " mm, page " << i + 1
            << " of " << pages.size() << ":\n  " << faults.join("\n  ").toStdString();
      }
    }
}

/// Pages side by side on one picture, each with its name.
class ContactSheet {
 public:
  ContactSheet(int columns, QSize page) : columns_(columns), page_(page) {}

  void add(const QImage& image, const QString& name) { entries_.push_back({image, name}); }

  QImage image() const {
    const int rows = (static_cast<int>(entries_.size()) + columns_ - 1) / columns_;
    const QSize cell = page_ + QSize(kGap, kGap + kName);
    QImage sheet(columns_ * cell.width() + kGap, rows * cell.height() + kGap, QImage::Format_RGB32);
    sheet.fill(QColor("#b0b8c0"));
    QPainter painter(&sheet);
    painter.setFont(textFont(9.0));
    for (int i = 0; i < static_cast<int>(entries_.size()); ++i) {
      const QPoint at(kGap + (i % columns_) * cell.width(), kGap + (i / columns_) * cell.height());
      painter.drawText(at + QPoint(0, kName - 5), entries_[static_cast<std::size_t>(i)].name);
      painter.drawImage(at + QPoint(0, kName), entries_[static_cast<std::size_t>(i)].image);
    }
    return sheet;
  }

 private:
  static constexpr int kGap = 12, kName = 20;
  struct Entry {
    QImage image;
    QString name;
  };
  int columns_;
  QSize page_;
  std::vector<Entry> entries_;
};

/// CAPSTAN_PICTURES=folder figure_layout_test --gtest_filter='*ContactSheets*' leaves one sheet a size there.
TEST(FigureContactSheets, ShowEveryFigureAtEverySize) {
  constexpr double kScale = 1.6;
  for (const PaperSize& size : kSizes) {
    ContactSheet sheet(size.width_mm < 100.0 ? 5 : 3, size.dots() * kScale);
    for (const EveryFigure& it : everyFigure()) {
      const auto pages = pagesOf(*it.make(), {size});
      for (std::size_t i = 0; i < pages.size(); ++i) {
        const QImage image = pages[i]->canvas().toPixmap(0, 0, kScale).toImage();
        EXPECT_EQ(image.size(), size.dots() * kScale);
        EXPECT_GT(test::count(image, image.rect(), Theme::light().text, 60).pixels, 200)
            << it.name << ": there are no words";
        sheet.add(image,
                  QString::fromStdString(it.name) + QStringLiteral(" %1/%2").arg(i + 1).arg(pages.size()));
      }
    }
    test::leave(sheet.image(), QStringLiteral("contact_%1x%2").arg(size.width_mm).arg(size.height_mm));
  }
}

TEST(FigurePages, TitlesAreOptionalAndOccludedTimeIsShaded) {
  for (const EveryFigure& it : everyFigure()) {
    const auto figure = it.make();
    for (const bool titles : {true, false})
      for (const auto& page : pagesOf(*figure, {{180.0, 120.0}, titles})) {
        auto& plot = dynamic_cast<PanelFigure&>(page->canvas());
        EXPECT_EQ(!plot.title().boxes().empty(), titles) << it.name;
        EXPECT_EQ(page->caption(), figure->caption()) << it.name << ": the caption has the title";
        const auto& entries = plot.legend().entries();
        EXPECT_EQ(std::any_of(entries.begin(), entries.end(),
                              [](const LegendEntry& entry) { return entry.text.startsWith("occluded"); }),
                  it.over_time)
            << it.name;
        if (!it.over_time) continue;
        const QImage image = plot.toPixmap(0, 0, 1.0).toImage();
        QColor shade = Theme::light().occluded;
        const double share = shade.alphaF();
        const QColor on_white(static_cast<int>(255 - share * (255 - shade.red())),
                              static_cast<int>(255 - share * (255 - shade.green())),
                              static_cast<int>(255 - share * (255 - shade.blue())));
        for (const std::size_t i : plot.shown())
          EXPECT_GT(test::count(image, plot.panels()[i].axes->rect(), on_white, 3).pixels, 30)
              << it.name << ", panel " << i + 1 << ": occluded time is not shaded";
      }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FigureLayout, ::testing::Range(0, static_cast<int>(everyFigure().size())),
                         [](const auto& test) {
                           return everyFigure()[static_cast<std::size_t>(test.param)].name;
                         });

}  // namespace
}  // namespace capstan::widgets
