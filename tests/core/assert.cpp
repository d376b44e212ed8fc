// Asserts: on or off, what they evaluate, whom they tell.
#include "core/assert.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "core/union_find.hpp"

namespace frond {
namespace assert_tests {

#ifdef FROND_ASSERTS
constexpr bool ARE_ON = true;
#else
constexpr bool ARE_ON = false;
#endif

std::string told;

void note(const char* condition, const char* file, int line) {
    told =
        std::string(file).substr(std::string(file).rfind('/') + 1) + ":" + std::to_string(line > 0) + " " + condition;
}
void throw_it(const char* condition, const char*, int) {
    throw std::logic_error(condition);
}

// A handler for the length of a test.
struct Handled {
    AssertHandler* before;
    explicit Handled(AssertHandler* handler) : before(set_assert_handler(handler)) { told.clear(); }
    ~Handled() { set_assert_handler(before); }
};

TEST(Assert, TellsTheHandlerWhatDoesNotHoldAndGoesOn) {
    const Handled handled(note);
    FROND_ASSERT(1 + 1 == 2);
    EXPECT_EQ(told, "");
    FROND_ASSERT(1 + 1 == 3);
    EXPECT_EQ(told, ARE_ON ? "assert.cpp:1 1 + 1 == 3" : "");
}

TEST(Assert, EvaluatesNothingWhereItIsOff) {
    const Handled handled(note);
    int evaluated = 0;
    FROND_ASSERT(++evaluated > 0);
    EXPECT_EQ(evaluated, ARE_ON ? 1 : 0);
}

TEST(Assert, AHandlerMayThrowAndTheOneBeforeComesBack) {
    const Handled handled(note);
    {
        const Handled inner(throw_it);
        EXPECT_EQ(inner.before, note);
        EXPECT_THROW(tell_failed_assert("2 < 1", "a file", 1), std::logic_error);
    }
    tell_failed_assert("3 < 1", "dir/a file", 1);
    EXPECT_EQ(told, "a file:1 3 < 1");
}

TEST(Assert, WithoutAHandlerOfOnesOwnTheProgramEnds) {
    EXPECT_DEATH(
        {
            set_assert_handler(nullptr);
            tell_failed_assert("2 < 1", "a file", 7);
        },
        "a file:7: this does not hold: 2 < 1");
}

// What the inside relies on is asserted where it is relied on.
TEST(Assert, TellsOfAnIndexBeyondASet) {
    if (!ARE_ON) GTEST_SKIP() << "asserts are off";
    const Handled handled(throw_it);
    UnionFind sets(3);
    EXPECT_NO_THROW(sets.find(2));
    EXPECT_THROW(sets.find(3), std::logic_error);
    EXPECT_THROW(sets.join(-1, 0), std::logic_error);
}

}  // namespace assert_tests
}  // namespace frond
