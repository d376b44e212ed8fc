// Handles and errors.
#include <gtest/gtest.h>

#include <thread>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/slots.hpp"

using namespace frond;

TEST(Slots, ForgetWhatWasErasedAndNeverGiveItsHandleAgain) {
    Slots<int, 7> slots;
    const uint64_t first = slots.insert(11);
    EXPECT_EQ(slots.find(first), 11);
    EXPECT_EQ(slots.erase(first), 11);
    EXPECT_EQ(slots.erase(first), 0);
    const uint64_t second = slots.insert(22);
    EXPECT_NE(first, second);
    EXPECT_EQ(slots.find(first), 0);
    EXPECT_EQ(slots.find(second), 22);
}

TEST(Slots, RefuseHandlesOfAnotherKindAndNonsense) {
    Slots<int, 7> slots;
    Slots<int, 8> others;
    const uint64_t id = slots.insert(11);
    others.insert(12);
    EXPECT_EQ(others.find(id), 0);
    for (uint64_t nonsense : {uint64_t(0), uint64_t(1), ~uint64_t(0), id + 1, id ^ (uint64_t(1) << 40)})
        EXPECT_EQ(slots.find(nonsense), 0) << nonsense;
}

TEST(Slots, MayBeUsedFromManyThreads) {
    Slots<int, 7> slots;
    std::vector<std::thread> threads;
    std::vector<int> sums(4, 0);
    for (int t = 0; t < 4; t++)
        threads.emplace_back([&, t] {
            for (int i = 1; i <= 2000; i++) {
                const uint64_t id = slots.insert(i);
                sums[size_t(t)] += slots.find(id);
                if (i % 2) slots.erase(id);
            }
        });
    for (std::thread& thread : threads) thread.join();
    for (int sum : sums) EXPECT_EQ(sum, 2000 * 2001 / 2);
}

TEST(Error, CarriesCodeAndText) {
    try {
        fail(FROND_RESULT_FILE_FORMAT, "%s: line %d", "corn.obj", 7);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_FILE_FORMAT);
        EXPECT_STREQ(error.what(), "corn.obj: line 7");
    }
}
