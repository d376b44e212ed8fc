// The explained red cells of the table of hard cases: criteria that a method is known to miss, nothing else.
#include "stability/stability.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

using namespace frond;
using namespace frond::stability;

static Result red(const char* name, frond_mechanics mechanics, frond_integrator integrator) {
    Result result = {&find_case(name), {mechanics, integrator, 1.0 / 60}, {}};
    result.verdict.is_missed = true;
    result.verdict.text = "missed";
    return result;
}

TEST(Stability, ARedCellOfAnyIntegratorNeedsAnExplanation) {
    EXPECT_FALSE(is_unexplained(red("dropped", FROND_MECHANICS_TET_LINEAR, FROND_INTEGRATOR_SDIRK2)));
    EXPECT_FALSE(is_unexplained(red("needles", FROND_MECHANICS_ROD, FROND_INTEGRATOR_IMPLICIT_EULER)));
    EXPECT_TRUE(is_unexplained(red("needles", FROND_MECHANICS_ROD, FROND_INTEGRATOR_SDIRK2)));
    EXPECT_TRUE(is_unexplained(red("dropped", FROND_MECHANICS_TET_COROTATIONAL, FROND_INTEGRATOR_TR_BDF2)));
    EXPECT_TRUE(is_unexplained(red("spun", FROND_MECHANICS_ROD, FROND_INTEGRATOR_BDF2)));
}

TEST(Stability, AGreenCellNeedsNone) {
    Result green = red("spun", FROND_MECHANICS_ROD, FROND_INTEGRATOR_BDF2);
    green.verdict = {};
    green.verdict.color = Color::GREEN;
    EXPECT_FALSE(is_unexplained(green));
    EXPECT_EQ(known_limit(green), nullptr);
}

TEST(Stability, ACrashIsNeverExplained) {
    Result crashed = red("dropped", FROND_MECHANICS_TET_LINEAR, FROND_INTEGRATOR_BDF2);
    const std::vector<Verdict> verdicts = run_apart(
        1, {}, [](size_t) -> Verdict { std::_Exit(1); }, [](int) {});
    crashed.verdict = verdicts.front();
    EXPECT_EQ(crashed.verdict.color, Color::RED);
    EXPECT_EQ(crashed.verdict.text, "ended without a word");
    EXPECT_TRUE(is_unexplained(crashed));
}

TEST(Stability, ACallThatFailsIsNeverExplained) {
    Result failed = red("dropped", FROND_MECHANICS_TET_LINEAR, FROND_INTEGRATOR_BDF2);
    failed.verdict = run_apart(
                         1, {}, [](size_t) { return verdict_of([] { find_case("no_such_case"); }); }, [](int) {})
                         .front();
    EXPECT_EQ(failed.verdict.color, Color::RED);
    EXPECT_TRUE(is_unexplained(failed));
}

TEST(Stability, ACriterionThatWasMissedIsToldByTheProcessThatMissedIt) {
    Result dropped = red("dropped", FROND_MECHANICS_TET_LINEAR, FROND_INTEGRATOR_BDF2);
    dropped.cell.dt = 0.1;
    dropped.verdict = run_apart(
                          1, {}, [&](size_t) { return run_cell(*dropped.of, dropped.cell); }, [](int) {})
                          .front();
    EXPECT_EQ(dropped.verdict.color, Color::RED);
    EXPECT_FALSE(is_unexplained(dropped)) << dropped.verdict.text;
}

TEST(Stability, TheTableShowsAnUnexplainedCellBeforeOthers) {
    const std::string text = text_of({red("needles", FROND_MECHANICS_ROD, FROND_INTEGRATOR_IMPLICIT_EULER),
                                      red("needles", FROND_MECHANICS_ROD, FROND_INTEGRATOR_SDIRK2)});
    EXPECT_NE(text.find("red: needles, rod, sdirk2, 1/60 s: missed\n"), std::string::npos) << text;
    EXPECT_NE(text.find("2 cells: 0 green, 0 grey (not applicable), 2 red, 1 of them unexplained"), std::string::npos)
        << text;
}
