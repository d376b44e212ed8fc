// The figure "contact": what remains of an overlap, and that settings of the hash change nothing but time.
#include <gtest/gtest.h>

#include "study/figures.hpp"

namespace contact_tests {

using frond::study::Effort;
using frond::study::Figure;
using frond::study::FigurePanel;

TEST(ContactFigure, TellsWhatIsLeftOverTime) {
    const Figure figure = frond::study::make_contact("", Effort::TINY);
    ASSERT_EQ(figure.panels.size(), 3u);
    const FigurePanel &impulses = figure.panels[0], &none = figure.panels[1], &hash = figure.panels[2];
    for (const FigurePanel& panel : figure.panels) {
        ASSERT_EQ(panel.row.size() + 1, figure.columns.size());
        EXPECT_GT(panel.row[0], 50) << panel.caption;  // [mm]
    }
    EXPECT_LT(impulses.row[1], 1);
    EXPECT_LT(impulses.row[2], 2);
    EXPECT_GT(none.row[1], 50);
    EXPECT_LT(none.row[4], 0.1 * impulses.row[4]);
    EXPECT_EQ(impulses.curve.x.size(), 120u);
    // The hash finds the same contacts in every layout.
    EXPECT_EQ(hash.row[0], impulses.row[0]);
    EXPECT_EQ(hash.row[1], impulses.row[1]);
    EXPECT_TRUE(hash.curve.x.empty());
    const std::string table = frond::study::markdown_of(figure), script = frond::study::gnuplot_of(figure, "contact");
    EXPECT_NE(table.find("| response none |"), std::string::npos);
    EXPECT_EQ(table.find("]()"), std::string::npos);  // no pictures
    EXPECT_NE(script.find("$c1 using"), std::string::npos);
    EXPECT_EQ(script.find("$c2 using"), std::string::npos);
}

}  // namespace contact_tests
